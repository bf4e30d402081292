//! Our side of benches/compare/vegas: peaks-4d with an adaptive grid, one thread.
//!
//! `compare-vegas SEED DRAWS` prints the seconds that it took, training included, and the estimates.

use core::error::Error;
use rand_core::SeedableRng;
use rand_pcg::Pcg64;
use ratiocv_core::{Grid, RatioOfMeans, Spectrum};
use std::time::Instant;

const CENTRES: [[f64; 4]; 3] = [[0.5, 0.5, 0.5, 0.5], [0.4, 0.6, 0.5, 0.45], [0.7, 0.35, 0.6, 0.55]];

/// f_k = exp(−50|x − c_k|²).
#[inline(always)]
fn peaks(x: &[f64; 4]) -> Spectrum<f64, 3> {
    Spectrum(CENTRES.map(|centre| {
        let squares = (0..4).fold(0.0, |sum, i| sum + (x[i] - centre[i]) * (x[i] - centre[i]));
        libm::exp(-50.0 * squares)
    }))
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<u64> = std::env::args().skip(1).map(|argument| argument.parse()).collect::<Result<_, _>>()?;
    let [seed, draws] = arguments[..] else { return Err("usage: compare-vegas SEED DRAWS".into()) };

    let start = Instant::now();
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut grid = Grid::<4, 1024, 3>::uniform();
    grid.adapt(&peaks, 5, 200_000, &mut rng);
    let estimate = grid.problem(peaks).integrate(&RatioOfMeans, draws, &mut rng)?.strict()?;
    let seconds = start.elapsed().as_secs_f64();

    println!("{seconds} {} {} {}", estimate.value[0], estimate.value[1], estimate.value[2]);
    Ok(())
}
