//! Eight spheres or rectangles side by side: loops over lanes become vector instructions.

use crate::geometry::{Hit, Ray, Rectangle, Sphere, rectangle, sphere};
use crate::lanes::{LANES, Lane, NUMBERS, Vectors, first_lane, in_memory, least};

/// Shapes of one kind.
///
/// *Implemented by* spheres and rectangles, *called by* the search for what a ray meets.
pub(super) trait Pack: Sized {
    type Shape;
    /// Lanes that no ray meets.
    const EMPTY: Self;
    fn set(&mut self, lane: usize, shape: &Self::Shape);
    /// The distance to each; `own` is the lane that the ray starts on, which may be an empty one: the numbers of other
    /// kinds go on from here.
    fn distances(&self, ray: &Ray, own: u32) -> Lane;
}

/// All shapes in packs of eight.
pub(super) fn packs_of<P: Pack>(shapes: &[P::Shape]) -> Vec<P> {
    let packs = shapes.chunks(LANES).map(|shapes| {
        let mut pack = P::EMPTY;
        shapes.iter().enumerate().for_each(|(lane, shape)| pack.set(lane, shape));
        pack
    });
    packs.collect()
}

/// The nearest shape of `packs` before `t`, which become `nearest`; shapes are numbered from `first` on.
#[inline(always)]
pub(super) fn closest_in<P: Pack>(packs: &[P], ray: &Ray, first: u32, nearest: &mut Hit) {
    let mut first = first;
    for pack in packs {
        let distances = pack.distances(ray, ray.shape.wrapping_sub(first));
        let least = least(distances);
        if least < nearest.t {
            nearest.t = least;
            // The first of equals.
            nearest.shape = first + first_lane(&distances, least);
        }
        first += LANES as u32;
    }
}

/// Whether `ray` meets any of `packs` before `t`, shape `but` aside.
#[inline(always)]
pub(super) fn occluded_by<P: Pack>(packs: &[P], ray: &Ray, first: u32, t: f32, but: u32) -> bool {
    let mut first = first;
    let mut occluded = false;
    for pack in packs {
        let distances = pack.distances(ray, ray.shape.wrapping_sub(first));
        let but = but.wrapping_sub(first);
        for lane in 0..LANES {
            occluded |= (distances[lane] < t) & (NUMBERS[lane] != but);
        }
        first += LANES as u32;
    }
    occluded
}

/// Spheres: see [`Sphere`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Spheres {
    center: Vectors,
    square: Lane,
}

impl Pack for Spheres {
    type Shape = Sphere;
    const EMPTY: Self = Self { center: Vectors::ZERO, square: [f32::NEG_INFINITY; LANES] };

    fn set(&mut self, lane: usize, sphere: &Sphere) {
        self.center.set(lane, sphere.center);
        self.square[lane] = sphere.radius * sphere.radius;
    }

    #[inline(always)]
    fn distances(&self, ray: &Ray, own: u32) -> Lane {
        let mut distances = [0.0; LANES];
        for (lane, distance) in distances.iter_mut().enumerate() {
            let own = (NUMBERS[lane] == own) & (self.square[lane] > 0.0);
            let to_origin = ray.origin - self.center.get(lane);
            let across = sphere::across(to_origin, ray.direction);
            let from_afar = sphere::distance(to_origin, self.square[lane], ray.direction);
            *distance = if own { across } else { from_afar };
        }
        in_memory(&mut distances);
        distances
    }
}

/// Rectangles: see [`Rectangle`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangles {
    center: Vectors,
    normal: Vectors,
    duals: [Vectors; 2],
}

impl Pack for Rectangles {
    type Shape = Rectangle;
    const EMPTY: Self = Self { center: Vectors::ZERO, normal: Vectors::ZERO, duals: [Vectors::ZERO; 2] };

    fn set(&mut self, lane: usize, rectangle: &Rectangle) {
        self.center.set(lane, rectangle.center);
        self.normal.set(lane, rectangle.normal);
        for (duals, dual) in self.duals.iter_mut().zip(rectangle.duals) {
            duals.set(lane, dual);
        }
    }

    #[inline(always)]
    fn distances(&self, ray: &Ray, own: u32) -> Lane {
        let mut distances = [0.0; LANES];
        for (lane, distance) in distances.iter_mut().enumerate() {
            let to_center = self.center.get(lane) - ray.origin;
            let duals = [self.duals[0].get(lane), self.duals[1].get(lane)];
            let met = rectangle::distance(to_center, self.normal.get(lane), duals, ray.direction);
            *distance = if NUMBERS[lane] == own { f32::INFINITY } else { met };
        }
        in_memory(&mut distances);
        distances
    }
}
