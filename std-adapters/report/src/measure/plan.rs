//! How many replicates of each size a budget buys.

use crate::measure::Options;
use crate::measure::coverage::is_judged;

/// A number of draws, and how often an estimate of so many is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Size {
    /// Draws per estimate.
    pub(super) draws: u64,
    /// Independent estimates.
    pub(super) replicates: u64,
    /// Estimates in a chunk of work.
    pub(super) chunk: u64,
    /// Whether their intervals are judged.
    pub(super) judged: bool,
    /// Measurements of the run time, and estimates in each.
    pub(super) rounds: usize,
    /// Estimates in one measurement of the run time.
    pub(super) repeats: u64,
}

/// Draws per estimate: 2¹ up to this power of 2.
const POWERS: u32 = 12;
const QUICK_POWERS: u32 = 8;
const QUICK_SECONDS: f64 = 3.0;
/// Of the budget, what the replicates get; the rest is for run times and populations.
const SHARE: f64 = 0.75;
/// What the nominal costs below are meant for.
const NOMINAL_CORES: f64 = 2.0;
/// Enough for a standard error of the MSE that means something, and more than enough.
const LEAST: f64 = 64.0;
const MOST: f64 = 65_536.0;
/// Chunks of some 2 ms: long beside the cost of handing them out.
const CHUNK_NANOSECONDS: f64 = 2e6;
/// One measurement of a run time lasts at least about so long, that the clock's own steps do not matter.
const INTERVAL_NANOSECONDS: f64 = 1.5e5;

/// Nominal cost of one replicate: all estimators from the same draws.
fn replicate_nanoseconds(draws: u64, channels: usize) -> f64 {
    let channels = channels as f64;
    draws as f64 * (75.0 + 50.0 * channels) + 5000.0 + 3500.0 * channels
}

/// Nominal cost of one estimate of one estimator.
fn estimate_nanoseconds(draws: u64, channels: usize) -> f64 {
    let channels = channels as f64;
    draws as f64 * (15.0 + 15.0 * channels) + 60.0 * channels
}

/// The sizes for a problem of `channels` channels, one of `problems`: a function of the options alone,
/// never of a clock.
pub(super) fn plan(options: &Options, channels: usize, problems: usize) -> Vec<Size> {
    let powers = if options.quick { QUICK_POWERS } else { POWERS };
    let seconds = if options.quick { options.budget_seconds.min(QUICK_SECONDS) } else { options.budget_seconds };
    let share = seconds * SHARE * NOMINAL_CORES * 1e9 / (problems as f64 * f64::from(powers));
    let size = |power: u32| {
        let draws = 1 << power;
        let cost = replicate_nanoseconds(draws, channels);
        Size {
            draws,
            replicates: (share / cost).clamp(LEAST, MOST) as u64,
            judged: is_judged(draws),
            chunk: (CHUNK_NANOSECONDS / cost).max(1.0) as u64,
            rounds: if options.quick { 5 } else { 11 },
            repeats: (INTERVAL_NANOSECONDS / estimate_nanoseconds(draws, channels)).max(1.0) as u64,
        }
    };
    (1..=powers).map(size).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_budget_buys_more_replicates_of_the_same_sizes() {
        let small = plan(&Options { budget_seconds: 5.0, ..Options::default() }, 3, 10);
        let large = plan(&Options { budget_seconds: 50.0, ..Options::default() }, 3, 10);
        assert_eq!(small.len(), 12);
        for (small, large) in small.iter().zip(&large) {
            assert_eq!(small.draws, large.draws);
            assert!(small.replicates >= 64 && large.replicates >= small.replicates);
            assert!(large.replicates as f64 <= MOST);
        }
    }

    #[test]
    fn quick_is_bounded_whatever_the_budget() {
        let quick = plan(&Options { budget_seconds: 1e9, quick: true, ..Options::default() }, 1, 10);
        let same = plan(&Options { budget_seconds: 3.0, quick: true, ..Options::default() }, 1, 10);
        assert_eq!(quick, same);
        assert_eq!(quick.last().map(|size| size.draws), Some(256));
    }
}
