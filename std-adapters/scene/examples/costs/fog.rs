//! S3 and S3m, by a loop that knows them: a cube of fog above a floor, and a sphere of light that nothing hides and that
//! no ray but those sent to it counts.

use crate::by_hand::{ByHand, Camera, Random, cosine_direction, exponential, mean, towards_ball, uniform_direction};
use core::f32::consts::FRAC_1_PI;
use glam::{Vec2, Vec3, vec3};
use ratiocv_simd::functions::Elementary;

const FLOOR: f32 = -1.5;

/// `SCATTERINGS` at most.
#[derive(Clone, Copy)]
pub(crate) struct Fog<const SCATTERINGS: usize> {
    camera: Camera,
    extinction: Vec3,
    albedo: f32,
    reflectance: f32,
    light: Vec3,
    radius: f32,
    radiance: Vec3,
}

pub(crate) fn s3<const SCATTERINGS: usize>() -> Fog<SCATTERINGS> {
    Fog {
        camera: Camera::new(vec3(0.0, 2.5, 5.0), vec3(0.0, -0.3, 0.0), 36.0),
        extinction: vec3(0.2, 1.0, 5.0),
        albedo: 0.9,
        reflectance: 0.5,
        light: vec3(1.5, 3.0, 2.0),
        radius: 0.5,
        radiance: Vec3::splat(40.0),
    }
}

/// Where a ray is in the cube [−1, 1]³: empty if the second number is not the greater one.
#[inline(always)]
fn in_cube(origin: Vec3, direction: Vec3) -> [f32; 2] {
    let inverse = direction.recip();
    let (a, b) = ((Vec3::NEG_ONE - origin) * inverse, (Vec3::ONE - origin) * inverse);
    [a.min(b).max_element().max(0.0), a.max(b).min_element()]
}

impl<const SCATTERINGS: usize> ByHand for Fog<SCATTERINGS> {
    #[inline(always)]
    fn light(&self, at: Vec2, random: &mut Random) -> Vec3 {
        let (mut place, mut direction) = (self.camera.origin, self.camera.direction(at));
        let channel = random.channel();
        let (mut light, mut throughput, mut h) = (Vec3::ZERO, Vec3::ONE, Vec3::ONE);
        for scattering in 1..=SCATTERINGS {
            let [near, far] = in_cube(place, direction);
            let mut scattered = f32::INFINITY;
            if near < far {
                let t = near - (1.0 - random.uniform()).logarithm() / self.extinction[channel];
                let passed = exponential(self.extinction * (near - t.min(far)));
                let density = if t < far { passed * self.extinction } else { passed };
                let ratio = density / mean(h * density);
                throughput *= ratio;
                h *= ratio;
                if t < far {
                    throughput *= self.albedo;
                    scattered = t;
                }
            }
            let in_fog = scattered < f32::INFINITY;
            if in_fog {
                place += direction * scattered;
            } else {
                let t = (FLOOR - place.y) / direction.y;
                if t.is_nan() || t <= 0.0 {
                    break;
                }
                place += direction * t;
                place.y = FLOOR;
                if place.x.abs().max(place.z.abs()) > 20.0 {
                    break;
                }
            }
            let (towards, solid_angle) = towards_ball(self.light - place, self.radius, random.uniforms());
            let scattered = if in_fog { 0.25 * FRAC_1_PI } else { self.reflectance * FRAC_1_PI * towards.y };
            let [near, far] = in_cube(place, towards);
            let through = exponential(self.extinction * -(far - near).max(0.0));
            light += throughput * through * self.radiance * (scattered * solid_angle);
            if scattering == SCATTERINGS {
                break;
            }
            direction = if in_fog {
                uniform_direction(random.uniforms())
            } else {
                throughput *= self.reflectance;
                cosine_direction(Vec3::Y, random.uniforms())
            };
        }
        light
    }
}
