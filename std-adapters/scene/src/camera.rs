//! Rays from the pinhole through a pixel.

use crate::description::{Description, Filter};
use crate::error::SceneError;
use crate::geometry::{Beam, Columns};
use crate::planted::planted;
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

    /// Rays through points of pixel (x, y), as the filter distributes them.
    #[inline(always)]
    pub(crate) fn rays(&self, [x, y]: [u32; 2], random: &mut Random) -> Beam {
        let [mut a, mut b] = [random.lane(), random.lane()];
        if self.tent > 0.0 {
            for u in a.iter_mut().chain(&mut b) {
                *u = self.in_tent(*u);
            }
        }
        let (x, y) = (x as f32, y as f32);
        Beam::new(self.eye, |lane| self.corner + self.right * (x + a[lane]) + self.down * (y + b[lane]))
    }

    /// The inverse of the tent's distribution, about the middle of a pixel.
    #[inline(always)]
    fn in_tent(&self, u: f32) -> f32 {
        let offset = if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() };
        0.5 + self.tent * planted!("tent_of_half_the_width": offset, 0.5 * offset)
    }
}
