//! Eight lights side by side: what places receive of them.

use crate::lanes::{LANES, Lane, Vectors, in_memory};
use crate::light::Facing;
use glam::Vec3;

/// What the choice of eight lights depends on.
#[derive(Clone, Debug)]
pub(super) struct Lamps {
    center: Vectors,
    radius: Lane,
    /// Of a plane, which is dark behind it; 0 of the others.
    normal: Vectors,
    /// The least cosine at the light: 0 of planes, 1 of the others.
    least: Lane,
    /// What the choice that is made is proportional to, but for the place.
    pub(super) importance: Lane,
    /// What the choice of each channel is.
    pub(super) weights: [Lane; 3],
}

impl Lamps {
    /// Lights far away, of no importance.
    pub(super) const NONE: Self = Self {
        center: Vectors { x: [1e18; LANES], ..Vectors::ZERO },
        radius: [0.0; LANES],
        normal: Vectors::ZERO,
        least: [1.0; LANES],
        importance: [0.0; LANES],
        weights: [[0.0; LANES]; 3],
    };

    /// A light in a sphere, or on a plane in it.
    pub(super) fn set(&mut self, lane: usize, (center, radius): (Vec3, f32), plane: Option<Vec3>) {
        self.center.set(lane, center);
        self.radius[lane] = radius;
        self.normal.set(lane, plane.unwrap_or(Vec3::ZERO));
        self.least[lane] = if plane.is_some() { 0.0 } else { 1.0 };
    }

    /// The light in `lane`.
    #[inline(always)]
    pub(super) fn lamp(&self, lane: usize) -> Lamp {
        let (center, normal) = (self.center.get(lane), self.normal.get(lane));
        Lamp { center, radius: self.radius[lane], normal, least: self.least[lane] }
    }

    /// What a place receives of each: see [`Lamp::received`].
    #[inline(always)]
    pub(super) fn seen_from(&self, at: Vec3, facing: Facing, seen: &mut Lane) {
        match facing {
            Facing::Any => self.seen_by(at, Vec3::ZERO, |_, _| 1.0, seen),
            Facing::Above(normal) => self.seen_by(at, normal, |cos, s| if cos > -s { 1.0 } else { 0.0 }, seen),
            Facing::Cosine(normal) => self.seen_by(at, normal, cosine, seen),
        }
    }

    #[inline(always)]
    fn seen_by(&self, at: Vec3, normal: Vec3, cosine: impl Fn(f32, f32) -> f32, seen: &mut Lane) {
        for (lane, seen) in seen.iter_mut().enumerate() {
            *seen = self.lamp(lane).received(at, normal, &cosine);
        }
        in_memory(seen);
    }
}

/// One of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp {
    center: Vec3,
    radius: f32,
    normal: Vec3,
    least: f32,
}

impl Lamp {
    /// Cosines over squared distance, of the middle; 0 only if all of it is below the horizon or turned away.
    ///
    /// `cosine` gets that at the place, and the sine of the cone in which the light is seen: above the horizon is what
    /// is seen of a sphere whose sine is s if cos > −s, all of it if cos ≥ s.
    #[inline(always)]
    pub(super) fn received(&self, at: Vec3, normal: Vec3, cosine: impl Fn(f32, f32) -> f32) -> f32 {
        let to = self.center - at;
        let square = to.dot(to);
        let inverse = 1.0 / square.sqrt();
        let greater = |a: f32, b: f32| if a > b { a } else { b };
        let turned = greater(-self.normal.dot(to) * inverse, self.least);
        turned / greater(square, self.radius * self.radius) * cosine(normal.dot(to) * inverse, self.radius * inverse)
    }
}

/// A diffuse surface's, of a light that may be partly below its horizon.
#[inline(always)]
pub(super) fn cosine(cos: f32, s: f32) -> f32 {
    let partly = (cos + s) * (cos + s) * 0.25 / s;
    let above = if cos >= s { cos } else { partly };
    if cos > -s { above } else { 0.0 }
}
