//! S2 and S2w, by a loop that knows them: the inside of a box that is open towards the camera, two conductors in it, and
//! a light under its ceiling, which light is sent to and rays meet.

use crate::by_hand::{ByHand, Camera, Random, cosine_direction, mean, to_ball};
use crate::conductor::{Basis, Conductor};
use core::f32::consts::FRAC_1_PI;
use glam::{Vec2, Vec3, vec3};

const LIGHT_HEIGHT: f32 = 0.99;
const FRONT: f32 = 1.5;
/// White, red, green.
const WALLS: [Vec3; 3] = [Vec3::splat(0.73), vec3(0.63, 0.065, 0.05), vec3(0.14, 0.45, 0.091)];
const SCATTERINGS: usize = 3;

#[derive(Clone, Copy)]
struct Ball {
    center: Vec3,
    radius: f32,
    conductor: Conductor,
}

#[derive(Clone, Copy)]
pub(crate) struct Room {
    camera: Camera,
    walls: [Vec3; 3],
    balls: [Ball; 2],
    half_light: f32,
    radiance: Vec3,
}

fn room(half_light: f32, radiance: Vec3) -> Room {
    let ball =
        |center, radius, roughness| Ball { center, radius, conductor: Conductor { reflectance: 0.9, roughness } };
    Room {
        camera: Camera::new(vec3(0.0, 0.1, 3.9), vec3(0.0, -0.45, 0.0), 30.0),
        walls: WALLS,
        balls: [
            ball(vec3(-0.42, -0.55, -0.25), 0.45, vec3(0.05, 0.2, 0.5)),
            ball(vec3(0.5, -0.6, 0.45), 0.4, vec3(0.4, 0.15, 0.05)),
        ],
        half_light,
        radiance,
    }
}

pub(crate) fn s2() -> Room {
    room(0.25, vec3(17.0, 12.0, 4.0))
}

pub(crate) fn s2w() -> Room {
    room(0.9, vec3(1.3, 0.93, 0.31))
}

/// What a ray meets.
enum Met {
    Wall {
        t: f32,
        normal: Vec3,
        reflectance: Vec3,
    },
    Ball {
        t: f32,
        ball: usize,
    },
    /// From below: the cosine at the light is that of the ray.
    Light {
        t: f32,
    },
    Nothing,
}

impl Room {
    #[inline(always)]
    fn meets(&self, origin: Vec3, direction: Vec3) -> Met {
        let [a, b] = self.balls.map(|ball| to_ball(origin, direction, ball.center, ball.radius));
        let (ball, to_ball) = if a < b { (0, a) } else { (1, b) };
        // The box is convex, and rays come from inside or through its front.
        let inverse = direction.recip();
        let far = (Vec3::ONE.copysign(direction) - origin) * inverse;
        let front = if direction.z > 0.0 { (FRONT - origin.z) * inverse.z } else { far.z };
        let t = far.x.min(far.y).min(front);
        let to_light = (LIGHT_HEIGHT - origin.y) * inverse.y;
        let at = origin + direction * to_light;
        if to_light > 0.0 && to_light < t.min(to_ball) && at.x.abs().max(at.z.abs()) <= self.half_light {
            return if direction.y > 0.0 { Met::Light { t: to_light } } else { Met::Nothing };
        }
        if to_ball < t {
            return Met::Ball { t: to_ball, ball };
        }
        if t == far.x {
            let left = direction.x < 0.0;
            let normal = if left { Vec3::X } else { Vec3::NEG_X };
            Met::Wall { t, normal, reflectance: self.walls[if left { 1 } else { 2 }] }
        } else if t == far.y {
            Met::Wall { t, normal: vec3(0.0, -1.0_f32.copysign(direction.y), 0.0), reflectance: self.walls[0] }
        } else if direction.z < 0.0 {
            Met::Wall { t, normal: Vec3::Z, reflectance: self.walls[0] }
        } else {
            Met::Nothing
        }
    }
}

impl ByHand for Room {
    #[inline(always)]
    fn light(&self, at: Vec2, random: &mut Random) -> Vec3 {
        let (mut place, mut direction) = (self.camera.origin, self.camera.direction(at));
        let channel = random.channel();
        let (mut light, mut throughput, mut h) = (Vec3::ZERO, Vec3::ONE, Vec3::ONE);
        let area = 4.0 * self.half_light * self.half_light;
        // The density of the ray's direction.
        let mut density = 0.0;
        for scattering in 0..=SCATTERINGS {
            let (normal, reflectance, ball) = match self.meets(place, direction) {
                Met::Light { t } => {
                    // Balance, with the light's density t²/(cos·area).
                    let weight = 1.0 / (1.0 + t * t / (direction.y * area * density));
                    return light + throughput * self.radiance * weight;
                }
                Met::Nothing => return light,
                Met::Wall { t, normal, reflectance } => {
                    place += direction * t;
                    (normal, reflectance, None)
                }
                Met::Ball { t, ball } => {
                    let Ball { center, radius, conductor } = self.balls[ball];
                    let normal = (place + direction * t - center).normalize();
                    place = center + normal * radius;
                    (normal, Vec3::ZERO, Some(conductor))
                }
            };
            if scattering == SCATTERINGS {
                return light;
            }
            // Nothing comes back to a wall that it left.
            let place_off = place + normal * 1e-5;
            let basis = Basis::about(normal);
            let wi = basis.local(-direction);
            let [u, v] = random.uniforms();
            let point = vec3((2.0 * u - 1.0) * self.half_light, LIGHT_HEIGHT, (2.0 * v - 1.0) * self.half_light);
            let to = point - place;
            let square = to.dot(to);
            let towards = to / square.sqrt();
            let cos = normal.dot(towards);
            let is_dark = |ball: &Ball| to_ball(place_off, towards, ball.center, ball.radius) * towards.y < to.y;
            if cos > 0.0 && towards.y > 0.0 && !self.balls.iter().any(is_dark) {
                let inverse = towards.y * area / square;
                let (f, densities) = match ball {
                    None => (reflectance * (cos * FRAC_1_PI), Vec3::splat(cos * FRAC_1_PI)),
                    Some(conductor) => {
                        let wo = basis.local(towards);
                        let densities = conductor.density(wi, (wi + wo).normalize());
                        (conductor.over_density(wo) * densities, densities)
                    }
                };
                light += throughput * f * self.radiance * (inverse / (1.0 + mean(h * densities) * inverse));
            }
            match ball {
                None => {
                    direction = cosine_direction(normal, random.uniforms());
                    density = normal.dot(direction) * FRAC_1_PI;
                    if density <= 0.0 {
                        return light;
                    }
                    // The mean of h is 1.
                    throughput *= reflectance;
                }
                Some(conductor) => {
                    let (wo, half) = conductor.sample(channel, wi, random.uniforms());
                    if wo.z <= 0.0 {
                        return light;
                    }
                    let densities = conductor.density(wi, half);
                    density = mean(h * densities);
                    throughput *= conductor.over_density(wo) * densities / density;
                    h *= densities / density;
                    direction = basis.world(wo);
                }
            }
            place = place_off;
        }
        light
    }
}
