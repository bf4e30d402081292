//! Spheres.

use crate::geometry::{Beam, Interval, Ray};
use crate::lanes::Lane;
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

    /// The distances at which rays of a beam meet the surface, infinite where they pass.
    #[inline(always)]
    pub(crate) fn distances(&self, beam: &Beam) -> Lane {
        let (to_origin, square) = (beam.origin - self.center, self.radius * self.radius);
        beam.distances(|direction| distance(to_origin, square, direction))
    }

    /// The point of the surface that is nearest to `position`, and the normal there.
    #[inline(always)]
    pub(crate) fn point(&self, position: Vec3) -> (Vec3, Vec3) {
        let outward = (position - self.center).normalize();
        (self.center + outward * self.radius, outward * self.side)
    }
}

/// The distance at which a ray meets the surface, infinite if it passes: from `to_origin`, seen from the centre, in
/// `direction`, `square` being r².
///
/// The discriminant is r² less the square of the distance from the centre to the line, which keeps its digits from
/// afar (Haines et al. 2019). Without branches, for shapes or rays side by side.
#[inline(always)]
pub(super) fn distance(to_origin: Vec3, square: f32, direction: Vec3) -> f32 {
    let b = to_origin.dot(direction);
    let to_line = to_origin - direction * b;
    let discriminant = square - to_line.dot(to_line);
    let half = discriminant.max(0.0).sqrt();
    let near = -b - half;
    let t = if near > 0.0 { near } else { half - b };
    let met = (t > 0.0) & (discriminant >= 0.0);
    if met { t } else { f32::INFINITY }
}

/// The same from a point of the surface: the other root, also where the ray grazes and rounding would let it out.
#[inline(always)]
pub(super) fn across(to_origin: Vec3, direction: Vec3) -> f32 {
    let t = -2.0 * to_origin.dot(direction);
    if t > 0.0 { t } else { f32::INFINITY }
}
