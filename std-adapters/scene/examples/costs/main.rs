//! What scenes cost, for callgrind to count; `costs/run` says how. Prints a line per count, in their order: scene,
//! variant, samples.
//!
//! Variants: `everything`, the kernel that leaves nothing out, on three channels with auxiliaries; `needed`, the
//! kernel that is chosen, with auxiliaries where there are any; `plain`, the one without; `by-hand`, a loop that
//! knows its scene. `render` and `render-plain` are whole renders at 64 samples by the defensive ratio and by plain
//! Monte Carlo: kernels, what is kept of pixels, and the estimates.

mod by_hand;
mod conductor;
mod fog;
mod furnace;
mod lights;
mod room;

use by_hand::{Block, ByHand};
use core::hint::black_box;
use glam::{DVec3, Vec3};
use ratiocv_core::Spectrum;
use ratiocv_scene::{BLOCK, Budget, BuiltIn, Colour, Description, Method, Needs, Options, Render, Samples, Scene};
use ratiocv_simd::at_best_level;
use rayon::ThreadPoolBuilder;

type Rgb = Spectrum<f32, 3>;

/// Every 61st pixel.
fn pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..128 * 128).step_by(61).map(|pixel| [pixel % 128, pixel / 128])
}

/// What callgrind counts.
#[inline(never)]
fn counted(work: &mut dyn FnMut() -> usize) -> usize {
    work()
}

/// A block of samples of each pixel.
fn blocks(mut trace: impl FnMut([u32; 2])) -> usize {
    counted(&mut || {
        pixels().for_each(&mut trace);
        pixels().count() * BLOCK
    })
}

fn count<C: Colour>(scene: &Scene<C>) -> usize {
    let mut samples = Samples::new(scene);
    blocks(|pixel| {
        scene.trace(pixel, 0, BLOCK, 1, &mut samples);
        black_box(&mut samples);
    })
}

/// 16 × 16 pixels, 64 samples each, by one thread.
fn render(description: &Description, method: Method) -> usize {
    let render = Render::new(description).method(method).budget(Budget::Samples(64));
    let pool = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    pool.install(|| counted(&mut || render.run().expect("a scene that comes with the crate").samples as usize))
}

fn of<C: Colour>(description: &Description, auxiliary: bool) -> Scene<C> {
    let options = Options { auxiliary, ..Options::default() };
    Scene::new(description, &options).expect("a scene that comes with the crate")
}

/// Mean and squared standard error per channel of what a loop by hand yields.
fn mean(trace: impl Fn([u32; 2], &mut [Vec3; BLOCK])) -> [Vec3; 2] {
    // Not `counted`.
    let (mut sum, mut squares, mut light) = (DVec3::ZERO, DVec3::ZERO, [Vec3::ZERO; BLOCK]);
    for pixel in pixels() {
        trace(pixel, &mut light);
        for light in light.map(|light| light.as_dvec3()) {
            sum += light;
            squares += light * light;
        }
    }
    let n = (pixels().count() * BLOCK) as f64;
    // What is the same everywhere has no variance but rounding.
    let variance = (squares / n - sum / n * (sum / n)).max(DVec3::ZERO);
    [(sum / n).as_vec3(), (variance / n).as_vec3()]
}

/// A loop by hand, once it is seen to have the scene's own mean: N = 17 216, 6 standard errors of the difference,
/// and rounding.
fn by_hand(description: &Description, hand: impl ByHand) -> usize {
    let trace = |pixel, light: &mut [Vec3; BLOCK]| at_best_level(Block { scene: hand, pixel, light });
    let scene = of::<Rgb>(description, false);
    let [right, right_square] = mean(|pixel, light| {
        let mut samples = Samples::new(&scene);
        scene.trace(pixel, 0, BLOCK, 1, &mut samples);
        let plain = samples.plain();
        *light = core::array::from_fn(|i| Vec3::from_array(plain[i].f.0));
    });
    let [ours, square] = mean(trace);
    let allowed = 6.0 * (square + right_square).map(f32::sqrt) + 1e-4 * right;
    assert!((ours - right).abs().cmple(allowed).all(), "by hand {ours}, but {right}");
    let mut light = [Vec3::ZERO; BLOCK];
    blocks(|pixel| {
        trace(pixel, &mut light);
        black_box(&mut light);
    })
}

fn main() {
    let named: Vec<String> = std::env::args().skip(1).collect();
    for BuiltIn { name, .. } in BuiltIn::ALL {
        if !named.is_empty() && !named.iter().any(|n| n == name) {
            continue;
        }
        let mut description = Description::built_in(name).expect("a scene that comes with the crate");
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
        let samples = match *name {
            "S1" => by_hand(&description, lights::s1::<true>()),
            "S1b" => by_hand(&description, lights::s1b()),
            "S1k" => by_hand(&description, lights::s1k()),
            "S2" => by_hand(&description, room::s2()),
            "S2w" => by_hand(&description, room::s2w()),
            "S3" => by_hand(&description, fog::s3::<1>()),
            "S3m" => by_hand(&description, fog::s3::<5>()),
            "S4a" => by_hand(&description, furnace::s4a()),
            "S4b" => by_hand(&description, furnace::s4b()),
            "S4c" => by_hand(&description, furnace::s4c()),
            "S4d" => by_hand(&description, furnace::s4d()),
            "S4e" => by_hand(&description, furnace::s4e()),
            "S4f" => by_hand(&description, lights::s1::<false>()),
            "S4g" => by_hand(&description, furnace::s4g()),
            other => panic!("no loop by hand for {other}"),
        };
        say("by-hand", samples);
        description.size = [16; 2];
        say("render", render(&description, Method::default()));
        say("render-plain", render(&description, Method::plain()));
    }
}
