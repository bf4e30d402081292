//! The moments of a problem's draws, from its law instead of from random draws.

use crate::catalogue::{Diagnosed, everything};
use crate::problems::{Problem, Sobol, Solved, Source, Visitor};
use ratiocv_core::moments::{ExtremesBlock, Moments, ThirdBlock};
use ratiocv_core::predict::Population;
use ratiocv_core::{Error, Lanes};
use ratiocv_threads::{map_chunks, merge_tree};

/// Points in a chunk.
const CHUNK: u64 = 1 << 14;

/// The population of each channel of `problem`, with ratios on the raw auxiliary and on the
/// defensive one of weight `weight`.
///
/// The problem's own sampling code, fed with [`Sobol`] points; F and H are the exact ones.
/// Deterministic, and the same bits for any number of threads.
///
/// # Errors
/// [`Error::Weight`] unless 0 ≤ `weight` < 1.
pub fn population(problem: Problem, weight: f64) -> Result<Vec<Population>, Error> {
    struct Of(f64);
    impl Visitor for Of {
        type Output = Result<Vec<Population>, Error>;
        fn visit<S: Solved>(self, problem: &S) -> Self::Output {
            population_of(problem, self.0)
        }
    }
    problem.visit(Of(weight))
}

/// [`population`] of a problem of known type.
///
/// # Errors
/// [`Error::Weight`] unless 0 ≤ `weight` < 1.
pub fn population_of<S: Solved>(problem: &S, weight: f64) -> Result<Vec<Population>, Error> {
    let exact = problem.exact();
    let mut populations = from_points(problem, weight)?;
    for (channel, population) in populations.iter_mut().enumerate() {
        population.f = exact.get(channel);
    }
    Ok(populations)
}

fn from_points<S: Solved>(problem: &S, weight: f64) -> Result<Vec<Population>, Error> {
    let source = problem.source();
    let integrals = source.integrals();
    let empty: Diagnosed<S::Value> =
        everything::<S::Value, ExtremesBlock<S::Value>, ThirdBlock<S::Value>>(weight, &integrals)?;
    let parts = map_chunks(Sobol::POINTS, CHUNK, |chunk| {
        let mut moments = empty;
        source.accumulate(&mut moments, chunk.count, &mut Sobol::starting_at(chunk.start, S::UNIFORMS));
        moments
    });
    let moments = merge_tree(parts).unwrap_or(empty);
    let closed = moments.closed();
    let of = |channel| {
        Population::from_sample(&closed.channel(channel), closed.count(), integrals.0[0].get(channel), weight)
    };
    Ok((0..S::Value::LANES).map(of).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: f64 = 1e-5;

    struct Check;
    impl Visitor for Check {
        type Output = ();
        fn visit<S: Solved>(self, problem: &S) {
            let id = S::DESCRIPTION.id;
            let populations = from_points(problem, 0.01).unwrap();
            assert_eq!(populations.len(), S::Value::LANES);
            for (channel, population) in populations.iter().enumerate() {
                let f = population.f / problem.exact().get(channel) - 1.0;
                assert!(f.abs() <= TOLERANCE, "{id}, channel {channel}: F is off by {f:e}");
                // E[x′r] = F on either auxiliary ties the ratios to the rest; E[x] = H is tested below.
                assert!(population.c20 >= 0.0 && population.ff_c02 > 0.0, "{id}, channel {channel}");
                assert!(population.ratio.variance.is_finite() && population.defended.1.variance.is_finite());
            }
            let (source, mut moments) = (problem.source(), ratiocv_core::moments::Comoments::<S::Value>::default());
            let draws = Sobol::POINTS;
            source.accumulate(&mut moments, draws, &mut Sobol::starting_at(0, S::UNIFORMS));
            for channel in 0..S::Value::LANES {
                use ratiocv_core::moments::HasMeans;
                let mean = moments.closed().channel(channel).means(draws).h[0];
                let h = mean / source.integrals().0[0].get(channel) - 1.0;
                assert!(h.abs() <= TOLERANCE, "{id}, channel {channel}: H is off by {h:e}");
            }
        }
    }

    #[test]
    fn the_points_reproduce_the_known_integrals() {
        for problem in Problem::all() {
            problem.visit(Check);
        }
    }

    #[test]
    fn a_uniform_law_has_its_textbook_moments() {
        // h = 1/2 + x: Var = 1/12, third moment 0; f/h has no part in it.
        let populations = population(Problem::from_id("negative-correlation").unwrap(), 0.01).unwrap();
        assert!((populations[0].c20 - 1.0 / 12.0).abs() <= 1e-6);
        assert!(populations[0].c30.abs() <= 1e-6);
        // Cov(1.5 − x, x) = −1/12; cos(2πx) is uncorrelated with x.
        assert!((populations[0].f_c11 + 1.0 / 12.0).abs() <= 1e-6);
    }
}
