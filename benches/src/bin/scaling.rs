//! How much faster two threads are than one: `scaling [PAIRS]`, 9 unless told.
//!
//! Runs on one thread and on two alternate, so that whatever else the machine does burdens both; what
//! is printed is the median of the ratios of neighbouring times, and their range. A draw is a small ray
//! march, half a microsecond of arithmetic: what is measured is the driver, not the memory.
//!
//! Where other programs want the cores too, the scheduler decides these ratios. The processor time of all
//! threads together does not depend on that: what two threads need more of it than one is the cost of
//! the driver. (On Linux; unknown, NaN, elsewhere.)

use ratiocv_core::{Mickey, Problem, Spectrum, Uniform, WithIntegral};
use ratiocv_threads::integrate;
use std::time::Instant;

const DRAWS: u64 = 1_000_003;

/// Transmittance along a ray through a medium of varying density, for three extinctions.
fn march(x: &f64) -> Spectrum<f64, 3> {
    let steps = 32;
    let depth: f64 = (0..steps).map(|i| 1.0 + libm::sin(7.0 * x + 0.2 * f64::from(i))).sum::<f64>() / f64::from(steps);
    Spectrum([0.5, 1.0, 2.0].map(|extinction| libm::exp(-extinction * depth)))
}

/// Seconds of processor time that this process's threads have had.
fn processor_time() -> f64 {
    let Ok(threads) = std::fs::read_dir("/proc/self/task") else { return f64::NAN };
    let of = |thread: std::io::Result<std::fs::DirEntry>| -> Option<f64> {
        let text = std::fs::read_to_string(thread.ok()?.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse().ok()
    };
    threads.map(|thread| of(thread).unwrap_or(f64::NAN)).sum::<f64>() / 1e9
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn main() {
    let pairs: usize = std::env::args().nth(1).map_or(9, |pairs| pairs.parse().expect("PAIRS is a number"));
    let problem = Problem::new(march)
        .auxiliary(WithIntegral::new(|x: &f64| Spectrum([1.5 - x; 3]), Spectrum([1.0; 3])))
        .proposal(Uniform);
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    let (one, two) = (pool(1), pool(2));
    let timed = |pool: &rayon::ThreadPool| {
        let (begun, worked) = (Instant::now(), processor_time());
        let estimate = pool.install(|| integrate(&problem, &Mickey, DRAWS, 1)).expect("draws");
        ([begun.elapsed().as_secs_f64(), processor_time() - worked], estimate.value)
    };
    let (mut faster, mut costs) = (Vec::new(), Vec::new());
    for pair in 1..=pairs {
        let (([slow, least], first), ([fast, most], second)) = (timed(&one), timed(&two));
        assert_eq!(first.0.map(f64::to_bits), second.0.map(f64::to_bits), "other bits on two threads");
        println!(
            "{pair:3}: {slow:.3} s on one thread, {fast:.3} s on two, {:.2} ×; processor time {least:.3} s and {most:.3} s",
            slow / fast
        );
        faster.push(slow / fast);
        costs.push(most / least);
    }
    let extreme = |pick: fn(f64, f64) -> f64| faster.iter().copied().reduce(pick).unwrap_or(f64::NAN);
    let (least, most) = (extreme(f64::min), extreme(f64::max));
    println!("median {:.2} × ({least:.2} to {most:.2}), processor time {:.3} ×", median(faster), median(costs));
}
