//! Rectangles, and parallelograms.

use crate::geometry::Columns;
use glam::{Affine3A, Vec3};

/// center + u·edges\[0\] + v·edges\[1\] for u, v in \[−1, 1\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rectangle {
    pub(crate) center: Vec3,
    pub(crate) normal: Vec3,
    /// Their products with a point of the plane, from the centre, are u and v.
    pub(super) duals: [Vec3; 2],
    pub(crate) edges: [Vec3; 2],
}

impl Rectangle {
    /// `None` without an area. What the transform does to the z axis decides the side of the normal alone.
    pub(crate) fn new(to_world: &Affine3A, flip: bool) -> Option<Self> {
        let Columns { x, y, z, t } = Columns::new(to_world)?;
        let normal = x.cross(y).normalize();
        let upright = Columns { x, y, z: normal, t };
        let [u, v, _] = upright.inverse_rows();
        let side = if (z.dot(normal) < 0.0) != flip { -1.0 } else { 1.0 };
        let sound = normal.is_finite() && u.is_finite() && v.is_finite();
        sound.then_some(Self { center: t, normal: normal * side, duals: [u, v], edges: [x, y] })
    }

    pub(crate) fn area(&self) -> f32 {
        4.0 * self.edges[0].cross(self.edges[1]).length()
    }

    /// Uniform over the area.
    #[inline(always)]
    pub(crate) fn sample(&self, [u, v]: [f32; 2]) -> Vec3 {
        self.center + self.edges[0] * (2.0 * u - 1.0) + self.edges[1] * (2.0 * v - 1.0)
    }
}

/// The distance at which a ray in `direction` meets the rectangle, infinite if it passes; `to_center` leads to the
/// centre from where it starts. To the plane, and whether that is inside the edges: without branches, for shapes or
/// rays side by side.
#[inline(always)]
pub(super) fn distance(to_center: Vec3, normal: Vec3, duals: [Vec3; 2], direction: Vec3) -> f32 {
    // 0/0 without a normal: NaN is not above 0.
    let t = normal.dot(to_center) / normal.dot(direction);
    let place = direction * t - to_center;
    let (u, v) = (duals[0].dot(place).abs(), duals[1].dot(place).abs());
    let met = (t > 0.0) & (u <= 1.0) & (v <= 1.0);
    if met { t } else { f32::INFINITY }
}
