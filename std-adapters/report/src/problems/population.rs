//! The moments of a problem's draws, from its law instead of from random draws.

use crate::catalogue::{Diagnosed, everything};
use crate::problems::{Lattice, Problem, Solved, Source, Visitor};
use ratiocv_core::moments::{ExtremesBlock, Moments, ThirdBlock};
use ratiocv_core::predict::Population;
use ratiocv_core::{Error, Lanes};
use ratiocv_threads::{map_chunks, merge_tree};

/// Points in a chunk: a divisor of the number of points.
const CHUNK: u64 = 1 << 14;

/// The population of each channel of `problem`, with ratios on the raw auxiliary and on the
/// defensive one of weight `weight`.
///
/// The problem's own sampling code, fed with a [`Lattice`]; F and H are the exact ones.
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
    let mut populations = from_lattice(problem, weight)?;
    for (channel, population) in populations.iter_mut().enumerate() {
        population.f = exact.get(channel);
    }
    Ok(populations)
}

fn from_lattice<S: Solved>(problem: &S, weight: f64) -> Result<Vec<Population>, Error> {
    let source = problem.source();
    let integrals = source.integrals();
    let empty: Diagnosed<S::Value> =
        everything::<S::Value, ExtremesBlock<S::Value>, ThirdBlock<S::Value>>(weight, &integrals)?;
    let moments = match S::UNIFORMS {
        1 => over_lattice::<S, 1>(&source, &empty),
        2 => over_lattice::<S, 2>(&source, &empty),
        5 => over_lattice::<S, 5>(&source, &empty),
        other => unreachable!("no problem takes {other} numbers per draw"),
    };
    let closed = moments.closed();
    let of = |channel| {
        Population::from_sample(&closed.channel(channel), closed.count(), integrals.0[0].get(channel), weight)
    };
    Ok((0..S::Value::LANES).map(of).collect())
}

fn over_lattice<S: Solved, const DIMENSIONS: usize>(
    source: &impl Source<Value = S::Value>,
    empty: &Diagnosed<S::Value>,
) -> Diagnosed<S::Value> {
    let parts = map_chunks(Lattice::<DIMENSIONS>::POINTS, CHUNK, |chunk| {
        let mut moments = *empty;
        source.accumulate(&mut moments, chunk.count, &mut Lattice::<DIMENSIONS>::starting_at(chunk.start));
        moments
    });
    merge_tree(parts).unwrap_or(*empty)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One point of 2²⁰ more or less on the rarest of three lights, chosen with probability 0.07, is
    /// 1.3e-5 of its share; the smooth problems are much closer.
    const TOLERANCE: f64 = 2e-5;

    struct Check;
    impl Visitor for Check {
        type Output = ();
        fn visit<S: Solved>(self, problem: &S) {
            let id = S::DESCRIPTION.id;
            let populations = from_lattice(problem, 0.01).unwrap();
            assert_eq!(populations.len(), S::Value::LANES);
            for (channel, population) in populations.iter().enumerate() {
                let f = population.f / problem.exact().get(channel) - 1.0;
                assert!(f.abs() <= TOLERANCE, "{id}, channel {channel}: F is off by {f:e}");
                // E[x′r] = F on either auxiliary ties the ratios to the rest; E[x] = H is tested below.
                assert!(population.c20 >= 0.0 && population.ff_c02 > 0.0, "{id}, channel {channel}");
                assert!(population.ratio.variance.is_finite() && population.defended.1.variance.is_finite());
            }
            let (source, mut moments) = (problem.source(), ratiocv_core::moments::Comoments::<S::Value>::default());
            let draws = Lattice::<1>::POINTS;
            match S::UNIFORMS {
                1 => source.accumulate(&mut moments, draws, &mut Lattice::<1>::starting_at(0)),
                2 => source.accumulate(&mut moments, draws, &mut Lattice::<2>::starting_at(0)),
                _ => source.accumulate(&mut moments, draws, &mut Lattice::<5>::starting_at(0)),
            }
            for channel in 0..S::Value::LANES {
                use ratiocv_core::moments::HasMeans;
                let mean = moments.closed().channel(channel).means(draws).h[0];
                let h = mean / source.integrals().0[0].get(channel) - 1.0;
                assert!(h.abs() <= TOLERANCE, "{id}, channel {channel}: H is off by {h:e}");
            }
        }
    }

    #[test]
    fn the_lattice_reproduces_the_known_integrals() {
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
