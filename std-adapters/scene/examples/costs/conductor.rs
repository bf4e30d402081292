//! A conductor that is rough by channel.

use crate::by_hand::uniform_direction;
use core::f32::consts::PI;
use glam::Vec3;

/// GGX lobes with Smith's shadowing. Directions are local.
#[derive(Clone, Copy)]
pub(crate) struct Conductor {
    pub(crate) reflectance: f32,
    pub(crate) roughness: Vec3,
}

impl Conductor {
    /// 2z/G₁.
    #[inline(always)]
    fn smith(a: f32, v: Vec3) -> f32 {
        v.z + (v.z * v.z + a * a * (v.x * v.x + v.y * v.y)).sqrt()
    }

    /// The density of each channel's reflected direction.
    #[inline(always)]
    pub(crate) fn density(&self, wi: Vec3, half: Vec3) -> Vec3 {
        let (sin2, cos2) = (half.x * half.x + half.y * half.y, half.z * half.z);
        self.roughness.map(|a| {
            let t = sin2 + a * a * cos2;
            a * a / (2.0 * PI * t * t * Self::smith(a, wi))
        })
    }

    /// f·cos over the density, above the horizon.
    #[inline(always)]
    pub(crate) fn over_density(&self, wo: Vec3) -> Vec3 {
        self.roughness.map(|a| self.reflectance * 2.0 * wo.z / Self::smith(a, wo))
    }

    /// A direction by channel `channel`'s visible normals, and half of the way to it.
    #[inline(always)]
    pub(crate) fn sample(&self, channel: usize, wi: Vec3, [u, v]: [f32; 2]) -> (Vec3, Vec3) {
        let a = self.roughness[channel];
        let stretched = Vec3::new(wi.x * a, wi.y * a, wi.z).normalize();
        // Uniform on the cap of the sphere above −stretched.z.
        let cap = uniform_direction([u * 0.5 * (1.0 + stretched.z), v]) + stretched;
        let half = Vec3::new(cap.x * a, cap.y * a, cap.z).normalize();
        (half * (2.0 * wi.dot(half)) - wi, half)
    }
}

/// A basis about `z`.
#[derive(Clone, Copy)]
pub(crate) struct Basis(Vec3, Vec3, Vec3);

impl Basis {
    #[inline(always)]
    pub(crate) fn about(z: Vec3) -> Self {
        let (x, y) = z.any_orthonormal_pair();
        Self(x, y, z)
    }
    #[inline(always)]
    pub(crate) fn local(&self, v: Vec3) -> Vec3 {
        Vec3::new(self.0.dot(v), self.1.dot(v), self.2.dot(v))
    }
    #[inline(always)]
    pub(crate) fn world(&self, v: Vec3) -> Vec3 {
        self.0 * v.x + self.1 * v.y + self.2 * v.z
    }
}
