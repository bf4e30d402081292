//! Eight spheres or rectangles side by side: loops over lanes become vector instructions.

use crate::geometry::{Ray, Rectangle, Sphere};
use glam::Vec3;

/// Shapes in a pack.
pub(crate) const LANES: usize = 8;

type Lane = [f32; LANES];

/// Vectors side by side.
#[derive(Clone, Copy, Debug)]
struct Vectors {
    x: Lane,
    y: Lane,
    z: Lane,
}

impl Vectors {
    const ZERO: Self = Self { x: [0.0; LANES], y: [0.0; LANES], z: [0.0; LANES] };

    fn set(&mut self, lane: usize, v: Vec3) {
        (self.x[lane], self.y[lane], self.z[lane]) = (v.x, v.y, v.z);
    }

    #[inline(always)]
    fn dot(&self, lane: usize, v: Vec3) -> f32 {
        self.x[lane] * v.x + self.y[lane] * v.y + self.z[lane] * v.z
    }
}

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

/// The nearest shape of `packs` before `nearest`, which it becomes; shapes are numbered from `first` on, and those
/// from `limit` on are not seen.
#[inline(always)]
pub(super) fn closest_in<P: Pack>(packs: &[P], ray: &Ray, first: u32, limit: u32, (t, shape): (&mut f32, &mut u32)) {
    let mut first = first;
    for pack in packs {
        let mut distances = pack.distances(ray, ray.shape.wrapping_sub(first));
        let seen = limit.wrapping_sub(first);
        if seen < LANES as u32 {
            for (lane, distance) in distances.iter_mut().enumerate() {
                *distance = if (lane as u32) < seen { *distance } else { f32::INFINITY };
            }
        }
        let nearest = least(&distances);
        if nearest < *t {
            *t = nearest;
            // The first of equals.
            let mut nearest_lane = 0;
            for lane in (0..LANES).rev() {
                nearest_lane = if distances[lane] == nearest { lane } else { nearest_lane };
            }
            *shape = first + nearest_lane as u32;
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
        let mut distances = pack.distances(ray, ray.shape.wrapping_sub(first));
        let but = but.wrapping_sub(first);
        for (lane, distance) in distances.iter_mut().enumerate() {
            *distance = if lane as u32 == but { f32::INFINITY } else { *distance };
        }
        occluded |= least(&distances) < t;
        first += LANES as u32;
    }
    occluded
}

/// The least, in a tree.
#[inline(always)]
fn least(t: &Lane) -> f32 {
    let less = |a: f32, b: f32| if a < b { a } else { b };
    let mut halves = [0.0; 4];
    for i in 0..4 {
        halves[i] = less(t[i], t[i + 4]);
    }
    less(less(halves[0], halves[2]), less(halves[1], halves[3]))
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

    /// The discriminant is r² less the square of the distance from the centre to the line, which keeps its
    /// digits from afar (Haines et al. 2019).
    #[inline(always)]
    fn distances(&self, ray: &Ray, own: u32) -> Lane {
        let (o, d) = (ray.origin, ray.direction);
        let mut distances = [0.0; LANES];
        for (lane, distance) in distances.iter_mut().enumerate() {
            let (x, y, z) = (o.x - self.center.x[lane], o.y - self.center.y[lane], o.z - self.center.z[lane]);
            let b = x * d.x + y * d.y + z * d.z;
            let (lx, ly, lz) = (x - d.x * b, y - d.y * b, z - d.z * b);
            let square = self.square[lane] - (lx * lx + ly * ly + lz * lz);
            let half = square.max(0.0).sqrt();
            let near = -b - half;
            let first = if near > 0.0 { near } else { half - b };
            // The root also where a ray from the surface grazes and rounding would let it out.
            let own = (lane as u32 == own) & (self.square[lane] > 0.0);
            let t = if own { -2.0 * b } else { first };
            let met = (t > 0.0) & ((square >= 0.0) | own);
            *distance = if met { t } else { f32::INFINITY };
        }
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

    /// To the plane, and whether that is inside the edges.
    #[inline(always)]
    fn distances(&self, ray: &Ray, own: u32) -> Lane {
        let (o, d) = (ray.origin, ray.direction);
        let mut distances = [0.0; LANES];
        for (lane, distance) in distances.iter_mut().enumerate() {
            let to = Vec3::new(self.center.x[lane] - o.x, self.center.y[lane] - o.y, self.center.z[lane] - o.z);
            // 0/0 in a lane that is empty: NaN is not above 0.
            let t = self.normal.dot(lane, to) / self.normal.dot(lane, d);
            let place = Vec3::new(d.x * t - to.x, d.y * t - to.y, d.z * t - to.z);
            let (u, v) = (self.duals[0].dot(lane, place).abs(), self.duals[1].dot(lane, place).abs());
            let met = (t > 0.0) & (u <= 1.0) & (v <= 1.0) & (lane as u32 != own);
            *distance = if met { t } else { f32::INFINITY };
        }
        distances
    }
}
