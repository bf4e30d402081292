//! Rough conductors, with a roughness per channel.

use crate::colour::PathColour;
use crate::frame::turn;
use crate::planted::planted;
use core::f32::consts::PI;
use glam::Vec3;

/// One GGX lobe per channel (Trowbridge and Reitz 1975; Walter et al. 2007) with separable Smith shadowing. The
/// reflectance stands for Fresnel's term. Directions are local, +z being the normal, and leave the surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lobes<C> {
    pub(crate) reflectance: C,
    /// α.
    pub(crate) roughness: C,
}

impl<C: PathColour> Lobes<C> {
    /// z + √(z² + α²(1 − z²)): G₁(v) = 2/(1 + √(1 + α² tan² v)) is 2z over it.
    #[inline(always)]
    fn smith(a: f32, v: Vec3) -> f32 {
        v.z + (v.z * v.z + a * a * (v.x * v.x + v.y * v.y)).sqrt()
    }

    /// The density of each channel's own reflected direction, D·G₁(wi)/(4 cos wi), by the half vector: also of
    /// directions below the horizon.
    #[inline(always)]
    fn density_about(&self, wi: Vec3, half: Vec3) -> C {
        // D = α²/(πt²), where t is cos²(α² − 1) + 1 without its cancellation.
        let (sin2, cos2) = (half.x * half.x + half.y * half.y, half.z * half.z);
        self.roughness.map(|a| {
            let (a2, t) = (a * a, sin2 + a * a * cos2);
            a2 / (2.0 * PI * t * planted!("ggx_without_square": t, 1.0) * Self::smith(a, wi))
        })
    }

    /// [`density_about`](Self::density_about) for a pair of directions above the horizon.
    #[inline(always)]
    pub(crate) fn density(&self, wi: Vec3, wo: Vec3) -> C {
        self.density_about(wi, (wi + wo).normalize())
    }

    /// f·cos over the density of each channel: reflectance·G₁(wo), above the horizon.
    #[inline(always)]
    pub(crate) fn over_density(&self, wo: Vec3) -> C {
        self.reflectance * self.roughness.map(|a| planted!("unshadowed": 2.0 * wo.z / Self::smith(a, wo), 1.0))
    }

    /// A reflected direction from channel `channel`'s visible normals, as a cap of the unit sphere (Dupuy and
    /// Benyoub 2023), and the density with which each channel would have chosen it. It may be below the
    /// horizon.
    #[inline(always)]
    pub(crate) fn sample(&self, channel: usize, wi: Vec3, [u, v]: [f32; 2]) -> (Vec3, C) {
        let a = self.roughness.channel(channel);
        let stretched = Vec3::new(wi.x * a, wi.y * a, wi.z).normalize();
        let z = (1.0 - u) * (1.0 + stretched.z) - stretched.z;
        let radius = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
        let [cos, sin] = turn(v);
        let cap = Vec3::new(radius * cos, radius * sin, z) + stretched;
        let half = Vec3::new(cap.x * a, cap.y * a, cap.z).normalize();
        (half * (2.0 * wi.dot(half)) - wi, self.density_about(wi, half))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use ratiocv_simd::F32x4;

    const LOBES: Lobes<F32x4> =
        Lobes { reflectance: F32x4::new([0.9; 4]), roughness: F32x4::new([0.1, 0.2, 0.5, 0.5]) };

    fn direction(cos: f32, u: f32) -> Vec3 {
        let [x, y] = turn(u);
        let sin = ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt();
        Vec3::new(sin * x, sin * y, cos)
    }

    /// The density of reflected directions over the whole sphere is that of visible normals: 1. Midpoint rule,
    /// 400 × 800 cells.
    #[test]
    fn densities_integrate_to_1() {
        for cos in [1.0, 0.7, 0.3] {
            let wi = direction(cos, 0.1);
            let mut sums = [0.0; 3];
            // Over half vectors, whose solid angle is that of wo over 4 cos(wi, half).
            let (rows, columns) = (400, 800);
            for i in 0..rows {
                // Denser about the normal.
                let s = (i as f32 + 0.5) / rows as f32;
                for j in 0..columns {
                    let half = direction(1.0 - s * s, (j as f32 + 0.5) / columns as f32);
                    let wi_half = wi.dot(half);
                    if wi_half > 0.0 {
                        let cell = 2.0 * s / rows as f32 * core::f32::consts::TAU / columns as f32;
                        let density = LOBES.density_about(wi, half).times(4.0 * wi_half * cell);
                        sums.iter_mut().zip(density.to_array()).for_each(|(sum, d)| *sum += f64::from(d));
                    }
                }
            }
            for sum in sums {
                assert!((sum - 1.0).abs() <= 2e-3, "{cos}: {sum}");
            }
        }
    }

    /// H0: samples of a channel fall into 8 × 8 cells of (cos, φ) of the half vector with the density that is
    /// stated. N = 200 000; cells with at least 50 expected; α = 10⁻⁹ for all, 6.9 standard deviations each, and
    /// 1 % for the midpoint rule within cells.
    #[test]
    fn samples_have_the_density_that_is_stated() {
        let n = 200_000;
        let wi = direction(0.6, 0.3);
        for channel in 0..3 {
            let mut random = Random::new(3, [channel as u32, 0], 0);
            let mut counts = [[0.0; 8]; 8];
            let cell = |half: Vec3| {
                let azimuth = libm::atan2f(half.y, half.x) / core::f32::consts::TAU + 0.5;
                [(half.z * 8.0).min(7.99) as usize, (azimuth * 8.0).clamp(0.0, 7.99) as usize]
            };
            for _ in 0..n {
                let (wo, density) = LOBES.sample(channel, wi, random.uniforms());
                let half = (wi + wo).normalize();
                let [i, j] = cell(half);
                counts[i][j] += 1.0;
                let again = LOBES.density_about(wi, half);
                for c in 0..3 {
                    let (density, again) = (density.channel(c), again.channel(c));
                    assert!((density - again).abs() <= 2e-3 * density, "{density} {again}");
                }
            }
            let fine = 64;
            for (i, row) in counts.iter().enumerate() {
                for (j, count) in row.iter().enumerate() {
                    let mut expected = 0.0;
                    for k in 0..fine * fine {
                        let cos = (i as f32 + ((k / fine) as f32 + 0.5) / fine as f32) / 8.0;
                        let u = (j as f32 + ((k % fine) as f32 + 0.5) / fine as f32) / 8.0 + 0.5;
                        let half = direction(cos, u.fract());
                        let wi_half = wi.dot(half).max(0.0);
                        let density = LOBES.density_about(wi, half).channel(channel) * 4.0 * wi_half;
                        expected += f64::from(density) * core::f64::consts::TAU / (64.0 * (fine * fine) as f64);
                    }
                    let expected = expected * f64::from(n);
                    if expected >= 50.0 {
                        let allowed = 6.9 * libm::sqrt(expected) + 0.01 * expected;
                        assert!((count - expected).abs() <= allowed, "{channel} {i} {j}: {count} {expected}");
                    }
                }
            }
        }
    }
}
