//! Eight rays side by side.

use crate::geometry::Ray;
use crate::lanes::{LANES, Lane, Vectors, in_memory};
use glam::Vec3;

/// Rays from one point: those of a camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam {
    pub(super) origin: Vec3,
    pub(super) directions: Vectors,
}

impl Beam {
    /// Rays in a beam.
    pub(crate) const RAYS: usize = LANES;

    /// `direction` of each, of any length but 0.
    #[inline(always)]
    pub(crate) fn new(origin: Vec3, direction: impl Fn(usize) -> Vec3) -> Self {
        let mut directions = Vectors::ZERO;
        for lane in 0..LANES {
            directions.set(lane, direction(lane).normalize());
        }
        in_memory(&mut directions);
        Self { origin, directions }
    }

    #[inline(always)]
    pub(crate) fn ray(&self, lane: usize) -> Ray {
        Ray::new(self.origin, self.directions.get(lane))
    }

    /// `distance` of each ray, by its direction.
    #[inline(always)]
    pub(super) fn distances(&self, distance: impl Fn(Vec3) -> f32) -> Lane {
        let mut distances = [0.0; LANES];
        for (lane, t) in distances.iter_mut().enumerate() {
            *t = distance(self.directions.get(lane));
        }
        in_memory(&mut distances);
        distances
    }
}
