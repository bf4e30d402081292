//! Affine transforms, column by column.

use glam::{Affine3A, Vec3};

/// Where a transform takes the axes and the origin; its arithmetic is plain `f32` on every platform.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Columns {
    pub(crate) x: Vec3,
    pub(crate) y: Vec3,
    pub(crate) z: Vec3,
    pub(crate) t: Vec3,
}

impl Columns {
    /// `None` if it is singular, to rounding, or not finite.
    pub(crate) fn new(transform: &Affine3A) -> Option<Self> {
        let [x, y, z, t] = transform.to_cols_array_2d().map(Vec3::from_array);
        let columns = Self { x, y, z, t };
        let volume = columns.x.dot(columns.y.cross(columns.z)).abs();
        let box_volume = x.length() * y.length() * z.length();
        let sound = volume > 1e-6 * box_volume && box_volume.is_finite() && t.is_finite();
        sound.then_some(columns)
    }

    /// The rows of the inverse of its linear part: the axes' own coordinates.
    pub(crate) fn inverse_rows(&self) -> [Vec3; 3] {
        let [yz, zx, xy] = [self.y.cross(self.z), self.z.cross(self.x), self.x.cross(self.y)];
        let determinant = self.x.dot(yz);
        [yz / determinant, zx / determinant, xy / determinant]
    }
}
