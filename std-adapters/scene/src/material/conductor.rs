//! Rough conductors, with a roughness per channel.

use crate::colour::Colour;
use crate::frame::turn;
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

impl<C: Colour> Lobes<C> {
    /// G₁(v) = 2/(1 + √(1 + α² tan² v)), per channel.
    #[inline(always)]
    fn masking(&self, v: Vec3) -> C {
        let tan2 = (v.x * v.x + v.y * v.y) / (v.z * v.z);
        self.roughness.map(|a| 2.0 / (1.0 + (1.0 + a * a * tan2).sqrt()))
    }

    /// The density of each channel's own reflected direction, D·G₁(wi)/(4 cos wi), by the half vector: also of
    /// directions below the horizon.
    #[inline(always)]
    fn density_about(&self, wi: Vec3, half: Vec3) -> C {
        // cos²(α² − 1) + 1 without its cancellation.
        let (sin2, cos2) = (half.x * half.x + half.y * half.y, half.z * half.z);
        let distribution = self.roughness.map(|a| {
            let (a2, t) = (a * a, sin2 + a * a * cos2);
            a2 / (PI * t * t)
        });
        distribution * self.masking(wi).times(0.25 / wi.z)
    }

    /// [`density_about`](Self::density_about) for a pair of directions above the horizon.
    #[inline(always)]
    pub(crate) fn density(&self, wi: Vec3, wo: Vec3) -> C {
        self.density_about(wi, (wi + wo).normalize())
    }

    /// f·cos over the density of each channel: reflectance·G₁(wo), above the horizon.
    #[inline(always)]
    pub(crate) fn over_density(&self, wo: Vec3) -> C {
        self.reflectance * self.masking(wo)
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
