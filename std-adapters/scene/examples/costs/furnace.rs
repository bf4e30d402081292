//! S4b, by a loop that knows it.

use crate::by_hand::{turn, uniform};
use core::hint::black_box;
use glam::{Vec3, vec3};
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro128PlusPlus;
use ratiocv_scene::BLOCK;
use ratiocv_simd::Work;

/// S4b: a ball of radius 1, seen from (0, 0, 4) at 40°.
pub(crate) struct Furnace<'a> {
    pub(crate) pixel: [u32; 2],
    pub(crate) light: &'a mut [Vec3; BLOCK],
}

impl Work for Furnace<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let (reflectance, environment) = (black_box(vec3(0.2, 0.5, 0.8)), black_box(vec3(1.0, 0.5, 2.0)));
        // tan 20°, over half of the pixels.
        let (half, pixel) = (0.363_970_24, 0.363_970_24 / 64.0);
        let mut random = Xoshiro128PlusPlus::seed_from_u64(u64::from(self.pixel[1]) << 32 | u64::from(self.pixel[0]));
        let mut uniform = || uniform(&mut random);
        for light in self.light {
            let (x, y) = (self.pixel[0] as f32 + uniform(), self.pixel[1] as f32 + uniform());
            let direction = vec3(x * pixel - half, half - y * pixel, -1.0).normalize();
            let origin = vec3(0.0, 0.0, 4.0);
            let b = origin.dot(direction);
            let to_line = origin - direction * b;
            let discriminant = 1.0 - to_line.dot(to_line);
            *light = environment;
            if discriminant >= 0.0 {
                let normal = (origin - direction * (b + discriminant.sqrt())).normalize();
                // Uniform on the sphere about the tip of the normal: the cosine law, without a basis.
                let z = 1.0 - 2.0 * uniform();
                let radius = (1.0 - z * z).sqrt();
                let [cos, sin] = turn(uniform());
                let scattered = (normal + vec3(radius * cos, radius * sin, z)).normalize();
                if normal.dot(scattered) > 0.0 {
                    *light *= reflectance;
                }
            }
        }
    }
}
