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

    /// Where the ray is inside; as in [`distance`].
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

/// The distance at which a ray meets the surface, infinite if it passes: from `to_origin`, seen from the centre, in
/// `direction`, `square` being r²; `own`: from a point of the surface.
///
/// The discriminant is r² less the square of the distance from the centre to the line, which keeps its digits from
/// afar (Haines et al. 2019). Without branches, for shapes or rays side by side.
#[inline(always)]
pub(super) fn distance(to_origin: Vec3, square: f32, direction: Vec3, own: bool) -> f32 {
    let b = to_origin.dot(direction);
    let to_line = to_origin - direction * b;
    let discriminant = square - to_line.dot(to_line);
    let half = discriminant.max(0.0).sqrt();
    let near = -b - half;
    let first = if near > 0.0 { near } else { half - b };
    // The root also where a ray from the surface grazes and rounding would let it out.
    let t = if own { -2.0 * b } else { first };
    let met = (t > 0.0) & ((discriminant >= 0.0) | own);
    if met { t } else { f32::INFINITY }
}
