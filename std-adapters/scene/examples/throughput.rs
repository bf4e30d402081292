//! Samples per second of each scene on one core, without and with auxiliaries: `throughput [scene …]`.

#[path = "../tests/support/mod.rs"]
mod support;

use ratiocv_core::Spectrum;
use ratiocv_scene::{BLOCK, Colour, Description, Options, Samples, Scene};
use std::time::Instant;

/// Seconds that this thread has run, where Linux says so; seconds on the clock elsewhere.
fn seconds(start: Instant) -> f64 {
    let schedule = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = schedule.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |run| run / 1e9)
}

/// Million samples per second, the best of three times at least 0.3 s of computing.
fn measure<C: Colour>(description: &Description, auxiliary: bool) -> f64 {
    let scene = Scene::<C>::new(description, &Options { auxiliary, ..Options::default() }).expect("a sound scene");
    let mut samples = Samples::new(&scene);
    let [width, height] = scene.size();
    let mut best = 0.0_f64;
    for _ in 0..3 {
        let (clock, mut count, mut block) = (Instant::now(), 0, 0);
        let start = seconds(clock);
        while seconds(clock) - start < 0.3 {
            for pixel in (0..width * height).step_by(7) {
                scene.trace([pixel % width, pixel / width], block, BLOCK, 1, &mut samples);
                core::hint::black_box(&mut samples);
                count += BLOCK;
            }
            block += 1;
        }
        best = best.max(count as f64 / (seconds(clock) - start) / 1e6);
    }
    best
}

fn main() {
    let named: Vec<String> = std::env::args().skip(1).collect();
    println!("million samples per second on one core\nscene  plain  auxiliaries");
    for name in support::ALL {
        if !named.is_empty() && !named.iter().any(|n| n == name) {
            continue;
        }
        let description = support::built(name);
        let needs = ratiocv_scene::Needs::of(&description, &Options::default());
        let plain = if needs.channels == 1 {
            measure::<f32>(&description, false)
        } else {
            measure::<Spectrum<f32, 3>>(&description, false)
        };
        let with = if needs.auxiliary {
            format!("{:6.2}", measure::<Spectrum<f32, 3>>(&description, true))
        } else {
            "-".into()
        };
        println!("{name:5} {plain:6.2}  {with}");
    }
}
