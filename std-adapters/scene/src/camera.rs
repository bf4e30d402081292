//! Rays from the pinhole through a pixel.

use crate::description::{Description, Filter};
use crate::error::SceneError;
use crate::geometry::{Columns, Ray};
use crate::random::Random;
use glam::Vec3;

/// A pinhole, prepared: the direction through (x, y) in pixels from the upper left is `corner + x·right + y·down`.
#[derive(Clone, Debug)]
pub(crate) struct Camera {
    eye: Vec3,
    corner: Vec3,
    right: Vec3,
    down: Vec3,
    /// Half the width of a tent; 0: a box of one pixel.
    tent: f32,
}

impl Camera {
    /// As Mitsuba's perspective sensor: the angle of view is between the left and the right edge.
    pub(crate) fn new(scene: &Description) -> Result<Self, SceneError> {
        let Columns { x, y, z, t: eye } = Columns::new(&scene.camera.to_world).ok_or(SceneError::Camera)?;
        let fov = f64::from(scene.camera.fov);
        if !(fov > 0.0 && fov < 180.0) {
            return Err(SceneError::FieldOfView);
        }
        let [width, height] = scene.size;
        if width == 0 || height == 0 {
            return Err(SceneError::Size);
        }
        let tent = match scene.filter {
            Filter::Box => 0.0,
            Filter::Tent { radius } if radius > 0.0 && radius.is_finite() => radius,
            Filter::Tent { .. } => return Err(SceneError::Filter),
        };
        let half = libm::tan(fov.to_radians() / 2.0) as f32;
        let pixel = 2.0 * half / width as f32;
        // Camera space has +x to the left.
        let (left, up) = (x, y);
        Ok(Self {
            eye,
            corner: z + left * half + up * (0.5 * pixel * height as f32),
            right: left * -pixel,
            down: up * -pixel,
            tent,
        })
    }

    /// A ray through a point of pixel (x, y), as the filter distributes them.
    #[inline(always)]
    pub(crate) fn ray(&self, [x, y]: [u32; 2], random: &mut Random) -> Ray {
        let [a, b] = random.uniforms();
        let [a, b] = if self.tent > 0.0 { [self.in_tent(a), self.in_tent(b)] } else { [a, b] };
        self.through(x as f32 + a, y as f32 + b)
    }

    #[inline(always)]
    fn through(&self, x: f32, y: f32) -> Ray {
        Ray::new(self.eye, (self.corner + self.right * x + self.down * y).normalize())
    }

    /// The inverse of the tent's distribution, about the middle of a pixel.
    #[inline(always)]
    fn in_tent(&self, u: f32) -> f32 {
        let offset = if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() };
        0.5 + self.tent * offset
    }
}
