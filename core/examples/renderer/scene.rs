//! What is seen, from where, and what rays and random numbers need.

use ratiocv_core::{Lanes, Spectrum};

/// Red, green and blue; a point or a direction as well.
pub type Rgb = Spectrum<f32, 3>;

/// A diffuse ball with an albedo, or a light with a radiance; the camera sees no light.
pub struct Sphere {
    pub centre: Rgb,
    pub radius: f32,
    pub colour: Rgb,
}

const fn sphere(centre: [f32; 3], radius: f32, colour: [f32; 3]) -> Sphere {
    Sphere { centre: Spectrum(centre), radius, colour: Spectrum(colour) }
}

pub const EYE: Rgb = Spectrum([0.0, 1.5, 6.0]);
pub const SKY: Rgb = Spectrum([0.1, 0.2, 0.4]);
pub const BALLS: [Sphere; 3] = [
    sphere([0.0, -20.0, 0.0], 20.0, [0.6, 0.6, 0.6]),
    sphere([-1.1, 0.9, 0.0], 1.0, [0.8, 0.5, 0.3]),
    sphere([1.2, 0.6, 0.8], 0.7, [0.3, 0.6, 0.8]),
];
pub const LIGHTS: [Sphere; 2] =
    [sphere([-3.0, 5.0, 3.0], 0.4, [200.0, 80.0, 8.0]), sphere([3.0, 4.0, 3.0], 0.3, [10.0, 60.0, 260.0])];

/// The direction of the camera ray through the middle of pixel (x, y) of a picture.
pub fn camera(x: usize, y: usize, width: usize, height: usize) -> Rgb {
    let [right, down] = [(x, width), (y, height)].map(|(i, n)| i as f32 + 0.5 - 0.5 * n as f32);
    let height = height as f32;
    unit(Spectrum([right, -down - 0.2 * height, -1.4 * height])) // a little downwards
}

/// The directions from a point to a sphere.
pub struct Cone {
    axis: Rgb,
    pub distance: f32,
    /// 1 − cos of the half-angle: the solid angle over 2π.
    pub height: f32,
}

impl Cone {
    pub fn of(light: &Sphere, point: Rgb) -> Self {
        let to_light = light.centre - point;
        let distance = libm::sqrtf(dot(to_light, to_light));
        let sine = light.radius / distance;
        let height = sine * sine / (1.0 + libm::sqrtf(1.0 - sine * sine));
        Self { axis: to_light / Rgb::splat(distance), distance, height }
    }

    /// Uniform in the cone, in the frame of Duff et al. (2017).
    pub fn direction(&self, random: &mut Random) -> Rgb {
        let up = random.number() * self.height;
        let (sin, cos) = libm::sincosf(core::f32::consts::TAU * random.number());
        let sine = libm::sqrtf(up * (2.0 - up));
        let Spectrum([x, y, z]) = self.axis;
        let sign = 1.0_f32.copysign(z);
        let a = -1.0 / (sign + z);
        let u = Spectrum([1.0 + sign * x * x * a, sign * x * y * a, -sign * x]);
        let v = Spectrum([x * y * a, sign + y * y * a, -y]);
        u * Rgb::splat(sine * cos) + v * Rgb::splat(sine * sin) + self.axis * Rgb::splat(1.0 - up)
    }
}

/// The nearest ball along a ray, and how far it is.
pub fn nearest(from: Rgb, direction: Rgb) -> Option<(f32, &'static Sphere)> {
    let mut found: Option<(f32, &'static Sphere)> = None;
    for ball in &BALLS {
        let back = from - ball.centre;
        let along = dot(back, direction);
        let discriminant = along * along - (dot(back, back) - ball.radius * ball.radius);
        let distance = -along - libm::sqrtf(discriminant); // NaN on a miss, which is not more than anything
        if distance > 1e-3 && found.is_none_or(|(least, _)| distance < least) {
            found = Some((distance, ball));
        }
    }
    found
}

/// PCG-XSH-RR (O'Neill 2014).
pub struct Random(pub u64);

impl Random {
    /// Uniform in [0, 1).
    pub fn number(&mut self) -> f32 {
        let old = self.0;
        self.0 = old.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let bits = ((((old >> 18) ^ old) >> 27) as u32).rotate_right((old >> 59) as u32);
        (bits >> 8) as f32 / 16_777_216.0
    }
}

pub fn dot(a: Rgb, b: Rgb) -> f32 {
    let Spectrum([x, y, z]) = a * b;
    x + y + z
}

pub fn unit(a: Rgb) -> Rgb {
    a / Rgb::splat(libm::sqrtf(dot(a, a)))
}

pub fn luminance(a: Rgb) -> f32 {
    dot(a, Spectrum([0.2126, 0.7152, 0.0722]))
}
