//! Spheres.

use crate::geometry::{Interval, Ray};
use glam::Vec3;

/// A sphere; normals point outwards times `side`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sphere {
    pub(crate) center: Vec3,
    pub(crate) radius: f32,
    /// 1 or −1.
    pub(crate) side: f32,
}

impl Sphere {
    /// `None` without a radius, or if a number is not finite.
    pub(crate) fn new(center: Vec3, radius: f32, flip: bool) -> Option<Self> {
        let sound = center.is_finite() && radius > 0.0 && (radius * radius).is_normal();
        sound.then_some(Self { center, radius, side: if flip { -1.0 } else { 1.0 } })
    }

    /// Where the ray is inside; as in [`Spheres`](super::packs::Spheres).
    #[inline(always)]
    pub(crate) fn interval(&self, ray: &Ray) -> Interval {
        let to_origin = ray.origin - self.center;
        let b = to_origin.dot(ray.direction);
        let to_line = to_origin - ray.direction * b;
        let square = self.radius * self.radius - to_line.dot(to_line);
        let half = square.sqrt();
        if square >= 0.0 { Interval(-b - half, half - b) } else { Interval::EMPTY }
    }

    /// The point of the surface that is nearest to `position`, and the normal there.
    #[inline(always)]
    pub(crate) fn point(&self, position: Vec3) -> (Vec3, Vec3) {
        let outward = (position - self.center).normalize();
        (self.center + outward * self.radius, outward * self.side)
    }
}
