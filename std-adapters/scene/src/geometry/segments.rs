//! Eight segments side by side: shadow rays.

use crate::geometry::{Geometry, NONE, Ray, Rectangle, rectangle, sphere};
use crate::lanes::{LANES, Lane, Mask, Vectors, blend, in_memory, mask};
use glam::Vec3;

/// Rays that end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segments {
    origins: Vectors,
    directions: Vectors,
    ends: Lane,
    /// The shape that each leaves.
    from: [u32; LANES],
    triangles: [u32; LANES],
    /// The shape that each leads to, which does not hide its end.
    to: [u32; LANES],
}

impl Segments {
    /// Nothing is on a segment without a length.
    pub(crate) const NONE: Self = Self {
        origins: Vectors::ZERO,
        directions: Vectors::ZERO,
        ends: [0.0; LANES],
        from: [NONE; LANES],
        triangles: [NONE; LANES],
        to: [NONE; LANES],
    };

    /// `ray` up to `end`, shape `to` aside.
    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, ray: &Ray, end: f32, to: u32) {
        self.origins.set(lane, ray.origin);
        self.directions.set(lane, ray.direction);
        self.ends[lane] = end;
        (self.from[lane], self.triangles[lane], self.to[lane]) = (ray.shape, ray.triangle, to);
    }

    /// Marks those on which shape `number` lies: at `distances` from the origin in the direction, first if that is
    /// elsewhere, then if it is a point of the shape itself.
    #[inline(always)]
    fn mark(&self, number: u32, distances: impl Fn(Vec3, Vec3) -> [f32; 2], hidden: &mut Mask) {
        let (mut from_afar, mut across) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            [from_afar[lane], across[lane]] = distances(self.origins.get(lane), self.directions.get(lane));
        }
        in_memory(&mut (&mut from_afar, &mut across));
        let own = mask(&self.from, &[number; LANES], |from, number| from == number);
        let before = mask(&blend(&own, &across, &from_afar), &self.ends, |t, end| t < end);
        for (lane, hidden) in hidden.iter_mut().enumerate() {
            *hidden |= if self.to[lane] == number { 0 } else { before[lane] };
        }
        in_memory(hidden);
    }
}

impl Geometry {
    /// Which of `segments` something lies on: as [`occluded`](Self::occluded) of each.
    #[inline(always)]
    pub(crate) fn hidden(&self, segments: &Segments) -> [bool; LANES] {
        let (mut hidden, mut number) = ([0; LANES], 0);
        // Shapes are read before the loops over lanes, which could otherwise write over them for all the compiler knows.
        for sphere in &self.spheres {
            let (center, square) = (sphere.center, sphere.radius * sphere.radius);
            let distances = |origin, direction| {
                let to_origin = origin - center;
                [sphere::distance(to_origin, square, direction), sphere::across(to_origin, direction)]
            };
            segments.mark(number, distances, &mut hidden);
            number += 1;
        }
        for rectangle in &self.rectangles {
            let Rectangle { center, normal, duals, .. } = *rectangle;
            let distances =
                |origin, direction| [rectangle::distance(center - origin, normal, duals, direction), f32::INFINITY];
            segments.mark(number, distances, &mut hidden);
            number += 1;
        }
        for cube in &self.cubes {
            let cube = *cube;
            let distances = |origin, direction| {
                let ray = Ray::new(origin, direction);
                [cube.distance(&ray, false), cube.distance(&ray, true)]
            };
            segments.mark(number, distances, &mut hidden);
            number += 1;
        }
        let mut hidden = hidden.map(|hidden| hidden != 0);
        if let Some(meshes) = &self.meshes {
            for (lane, hidden) in hidden.iter_mut().enumerate().filter(|(lane, _)| segments.ends[*lane] > 0.0) {
                let ray = Ray::new(segments.origins.get(lane), segments.directions.get(lane));
                *hidden = *hidden || meshes.occluded(ray, segments.triangles[lane], segments.ends[lane]);
            }
        }
        hidden
    }
}
