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

    /// Where the ray is inside; NaN if nowhere.
    ///
    /// The discriminant is r² less the square of the distance from the centre to the line, which keeps its
    /// digits from afar (Haines et al. 2019).
    #[inline(always)]
    pub(crate) fn interval(&self, ray: &Ray) -> Interval {
        let to_origin = ray.origin - self.center;
        let b = to_origin.dot(ray.direction);
        let to_line = to_origin - ray.direction * b;
        let half = (self.radius * self.radius - to_line.dot(to_line)).sqrt();
        Interval(-b - half, -b + half)
    }

    /// The distance to the surface, infinite if the ray passes; `own`: from a point of it.
    #[inline(always)]
    pub(crate) fn distance(&self, ray: &Ray, own: bool) -> f32 {
        if own {
            // The root also where the ray grazes and rounding would let it out.
            let b = (ray.origin - self.center).dot(ray.direction);
            return if b < 0.0 { -2.0 * b } else { f32::INFINITY };
        }
        self.interval(ray).first()
    }

    /// The point of the surface that is nearest to `position`, and the normal there.
    #[inline(always)]
    pub(crate) fn point(&self, position: Vec3) -> (Vec3, Vec3) {
        let outward = (position - self.center).normalize();
        (self.center + outward * self.radius, outward * self.side)
    }
}
