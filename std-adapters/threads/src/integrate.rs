//! The driver loop on all cores.

use crate::chunks::{map_chunks, merge_tree, stream};
use ratiocv_core::moments::Moments;
use ratiocv_core::{Auxiliaries, Error, Estimate, Estimator, Integrand, Problem, Proposal, Reads};

/// Draws in a chunk.
pub const CHUNK: u64 = 4096;

/// The estimate of `estimator` from `draws` draws of `problem`, on all of the pool's threads.
///
/// The same bits for the same `seed`, whatever the number of threads. Statistically as
/// [`Problem::integrate`].
///
/// ```
/// use ratiocv_core::{Mickey, Problem, Spectrum, Uniform, WithIntegral};
/// let problem = Problem::new(|x: &f64| Spectrum([x * x, 2.0 * x]))
///     .auxiliary(WithIntegral::new(|x: &f64| Spectrum([*x, *x]), Spectrum([0.5, 0.5])))
///     .proposal(Uniform);
/// let estimate = ratiocv_threads::integrate(&problem, &Mickey, 100_000, 1)?;
/// assert!((estimate.value[0] - 1.0 / 3.0).abs() < 5.0 * estimate.std_error[0]);
/// assert!((estimate.value[1] - 1.0).abs() < 1e-14); // f = 2h
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
///
/// # Errors
/// As [`Estimator::estimate`].
pub fn integrate<F, A, P, X, E, const K: usize>(
    problem: &Problem<F, A, P, X>,
    estimator: &E,
    draws: u64,
    seed: u64,
) -> Result<Estimate<F::Value>, Error>
where
    F: Integrand<X> + Sync,
    A: Auxiliaries<X, F::Value, K> + Sync,
    P: Proposal<Point = X> + Sync,
    E: Reads<K> + Estimator<<E::ErrorBar<F::Value> as Moments>::Channel, K> + Sync,
    E::ErrorBar<F::Value>: Send,
{
    let integrals = problem.integrals();
    let empty = || estimator.error_bar(&integrals);
    let chunks = map_chunks(draws, CHUNK, |chunk| {
        let mut moments = empty();
        problem.accumulate(&mut moments, chunk.count, &mut stream(seed, chunk.index));
        moments
    });
    estimator.estimate(&merge_tree(chunks).unwrap_or_else(empty), &integrals)
}
