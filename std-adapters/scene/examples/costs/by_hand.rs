//! What loops by hand share.

use core::f32::consts::TAU;
use core::hint::black_box;
use glam::{Vec2, Vec3, vec2};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro128PlusPlus;
use ratiocv_scene::BLOCK;
use ratiocv_simd::Work;
use ratiocv_simd::functions::Elementary;

/// A scene that a loop knows: plain Monte Carlo, and nothing that another scene would need.
///
/// *Implemented by* the scenes of this folder; *called by* [`Block`].
pub(crate) trait ByHand: Copy {
    /// The light of one sample of the pixel's place `at`, in pixels.
    fn light(&self, at: Vec2, random: &mut Random) -> Vec3;
}

/// A block of samples of a pixel.
pub(crate) struct Block<'a, S> {
    pub(crate) scene: S,
    pub(crate) pixel: [u32; 2],
    pub(crate) light: &'a mut [Vec3; BLOCK],
}

impl<S: ByHand> Work for Block<'_, S> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        // The loop is known, the numbers in it are not.
        let scene = black_box(self.scene);
        let [x, y] = self.pixel;
        let mut random = Random(Xoshiro128PlusPlus::seed_from_u64(u64::from(y) << 32 | u64::from(x)));
        for light in self.light {
            let [u, v] = random.uniforms();
            *light = scene.light(vec2(x as f32 + u, y as f32 + v), &mut random);
        }
    }
}

pub(crate) struct Random(Xoshiro128PlusPlus);

impl Random {
    /// Uniform in [0, 1).
    #[inline(always)]
    pub(crate) fn uniform(&mut self) -> f32 {
        (self.0.next_u32() >> 8) as i32 as f32 * (f32::EPSILON / 2.0)
    }

    #[inline(always)]
    pub(crate) fn uniforms(&mut self) -> [f32; 2] {
        [self.uniform(), self.uniform()]
    }

    /// 0, 1 or 2.
    #[inline(always)]
    pub(crate) fn channel(&mut self) -> usize {
        (self.uniform() * 3.0) as usize
    }
}

/// A camera of 128 × 128 pixels.
#[derive(Clone, Copy)]
pub(crate) struct Camera {
    pub(crate) origin: Vec3,
    forward: Vec3,
    right: Vec3,
    up: Vec3,
}

impl Camera {
    /// One that sees `degrees` from left to right.
    pub(crate) fn new(origin: Vec3, target: Vec3, degrees: f32) -> Self {
        let half = (degrees.to_radians() / 2.0).tan();
        let forward = (target - origin).normalize();
        let right = forward.cross(Vec3::Y).normalize();
        Self { origin, forward, right: right * (half / 64.0), up: right.cross(forward) * (half / 64.0) }
    }

    #[inline(always)]
    pub(crate) fn direction(&self, at: Vec2) -> Vec3 {
        (self.forward + self.right * (at.x - 64.0) + self.up * (64.0 - at.y)).normalize()
    }
}

/// How far along a line its point nearest to the centre of a ball is behind its origin, and the square of half of what is
/// inside; negative if nothing is.
#[inline(always)]
fn nearest(origin: Vec3, direction: Vec3, center: Vec3, radius: f32) -> (f32, f32) {
    let from = origin - center;
    let b = from.dot(direction);
    let to_line = from - direction * b;
    (b, radius * radius - to_line.dot(to_line))
}

/// Where a line is inside a ball; nothing if it is not.
#[inline(always)]
pub(crate) fn through_ball(origin: Vec3, direction: Vec3, center: Vec3, radius: f32) -> Option<[f32; 2]> {
    let (b, discriminant) = nearest(origin, direction, center, radius);
    (discriminant > 0.0).then(|| [-b - discriminant.sqrt(), -b + discriminant.sqrt()])
}

/// The distance of a ball from outside or from its surface, infinite if it is missed.
#[inline(always)]
pub(crate) fn to_ball(origin: Vec3, direction: Vec3, center: Vec3, radius: f32) -> f32 {
    let (b, discriminant) = nearest(origin, direction, center, radius);
    if discriminant < 0.0 || b > 0.0 { f32::INFINITY } else { -b - discriminant.sqrt() }
}

/// cos and sin of 2πu, by Taylor's polynomials on ±π/4.
#[inline(always)]
fn turn(u: f32) -> [f32; 2] {
    let quarters = (4.0 * u + 0.5) as i32;
    let angle = (4.0 * u - quarters as f32) * core::f32::consts::FRAC_PI_2;
    let s = angle * angle;
    let sin = angle * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 - s / 5040.0)));
    let cos = 1.0 + s * (-0.5 + s * (1.0 / 24.0 + s * (-1.0 / 720.0 + s / 40_320.0)));
    let (cos, sin) = if quarters & 1 == 0 { (cos, sin) } else { (-sin, cos) };
    if quarters & 2 == 0 { [cos, sin] } else { [-cos, -sin] }
}

/// At the angle whose cosine is 1 − `versine` from +z.
#[inline(always)]
fn about_z(versine: f32, u: f32) -> Vec3 {
    let radius = (versine * (2.0 - versine)).max(0.0).sqrt();
    let [cos, sin] = turn(u);
    Vec3::new(radius * cos, radius * sin, 1.0 - versine)
}

/// Uniform on the sphere.
#[inline(always)]
pub(crate) fn uniform_direction([u, v]: [f32; 2]) -> Vec3 {
    about_z(2.0 * u, v)
}

/// By the cosine law, as uniform on the sphere about the tip of the normal: without a basis.
#[inline(always)]
pub(crate) fn cosine_direction(normal: Vec3, u: [f32; 2]) -> Vec3 {
    (normal + uniform_direction(u)).normalize()
}

/// Uniform in the cone in which a ball is seen, and its solid angle.
#[inline(always)]
pub(crate) fn towards_ball(to: Vec3, radius: f32, [u, v]: [f32; 2]) -> (Vec3, f32) {
    let square = to.dot(to);
    let sin2 = radius * radius / square;
    let cap = sin2 / (1.0 + (1.0 - sin2).sqrt());
    let axis = to / square.sqrt();
    let (side, other) = axis.any_orthonormal_pair();
    let local = about_z(u * cap, v);
    (axis * local.z + side * local.x + other * local.y, TAU * cap)
}

pub(crate) fn exponential(x: Vec3) -> Vec3 {
    let mut x = x.to_array();
    f32::exponentials(&mut x);
    Vec3::from_array(x)
}

pub(crate) fn mean(x: Vec3) -> f32 {
    x.element_sum() / 3.0
}
