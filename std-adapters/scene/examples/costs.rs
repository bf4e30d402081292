//! What scenes cost, for callgrind to count; `costs/run` says how. Prints a line per count, in their order: scene,
//! variant, samples.
//!
//! Variants: `everything`, the kernel that leaves nothing out, on three channels with auxiliaries; `needed`, the
//! kernel that is chosen, with auxiliaries where there are any; `plain`, the one without; `by-hand`, a loop that
//! knows its scene.

use core::hint::black_box;
use glam::{Vec3, vec3};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro128PlusPlus;
use ratiocv_core::Spectrum;
use ratiocv_scene::{BLOCK, BuiltIn, Colour, Description, Needs, Options, Samples, Scene};
use ratiocv_simd::{Work, at_best_level};

type Rgb = Spectrum<f32, 3>;

/// A block of samples of every 61st pixel.
#[inline(never)]
fn counted(trace: &mut dyn FnMut([u32; 2])) -> usize {
    let mut samples = 0;
    for pixel in (0..128 * 128).step_by(61) {
        trace([pixel % 128, pixel / 128]);
        samples += BLOCK;
    }
    samples
}

fn count<C: Colour>(scene: &Scene<C>) -> usize {
    let mut samples = Samples::new(scene);
    counted(&mut |pixel| {
        scene.trace(pixel, 0, BLOCK, 1, &mut samples);
        black_box(&mut samples);
    })
}

fn of<C: Colour>(description: &Description, auxiliary: bool) -> Scene<C> {
    let options = Options { auxiliary, ..Options::default() };
    Scene::new(description, &options).expect("a scene that comes with the crate")
}

/// S4b: a ball of radius 1, seen from (0, 0, 4) at 40°.
struct Furnace<'a> {
    pixel: [u32; 2],
    light: &'a mut [Vec3; BLOCK],
}

impl Work for Furnace<'_> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let (reflectance, environment) = (black_box(vec3(0.2, 0.5, 0.8)), black_box(vec3(1.0, 0.5, 2.0)));
        // tan 20°, over half of the pixels.
        let (half, pixel) = (0.363_970_24, 0.363_970_24 / 64.0);
        let mut random = Xoshiro128PlusPlus::seed_from_u64(u64::from(self.pixel[1]) << 32 | u64::from(self.pixel[0]));
        let mut uniform = || (random.next_u32() >> 8) as i32 as f32 * (f32::EPSILON / 2.0);
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

fn main() {
    let named: Vec<String> = std::env::args().skip(1).collect();
    for BuiltIn { name, .. } in BuiltIn::ALL {
        if !named.is_empty() && !named.iter().any(|n| n == name) {
            continue;
        }
        let description = Description::built_in(name).expect("a scene that comes with the crate");
        let needs = Needs::of(&description, &Options::default());
        let say = |variant: &str, samples: usize| println!("{name} {variant} {samples}");
        say("everything", count(&of::<Rgb>(&description, true).with_everything()));
        if needs.channels == 1 {
            say("needed", count(&of::<f32>(&description, true)));
            say("plain", count(&of::<f32>(&description, false)));
        } else {
            say("needed", count(&of::<Rgb>(&description, true)));
            say("plain", count(&of::<Rgb>(&description, false)));
        }
        if *name == "S4b" {
            let mut light = [Vec3::ZERO; BLOCK];
            say(
                "by-hand",
                counted(&mut |pixel| {
                    at_best_level(Furnace { pixel, light: &mut light });
                    black_box(&mut light);
                }),
            );
        }
    }
}
