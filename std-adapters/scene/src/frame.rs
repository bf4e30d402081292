//! Directions about an axis.

use crate::planted::planted;
use core::f32::consts::FRAC_PI_2;
use glam::Vec3;

/// An orthonormal basis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    x: Vec3,
    y: Vec3,
    z: Vec3,
}

impl Frame {
    /// Any basis with the unit vector `z` as its third axis (Duff et al. 2017), without branches.
    #[inline(always)]
    pub(crate) fn about(z: Vec3) -> Self {
        let sign = 1.0_f32.copysign(z.z);
        let a = -1.0 / (sign + z.z);
        let b = z.x * z.y * a;
        Self {
            x: Vec3::new(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x),
            y: Vec3::new(b, sign + z.y * z.y * a, -z.y),
            z,
        }
    }

    #[inline(always)]
    pub(crate) fn to_world(self, v: Vec3) -> Vec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }

    #[inline(always)]
    pub(crate) fn to_local(self, v: Vec3) -> Vec3 {
        Vec3::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }
}

/// cos and sin of 2πu for u in [0, 1], to 2⁻²³, in additions and multiplications: the same bits everywhere.
///
/// A quarter turn is taken off as often as it goes in, without branches or integers; Taylor's polynomials do the rest.
#[inline(always)]
pub(crate) fn turn(u: f32) -> [f32; 2] {
    let [a, b, c, d] = [u >= 0.125, u >= 0.375, u >= 0.625, u >= 0.875];
    let one = |counts: bool| if counts { 1.0 } else { 0.0 };
    let angle = (4.0 * u - ((one(a) + one(b)) + (one(c) + one(d)))) * FRAC_PI_2;
    let s = angle * angle;
    let sin = angle * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s * (1.0 / 362_880.0)))));
    let cos = 1.0 + s * (-0.5 + s * (1.0 / 24.0 + s * (-1.0 / 720.0 + s * (1.0 / 40_320.0))));
    let (cos, sin) = if (a & !b) | (c & !d) { (sin, cos) } else { (cos, sin) };
    [if a & !c { -cos } else { cos }, if b & !d { -sin } else { sin }]
}

/// Uniform on the unit sphere.
#[inline(always)]
pub(crate) fn uniform_direction([u, v]: [f32; 2]) -> Vec3 {
    let z = 1.0 - 2.0 * u;
    let radius = 2.0 * (u * (1.0 - u)).sqrt();
    let [cos, sin] = turn(v);
    Vec3::new(radius * cos, radius * sin, z)
}

/// About +z, with density cos θ/π (Malley).
#[inline(always)]
pub(crate) fn cosine_direction([u, v]: [f32; 2]) -> Vec3 {
    let radius = u.sqrt();
    let [cos, sin] = turn(v);
    Vec3::new(radius * cos, radius * sin, planted!("hemisphere_without_root": (1.0 - u).sqrt(), 1.0 - u))
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::TAU;

    #[test]
    fn turns_are_cosines_and_sines() {
        for i in 0..=100_000 {
            let u = i as f32 / 100_000.0;
            let (right, ours) = (TAU * f64::from(u), turn(u));
            for (ours, right) in ours.into_iter().zip([libm::cos(right), libm::sin(right)]) {
                assert!((f64::from(ours) - right).abs() <= 1.2e-7, "{u}: {ours} should be {right}");
            }
        }
    }

    #[test]
    fn frames_are_orthonormal_and_right_handed() {
        for i in 0..1000 {
            let z = uniform_direction([(i as f32 + 0.5) / 1000.0, (i * 37 % 1000) as f32 / 1000.0]);
            for z in [z, Vec3::Z, -Vec3::Z] {
                let Frame { x, y, .. } = Frame::about(z);
                let error = (x.cross(y) - z).length().max(x.dot(z).abs()).max((x.length() - 1.0).abs());
                assert!(error <= 1e-6, "{z}: {error}");
                let v = Vec3::new(0.3, -0.5, 0.7);
                let back = Frame::about(z).to_local(Frame::about(z).to_world(v));
                assert!((back - v).length() <= 1e-6);
            }
        }
    }
}
