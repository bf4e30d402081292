//! Cubes, boxes and parallelepipeds.

use crate::geometry::{Beam, Columns, Interval, Ray};
use crate::lanes::Lane;
use glam::{Affine3A, Vec3};

/// The points whose three coordinates are in \[−1, 1\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cube {
    center: Vec3,
    /// Coordinate k of x is `rows[k]`·(x − center).
    rows: [Vec3; 3],
    edges: [Vec3; 3],
    side: f32,
}

impl Cube {
    /// `None` without a volume.
    pub(crate) fn new(to_world: &Affine3A, flip: bool) -> Option<Self> {
        let columns = Columns::new(to_world)?;
        let rows = columns.inverse_rows();
        let sound = rows.iter().all(|row| row.is_finite());
        sound.then_some(Self {
            center: columns.t,
            rows,
            edges: [columns.x, columns.y, columns.z],
            side: if flip { -1.0 } else { 1.0 },
        })
    }

    /// Where the ray is inside: what the three slabs have in common (Kay and Kajiya 1986).
    #[inline(always)]
    pub(crate) fn interval(&self, ray: &Ray) -> Interval {
        let to_origin = ray.origin - self.center;
        let mut interval = Interval(f32::NEG_INFINITY, f32::INFINITY);
        for row in self.rows {
            let (place, speed) = (row.dot(to_origin), 1.0 / row.dot(ray.direction));
            let (a, b) = ((-1.0 - place) * speed, (1.0 - place) * speed);
            interval = Interval(interval.0.max(a.min(b)), interval.1.min(a.max(b)));
        }
        interval
    }

    /// The distance to the surface, infinite if the ray passes; `own`: from a point of it.
    #[inline(always)]
    pub(crate) fn distance(&self, ray: &Ray, own: bool) -> f32 {
        let interval = self.interval(ray);
        if own { interval.across() } else { interval.first() }
    }

    /// The distances at which rays of a beam meet the surface, infinite where they pass.
    #[inline(always)]
    pub(crate) fn distances(&self, beam: &Beam) -> Lane {
        beam.distances(|direction| self.distance(&Ray::new(beam.origin, direction), false))
    }

    /// The normal of the face that `position` is on.
    #[inline(always)]
    pub(crate) fn normal(&self, position: Vec3) -> Vec3 {
        let place = self.rows.map(|row| row.dot(position - self.center));
        let [x, y, z] = place.map(f32::abs);
        let axis = if x >= y && x >= z {
            0
        } else if y >= z {
            1
        } else {
            2
        };
        self.face(axis, place[axis])
    }

    fn face(&self, axis: usize, side: f32) -> Vec3 {
        self.rows[axis].normalize() * self.side.copysign(self.side * side)
    }

    /// The areas of a pair of opposite faces each.
    fn areas(&self) -> [f32; 3] {
        let [x, y, z] = self.edges;
        [8.0 * y.cross(z).length(), 8.0 * z.cross(x).length(), 8.0 * x.cross(y).length()]
    }

    pub(crate) fn area(&self) -> f32 {
        self.areas().iter().sum()
    }

    /// The centre, and half the longest diagonal.
    pub(crate) fn bound(&self) -> (Vec3, f32) {
        let [x, y, z] = self.edges;
        let diagonals = [x + y + z, x + y - z, x - y + z, x - y - z];
        (self.center, diagonals.iter().map(|d| d.length()).fold(0.0, f32::max))
    }

    /// A point that is uniform over the area, and its normal.
    #[inline(always)]
    pub(crate) fn sample(&self, [u, v]: [f32; 2]) -> (Vec3, Vec3) {
        let areas = self.areas();
        // The first number says which face, and what is left of it where.
        let mut u = u * (areas[0] + areas[1] + areas[2]);
        let mut axis = 0;
        while axis < 2 && u >= areas[axis] {
            u -= areas[axis];
            axis += 1;
        }
        let u = 2.0 * (u / areas[axis]).min(1.0);
        let (side, u) = if u < 1.0 { (-1.0, u) } else { (1.0, u - 1.0) };
        let [a, b] = [self.edges[(axis + 1) % 3], self.edges[(axis + 2) % 3]];
        let position = self.center + self.edges[axis] * side + a * (2.0 * u - 1.0) + b * (2.0 * v - 1.0);
        (position, self.face(axis, side))
    }
}
