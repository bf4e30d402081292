//! S1, by a loop that knows it: the camera sees the ball or the floor and nothing else, no light hides another one
//! from what is seen, and the ball alone throws shadows.

use crate::by_hand::{turn, uniform};
use core::f32::consts::{FRAC_1_PI, TAU};
use core::hint::black_box;
use glam::{Vec3, vec3};
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro128PlusPlus;
use ratiocv_scene::BLOCK;
use ratiocv_simd::Work;

const LIGHTS: [(Vec3, Vec3); 3] = [
    (vec3(-3.0, 4.0, 2.0), vec3(3000.0, 5.0, 6.0)),
    (vec3(3.0, 4.0, 2.0), vec3(3.0, 3000.0, 4.0)),
    (vec3(0.0, 5.0, -3.0), vec3(4.8, 5.8, 3000.0)),
];
const RADIUS: f32 = 0.1;
const BALL: Vec3 = vec3(0.0, 1.0, 0.0);

/// Plain Monte Carlo; lights chosen by √Σ radiance², cosine and distance.
pub(crate) struct ThreeLights<'a> {
    pub(crate) pixel: [u32; 2],
    pub(crate) light: &'a mut [Vec3; BLOCK],
}

impl Work for ThreeLights<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let lights = black_box(LIGHTS);
        let (origin, target) = (vec3(0.0, 5.0, 6.0), vec3(0.0, 0.6, 0.0));
        let forward = (target - origin).normalize();
        let right = forward.cross(Vec3::Y).normalize();
        let up = right.cross(forward);
        // tan 18°, over half of the pixels.
        let (half, pixel) = (0.324_919_7, 0.324_919_7 / 64.0);
        let importance = lights.map(|(_, radiance)| radiance.length());
        let mut random = Xoshiro128PlusPlus::seed_from_u64(u64::from(self.pixel[1]) << 32 | u64::from(self.pixel[0]));
        let mut uniform = || uniform(&mut random);
        for light in self.light {
            *light = Vec3::ZERO;
            let (x, y) = (self.pixel[0] as f32 + uniform(), self.pixel[1] as f32 + uniform());
            let direction = (forward + right * (x * pixel - half) + up * (half - y * pixel)).normalize();
            let t = to_ball(origin, direction);
            let (place, normal, reflectance) = if t < f32::INFINITY {
                let normal = (origin + direction * t - BALL).normalize();
                (BALL + normal, normal, 0.7)
            } else {
                (origin - direction * (origin.y / direction.y), Vec3::Y, 0.5)
            };
            let mut weights = [0.0; 3];
            for i in 0..3 {
                let to = lights[i].0 - place;
                let square = to.dot(to);
                let inverse = 1.0 / square.sqrt();
                let (cos, sin) = (normal.dot(to) * inverse, RADIUS * inverse);
                let seen = if cos >= sin { cos } else { (cos + sin) * (cos + sin) * 0.25 / sin };
                weights[i] = if cos > -sin { importance[i] * seen / square } else { 0.0 };
            }
            let total = weights[0] + weights[1] + weights[2];
            let (chosen, u, v) = (uniform() * total, uniform(), uniform());
            let i = usize::from(chosen >= weights[0]) + usize::from(chosen >= weights[0] + weights[1]);
            if weights[i] <= 0.0 {
                continue;
            }
            // The cone in which the light is seen.
            let to = lights[i].0 - place;
            let square = to.dot(to);
            let distance = square.sqrt();
            let sin2 = RADIUS * RADIUS / square;
            let cap = sin2 / (1.0 + (1.0 - sin2).sqrt());
            let versine = u * cap;
            let sin = (versine * (2.0 - versine)).sqrt();
            let [c, s] = turn(v);
            let axis = to / distance;
            let (side, other) = axis.any_orthonormal_pair();
            let towards = axis * (1.0 - versine) + side * (sin * c) + other * (sin * s);
            let cos = normal.dot(towards);
            if cos > 0.0 && (normal != Vec3::Y || to_ball(place, towards) == f32::INFINITY) {
                *light = lights[i].1 * (reflectance * FRAC_1_PI * cos * TAU * cap * total / weights[i]);
            }
        }
    }
}

/// The distance of the ball, infinite if it is missed.
#[inline(always)]
fn to_ball(origin: Vec3, direction: Vec3) -> f32 {
    let from = origin - BALL;
    let b = from.dot(direction);
    let to_line = from - direction * b;
    let discriminant = 1.0 - to_line.dot(to_line);
    if discriminant < 0.0 || b > 0.0 { f32::INFINITY } else { -b - discriminant.sqrt() }
}
