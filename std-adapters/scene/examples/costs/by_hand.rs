//! What loops by hand share.

use rand_core::Rng;
use rand_xoshiro::Xoshiro128PlusPlus;

/// Uniform in [0, 1).
#[inline(always)]
pub(crate) fn uniform(random: &mut Xoshiro128PlusPlus) -> f32 {
    (random.next_u32() >> 8) as i32 as f32 * (f32::EPSILON / 2.0)
}

/// cos and sin of 2πu, by Taylor's polynomials on ±π/4.
#[inline(always)]
pub(crate) fn turn(u: f32) -> [f32; 2] {
    let quarters = (4.0 * u + 0.5) as i32;
    let angle = (4.0 * u - quarters as f32) * core::f32::consts::FRAC_PI_2;
    let s = angle * angle;
    let sin = angle * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 - s / 5040.0)));
    let cos = 1.0 + s * (-0.5 + s * (1.0 / 24.0 + s * (-1.0 / 720.0 + s / 40_320.0)));
    let (cos, sin) = if quarters & 1 == 0 { (cos, sin) } else { (-sin, cos) };
    if quarters & 2 == 0 { [cos, sin] } else { [-cos, -sin] }
}
