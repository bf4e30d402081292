//! S1 and its kin, by loops that know them: the camera sees the ball or the floor and nothing else, no light hides
//! another one from what is seen, and the ball alone throws shadows.

use crate::by_hand::{ByHand, Camera, Random, to_ball, towards_ball};
use core::f32::consts::{FRAC_1_PI, TAU};
use glam::{Vec2, Vec3, vec3};

const BALL: Vec3 = vec3(0.0, 1.0, 0.0);

/// Spheres of light over a floor, and over a ball if there is one; chosen by √Σ radiance², cosine and distance.
#[derive(Clone, Copy)]
pub(crate) struct Lights<const N: usize, const BALL: bool> {
    camera: Camera,
    radius: f32,
    centers: [Vec3; N],
    radiance: [Vec3; N],
    importance: [f32; N],
}

impl<const N: usize, const BALL: bool> Lights<N, BALL> {
    fn new(radius: f32, lights: [(Vec3, Vec3); N]) -> Self {
        Self {
            camera: Camera::new(vec3(0.0, 5.0, 6.0), vec3(0.0, 0.6, 0.0), 36.0),
            radius,
            centers: lights.map(|(center, _)| center),
            radiance: lights.map(|(_, radiance)| radiance),
            importance: lights.map(|(_, radiance)| radiance.length()),
        }
    }
}

fn three(radiance: [Vec3; 3]) -> [(Vec3, Vec3); 3] {
    let [red, green, blue] = radiance;
    [(vec3(-3.0, 4.0, 2.0), red), (vec3(3.0, 4.0, 2.0), green), (vec3(0.0, 5.0, -3.0), blue)]
}

/// S1, or without the ball S4f.
pub(crate) fn s1<const BALL: bool>() -> Lights<3, BALL> {
    Lights::new(0.1, three([vec3(3000.0, 5.0, 6.0), vec3(3.0, 3000.0, 4.0), vec3(4.8, 5.8, 3000.0)]))
}

pub(crate) fn s1b() -> Lights<3, true> {
    Lights::new(0.5, three([vec3(120.0, 0.2, 0.24), vec3(0.12, 120.0, 0.16), vec3(0.192, 0.232, 120.0)]))
}

pub(crate) fn s1k() -> Lights<24, true> {
    Lights::new(
        0.1,
        core::array::from_fn(|i| {
            let (q, (sin, cos)) = (3.0 + 2.0 * (i % 2) as f32, (TAU * i as f32 / 24.0).sin_cos());
            let hump = |j: f32| (TAU * (0.381_966 * i as f32 - j / 3.0)).cos().max(0.0);
            (
                vec3(q * cos, 3.0 + (i % 3) as f32, q * sin),
                vec3(0.0, 1.0, 2.0).map(|j| 500.0 * (0.02 + hump(j) * hump(j))),
            )
        }),
    )
}

impl<const N: usize, const WITH_BALL: bool> ByHand for Lights<N, WITH_BALL> {
    #[inline(always)]
    fn light(&self, at: Vec2, random: &mut Random) -> Vec3 {
        let (origin, direction) = (self.camera.origin, self.camera.direction(at));
        let t = if WITH_BALL { to_ball(origin, direction, BALL, 1.0) } else { f32::INFINITY };
        let (place, normal, reflectance) = if t < f32::INFINITY {
            let normal = (origin + direction * t - BALL).normalize();
            (BALL + normal, normal, 0.7)
        } else {
            (origin - direction * (origin.y / direction.y), Vec3::Y, 0.5)
        };
        let mut weights = [0.0; N];
        for ((weight, center), importance) in weights.iter_mut().zip(&self.centers).zip(&self.importance) {
            let to = *center - place;
            let square = to.dot(to);
            let inverse = 1.0 / square.sqrt();
            let (cos, sin) = (normal.dot(to) * inverse, self.radius * inverse);
            let seen = if cos >= sin { cos } else { (cos + sin) * (cos + sin) * 0.25 / sin };
            *weight = if cos > -sin { importance * seen / square } else { 0.0 };
        }
        let total: f32 = weights.iter().sum();
        let (chosen, u) = (random.uniform() * total, random.uniforms());
        let (mut i, mut below) = (0, weights[0]);
        while i + 1 < N && chosen >= below {
            i += 1;
            below += weights[i];
        }
        if weights[i] <= 0.0 {
            return Vec3::ZERO;
        }
        let (towards, solid_angle) = towards_ball(self.centers[i] - place, self.radius, u);
        let cos = normal.dot(towards);
        if cos > 0.0 && (!WITH_BALL || normal != Vec3::Y || to_ball(place, towards, BALL, 1.0) == f32::INFINITY) {
            self.radiance[i] * (reflectance * FRAC_1_PI * cos * solid_angle * total / weights[i])
        } else {
            Vec3::ZERO
        }
    }
}
