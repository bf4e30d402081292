//! What a problem with a known answer offers.

use crate::problems::{Axis, Curve};
use rand_core::Rng;
use ratiocv_core::moments::Accumulate;
use ratiocv_core::{Auxiliaries, Draw, Integrals, Integrand, Lanes, Problem, Proposal};

/// An integral whose value is known in closed form, and how it is sampled.
///
/// *Implemented by* each problem of this folder; *called by* whoever measures estimators, through
/// [`Visitor`](crate::problems::Visitor).
///
/// # Laws
/// `exact` is the expectation of the draws' f and `source().integrals()` that of their h, to
/// rounding. A draw takes exactly `UNIFORMS` numbers from the generator, by `next_u64`, so that
/// [`Sobol`](crate::problems::Sobol) points can take the generator's place.
pub trait Solved: Copy + Sync {
    /// The channels.
    type Value: Lanes<Scalar = f64, Wide = Self::Value>;
    /// Random numbers per draw.
    const UNIFORMS: usize;
    /// What it is, in words.
    const DESCRIPTION: Description;

    /// F, per channel.
    fn exact(&self) -> Self::Value;
    /// What yields draws.
    fn source(&self) -> impl Source<Value = Self::Value>;
    /// The name of channel `channel`.
    fn channel(&self, channel: usize) -> String;
    /// f and h over one axis, to be looked at.
    fn curves(&self) -> (Axis, Vec<Curve>);
}

/// A problem in words.
#[derive(Clone, Copy, Debug)]
pub struct Description {
    /// The name in files, on pages and on the command line.
    pub id: &'static str,
    /// A heading.
    pub title: &'static str,
    /// f, h, the domain and the sampling density.
    pub formula: &'static str,
    /// What it shows.
    pub why: &'static str,
}

/// Yields draws with one auxiliary: a core [`Problem`] whose types are forgotten.
///
/// *Implemented by* the core's [`Problem`]; *called by* the measurements.
pub trait Source: Sync {
    /// The channels.
    type Value: Lanes<Scalar = f64, Wide = Self::Value>;
    /// The known integrals of the auxiliary.
    fn integrals(&self) -> Integrals<Self::Value>;
    /// Adds `draws` draws to `moments`.
    fn accumulate<M: Accumulate<Draw<Self::Value>>, R: Rng + ?Sized>(&self, moments: &mut M, draws: u64, rng: &mut R);
}

impl<F, A, P, X> Source for Problem<F, A, P, X>
where
    F: Integrand<X, Value: Lanes<Scalar = f64, Wide = F::Value>> + Sync,
    A: Auxiliaries<X, F::Value, 1> + Sync,
    P: Proposal<Point = X> + Sync,
{
    type Value = F::Value;
    fn integrals(&self) -> Integrals<F::Value> {
        Problem::integrals(self)
    }
    #[inline]
    fn accumulate<M: Accumulate<Draw<F::Value>>, R: Rng + ?Sized>(&self, moments: &mut M, draws: u64, rng: &mut R) {
        Problem::accumulate(self, moments, draws, rng);
    }
}
