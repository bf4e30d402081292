//! Whether the processor calculates as promised.

use core::hint::black_box;

/// How the processor, or the thread's settings of it, treats floating-point numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FpEnvironment {
    /// Numbers below 2⁻¹²⁶ (`f32`) and 2⁻¹⁰²² (`f64`) are what they are, not 0.
    pub keeps_denormals: bool,
    /// Results are rounded to the nearest number, ties to even.
    pub rounds_to_nearest: bool,
}

impl FpEnvironment {
    /// Whether both hold, so that results are the bits that this crate promises.
    pub const fn is_sound(self) -> bool {
        self.keeps_denormals && self.rounds_to_nearest
    }
}

/// Tries, on this thread, what every result of this crate relies on.
///
/// Audio and game engines, and C compilers' `-ffast-math`, make processors flush denormal numbers to zero
/// (FTZ, DAZ) for all code of a thread. Ratios of tiny numbers are then 0/0, and bits differ from other
/// machines'. Ask at the start of each thread that such code may have touched.
///
/// ```
/// let environment = ratiocv_core::fp_environment();
/// assert!(environment.is_sound(), "{environment:?}: reset the floating-point settings of this thread");
/// ```
pub fn fp_environment() -> FpEnvironment {
    // The compiler must not work these out itself.
    let half = |x: f64| black_box(black_box(x) * black_box(0.5));
    let half_f32 = |x: f32| black_box(black_box(x) * black_box(0.5));
    let sum = |x: f64| black_box(black_box(1.0) + black_box(x));
    let sum_f32 = |x: f32| black_box(black_box(1.0) + black_box(x));
    // A flushed result is 0; a flushed operand makes half of it back into 0 too.
    let keeps_denormals = half(f64::MIN_POSITIVE) > 0.0
        && black_box(half(f64::MIN_POSITIVE) * black_box(2.0)) == f64::MIN_POSITIVE
        && half_f32(f32::MIN_POSITIVE) > 0.0
        && black_box(half_f32(f32::MIN_POSITIVE) * black_box(2.0)) == f32::MIN_POSITIVE;
    // Upwards, downwards and towards zero each fail one of these.
    let rounds_to_nearest = sum(0.5 * f64::EPSILON) == 1.0
        && sum(0.75 * f64::EPSILON) == 1.0 + f64::EPSILON
        && sum(-0.125 * f64::EPSILON) == 1.0
        && sum_f32(0.5 * f32::EPSILON) == 1.0
        && sum_f32(0.75 * f32::EPSILON) == 1.0 + f32::EPSILON
        && sum_f32(-0.125 * f32::EPSILON) == 1.0;
    FpEnvironment { keeps_denormals, rounds_to_nearest }
}
