//! Run time of one estimate, sampling included.

use crate::catalogue::{self, Method};
use crate::measure::plan::Size;
use crate::measure::report::Seconds;
use crate::problems::{Solved, Source};
use core::hint::black_box;
use rand_core::Rng;
use ratiocv_core::moments::{Accumulate, Moments};
use ratiocv_core::predict::Predict;
use ratiocv_core::{Draw, Estimator, Reads};
use ratiocv_simd::Xoshiro16;
use std::time::Instant;

/// Estimates, each from fresh draws and the estimator's own moments, with error bars.
struct Timed<'a, S, R> {
    source: &'a S,
    draws: u64,
    repeats: u64,
    rng: &'a mut R,
}

impl<S: Source, R: Rng> catalogue::Visitor<S::Value> for Timed<'_, S, R> {
    /// Seconds per estimate.
    type Output = f64;
    fn visit<E>(self, estimator: &E) -> f64
    where
        E: Reads + Predict + Sync + Estimator<<E::ErrorBar<S::Value> as Moments>::Channel>,
    {
        let integrals = self.source.integrals();
        let start = Instant::now();
        for _ in 0..self.repeats {
            let mut moments = estimator.error_bar(&integrals);
            fill(self.source, &mut moments, self.draws, self.rng);
            black_box(estimator.estimate_anyway(&moments, &integrals));
        }
        start.elapsed().as_secs_f64() / self.repeats as f64
    }
}

/// Not inlined, so that estimators that read the same moments share this code: a build takes minutes
/// otherwise.
#[inline(never)]
fn fill<S: Source, M: Accumulate<Draw<S::Value>>>(source: &S, moments: &mut M, draws: u64, rng: &mut impl Rng) {
    source.accumulate(moments, draws, rng);
}

/// Run times of `methods` on `problem`, on this thread alone.
///
/// Estimators take turns, round by round, so that a machine that slows down slows them all.
pub(super) fn clock<S: Solved>(problem: &S, methods: &[Method], weight: f64, size: Size, seed: u64) -> Vec<Seconds> {
    let source = problem.source();
    let mut rng = Xoshiro16::stream(seed, size.draws);
    let mut times = vec![Vec::with_capacity(size.rounds); methods.len()];
    // The first round warms caches and branch predictors and is thrown away.
    for round in 0..=size.rounds {
        for (times, method) in times.iter_mut().zip(methods) {
            let timed = Timed { source: &source, draws: size.draws, repeats: size.repeats, rng: &mut rng };
            let seconds = method.visit(weight, timed);
            if round > 0 {
                times.push(seconds);
            }
        }
    }
    times.into_iter().map(quartiles).collect()
}

fn quartiles(mut times: Vec<f64>) -> Seconds {
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[(share * (times.len() - 1) as f64 + 0.5) as usize];
    Seconds { lower: at(0.25), median: at(0.5), upper: at(0.75) }
}

#[cfg(test)]
mod tests {
    use super::quartiles;

    #[test]
    fn quartiles_are_order_statistics() {
        let seconds = quartiles(vec![5.0, 1.0, 4.0, 2.0, 3.0]);
        assert_eq!((seconds.lower, seconds.median, seconds.upper), (2.0, 3.0, 4.0));
    }
}
