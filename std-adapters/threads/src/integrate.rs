//! The driver loop on all cores.

use crate::chunks::{Chunk, merge_chunks, stream};
use crate::merge_tree::MergeTree;
use rand_core::Rng;
use ratiocv_core::moments::{Accumulate, Moments};
use ratiocv_core::{Auxiliaries, Draw, Error, Estimate, Estimator, Integrand, Problem, Proposal, Reads};
use ratiocv_simd::{Work, at_best_level};

/// Draws in a chunk.
pub const CHUNK: u64 = 4096;

/// The estimate of `estimator` from `draws` draws of `problem`, on all of the pool's threads.
///
/// The same bits for the same `seed`, whatever the number of threads. Statistically as
/// [`Problem::integrate`]. For hours rather than seconds: [`Run`](crate::Run).
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
    let mut tree = MergeTree::default();
    merge_chunks(&mut tree, draws, CHUNK, || false, |chunk| accumulated(problem, empty(), seed, chunk));
    estimator.estimate(&tree.merged().unwrap_or_else(empty), &integrals)
}

/// `moments` with the draws of `chunk`, made and added with the best instructions of the machine.
pub(crate) fn accumulated<F, A, P, X, M, const K: usize>(
    problem: &Problem<F, A, P, X>,
    mut moments: M,
    seed: u64,
    chunk: Chunk,
) -> M
where
    F: Integrand<X>,
    A: Auxiliaries<X, F::Value, K>,
    P: Proposal<Point = X>,
    M: Accumulate<Draw<F::Value, K>>,
{
    let (draws, mut rng) = (chunk.count, stream(seed, chunk.index));
    at_best_level(Accumulation { problem, moments: &mut moments, draws, rng: &mut rng });
    moments
}

struct Accumulation<'a, F, A, P, X, M, R, const K: usize> {
    problem: &'a Problem<F, A, P, X>,
    moments: &'a mut M,
    draws: u64,
    rng: &'a mut R,
}

impl<F, A, P, X, M, R, const K: usize> Work for Accumulation<'_, F, A, P, X, M, R, K>
where
    F: Integrand<X>,
    A: Auxiliaries<X, F::Value, K>,
    P: Proposal<Point = X>,
    M: Accumulate<Draw<F::Value, K>>,
    R: Rng,
{
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.problem.accumulate(self.moments, self.draws, self.rng);
    }
}
