//! S4a to S4e and S4g, by loops that know them: one ball of radius 1 before an even sky, seen from (0, 0, 4) at 40°, or
//! the inside of a large one.

use crate::by_hand::{
    ByHand, Camera, Random, cosine_direction, exponential, mean, through_ball, to_ball, uniform_direction,
};
use crate::conductor::{Basis, Conductor};
use glam::{Vec2, Vec3, vec3};
use ratiocv_simd::functions::Elementary;

fn camera() -> Camera {
    Camera::new(vec3(0.0, 0.0, 4.0), Vec3::ZERO, 40.0)
}

/// S4a, where channels are alike, and S4b: a diffuse ball.
#[derive(Clone, Copy)]
pub(crate) struct Diffuse<const GREY: bool> {
    camera: Camera,
    reflectance: Vec3,
    sky: Vec3,
}

pub(crate) fn s4a() -> Diffuse<true> {
    Diffuse { camera: camera(), reflectance: Vec3::ONE, sky: Vec3::ONE }
}

pub(crate) fn s4b() -> Diffuse<false> {
    Diffuse { camera: camera(), reflectance: vec3(0.2, 0.5, 0.8), sky: vec3(1.0, 0.5, 2.0) }
}

impl<const GREY: bool> ByHand for Diffuse<GREY> {
    #[inline(always)]
    fn light(&self, at: Vec2, random: &mut Random) -> Vec3 {
        let (origin, direction) = (self.camera.origin, self.camera.direction(at));
        let t = to_ball(origin, direction, Vec3::ZERO, 1.0);
        let mut reflected = true;
        if t < f32::INFINITY {
            let normal = (origin + direction * t).normalize();
            reflected = normal.dot(cosine_direction(normal, random.uniforms())) > 0.0;
        }
        let missed = t == f32::INFINITY;
        if GREY {
            let reflectance = if missed { 1.0 } else { self.reflectance.x };
            Vec3::splat(if reflected { self.sky.x * reflectance } else { 0.0 })
        } else if reflected {
            if missed { self.sky } else { self.sky * self.reflectance }
        } else {
            Vec3::ZERO
        }
    }
}

/// S4c: inside a ball of radius 10 that glows; four bounces. What is met is counted, nothing is sent for.
#[derive(Clone, Copy)]
pub(crate) struct Inside {
    camera: Camera,
    reflectance: Vec3,
    radiance: Vec3,
}

pub(crate) fn s4c() -> Inside {
    Inside { camera: camera(), reflectance: vec3(0.2, 0.5, 0.8), radiance: Vec3::ONE }
}

impl ByHand for Inside {
    #[inline(always)]
    fn light(&self, at: Vec2, random: &mut Random) -> Vec3 {
        let (mut place, mut direction) = (self.camera.origin, self.camera.direction(at));
        let (mut light, mut throughput) = (Vec3::ZERO, Vec3::ONE);
        for depth in 1..=5 {
            let Some([_, far]) = through_ball(place, direction, Vec3::ZERO, 10.0) else { break };
            light += throughput * self.radiance;
            if depth == 5 {
                break;
            }
            throughput *= self.reflectance;
            let normal = -(place + direction * far).normalize();
            place = normal * -10.0;
            direction = cosine_direction(normal, random.uniforms());
        }
        light
    }
}

/// S4d: a ball that absorbs.
#[derive(Clone, Copy)]
pub(crate) struct Absorbing {
    camera: Camera,
    extinction: Vec3,
}

pub(crate) fn s4d() -> Absorbing {
    Absorbing { camera: camera(), extinction: vec3(0.2, 1.0, 5.0) }
}

impl ByHand for Absorbing {
    #[inline(always)]
    fn light(&self, at: Vec2, _: &mut Random) -> Vec3 {
        let through = through_ball(self.camera.origin, self.camera.direction(at), Vec3::ZERO, 1.0);
        through.map_or(Vec3::ONE, |[near, far]| exponential(self.extinction * (near - far)))
    }
}

/// S4e: a ball that scatters all and absorbs nothing, so that what a path carries is P_j/M, h itself. Roulette from
/// depth 64 on.
#[derive(Clone, Copy)]
pub(crate) struct Scattering {
    camera: Camera,
    extinction: Vec3,
}

pub(crate) fn s4e() -> Scattering {
    Scattering { camera: camera(), extinction: vec3(0.2, 1.0, 5.0) }
}

impl ByHand for Scattering {
    #[inline(always)]
    fn light(&self, at: Vec2, random: &mut Random) -> Vec3 {
        let (mut place, mut direction) = (self.camera.origin, self.camera.direction(at));
        let channel = random.channel();
        let (mut h, mut weight) = (Vec3::ONE, 1.0);
        for depth in 1.. {
            let Some([near, far]) = through_ball(place, direction, Vec3::ZERO, 1.0) else { break };
            let near = near.max(0.0);
            let t = near - (1.0 - random.uniform()).logarithm() / self.extinction[channel];
            let passed = exponential(self.extinction * (near - t.min(far)));
            let density = h * if t < far { passed * self.extinction } else { passed };
            h = density / mean(density);
            if t >= far {
                break;
            }
            place += direction * t;
            direction = uniform_direction(random.uniforms());
            if depth + 1 >= 64 {
                let survival = (h.max_element() * weight).min(0.95);
                if random.uniform() >= survival {
                    return Vec3::ZERO;
                }
                weight /= survival;
            }
        }
        h * weight
    }
}

/// S4g: a conductor.
#[derive(Clone, Copy)]
pub(crate) struct Reflecting {
    camera: Camera,
    conductor: Conductor,
}

pub(crate) fn s4g() -> Reflecting {
    Reflecting { camera: camera(), conductor: Conductor { reflectance: 1.0, roughness: vec3(0.05, 0.2, 0.5) } }
}

impl ByHand for Reflecting {
    #[inline(always)]
    fn light(&self, at: Vec2, random: &mut Random) -> Vec3 {
        let (origin, direction) = (self.camera.origin, self.camera.direction(at));
        let t = to_ball(origin, direction, Vec3::ZERO, 1.0);
        if t == f32::INFINITY {
            return Vec3::ONE;
        }
        let wi = Basis::about((origin + direction * t).normalize()).local(-direction);
        let (wo, half) = self.conductor.sample(random.channel(), wi, random.uniforms());
        if wo.z <= 0.0 {
            return Vec3::ZERO;
        }
        let density = self.conductor.density(wi, half);
        self.conductor.over_density(wo) * density / mean(density)
    }
}
