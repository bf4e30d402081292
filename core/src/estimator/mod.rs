//! Estimators: from moments and known integrals to an estimate. One file each.

mod beale;
mod choose;
mod combined;
mod cross_fitted;
mod defensive;
mod deterministic_mixture;
mod difference;
mod estimated_integrals;
mod fall_back;
mod fixed;
mod hartley_ross;
mod jackknife;
mod mean_of_ratios;
mod mickey;
mod nonnegative;
mod optimal_defensive;
mod plain;
mod quenouille;
mod random_mixture;
mod ratio_of_integrals;
mod ratio_of_means;
mod regression;
mod regression_ratio;
mod remarks;
mod tin;

pub use beale::Beale;
pub use choose::{Choice, Choose};
pub use combined::Combined;
pub use cross_fitted::CrossFitted;
pub use defensive::Defensive;
pub use deterministic_mixture::DeterministicMixture;
pub use difference::Difference;
pub use estimated_integrals::{EstimatedIntegrals, Uncertain};
pub use fall_back::FallBackWhenIll;
pub use fixed::{Fit, Fixed, WithCoefficients};
pub use hartley_ross::HartleyRoss;
pub use jackknife::Jackknife;
pub use mean_of_ratios::MeanOfRatios;
pub use mickey::Mickey;
pub use optimal_defensive::OptimalDefensive;
pub use plain::Plain;
pub use quenouille::Quenouille;
pub use random_mixture::RandomMixture;
pub use ratio_of_integrals::RatioOfIntegrals;
pub use ratio_of_means::RatioOfMeans;
pub use regression::{Coefficients, Dependent, Regression};
pub use regression_ratio::RegressionRatio;
pub use tin::Tin;

use crate::draw::Draw;
use crate::error::{Error, weight_in_range};
use crate::estimate::{ChannelEstimate, Estimate};
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::{Accumulate, Means, Merge, Moments, Save};
use num_traits::float::FloatCore;

/// One channel's moments, as an estimator sees them.
#[derive(Clone, Copy, Debug)]
pub struct Sample<'a, S> {
    /// Which channel it is.
    pub channel: usize,
    /// The number of draws.
    pub count: u64,
    /// The unit roundoff of the draws, ×2.
    pub epsilon: f64,
    /// The moments.
    pub moments: &'a S,
}

impl<S> Sample<'_, S> {
    /// Other moments of the same draws.
    pub(crate) fn of<'a, T>(&self, moments: &'a T) -> Sample<'a, T> {
        Sample { channel: self.channel, count: self.count, epsilon: self.epsilon, moments }
    }
}

/// Turns the moments `S` of one channel, and the known integrals of `K` auxiliaries, into an
/// estimate of F. `S` is bounded by the capabilities that the estimator reads.
///
/// *Implemented by* each estimator; *called by* users, through [`estimate`](Estimator::estimate).
///
/// # Laws
/// An estimate depends on its own channel alone. Doubling f doubles value and error, exactly;
/// doubling h and H changes nothing. The value is never NaN where the plain mean is a number: an
/// undefined result is the plain mean, with a flag that says so ([`Flags::fell_back`](crate::Flags::fell_back)).
///
/// # Implementing
/// Scalar `f64`, channel by channel, plain `if`s: it runs once per pixel, not once per draw.
pub trait Estimator<S, const K: usize = 1> {
    /// The estimate of one channel; defined for every sample, with flags where it is not what the
    /// formula says.
    fn estimate_channel(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> ChannelEstimate;

    /// The value of a channel, from the means of two draws or more, where nothing else is kept and nothing is to be
    /// remarked on: the short way of nearly every pixel of a render. What it gives has the bits of
    /// [`estimate_channel`](Self::estimate_channel); `None`, unless overridden: ask that.
    #[inline]
    fn of_means_alone(&self, means: &Means<K>, integrals: &[f64; K]) -> Option<f64> {
        let _ = (means, integrals);
        None
    }

    /// Whether the moments are of the kind that this estimator needs: enough draws, and ratios on
    /// the right auxiliary.
    ///
    /// # Errors
    /// [`Error::TooFewDraws`]; [`Error::OtherAuxiliary`] with channel 0.
    fn check(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> Result<(), Error>;

    /// The estimate of every channel.
    ///
    /// # Errors
    /// [`Error::TooFewDraws`] below the estimator's least number of draws,
    /// [`Error::OtherAuxiliary`] if ratios were accumulated for another defensive weight or integral.
    #[inline]
    fn estimate<M: Moments<Channel = S>>(
        &self,
        moments: &M,
        integrals: &Integrals<M::Lanes, K>,
    ) -> Result<Estimate<M::Lanes>, Error> {
        let closed = moments.closed();
        for channel in 0..M::Lanes::LANES {
            of_channel(&closed, channel, |sample| self.check(sample, &integrals.channel(channel))).map_err(
                |error| match error {
                    Error::OtherAuxiliary { estimator, .. } => Error::OtherAuxiliary { estimator, channel },
                    other => other,
                },
            )?;
        }
        Ok(self.estimate_anyway(&closed, integrals))
    }

    /// The estimate of every channel, whatever the number of draws: NaN and EMPTY without any, a
    /// flagged fall-back to the ratio of means below the estimator's least number.
    #[inline]
    fn estimate_anyway<M: Moments<Channel = S>>(
        &self,
        moments: &M,
        integrals: &Integrals<M::Lanes, K>,
    ) -> Estimate<M::Lanes> {
        // A copy only where there is something to close: a pixel with a round number of samples is read in place.
        let copy;
        let closed = if moments.is_closed() {
            moments
        } else {
            copy = moments.closed();
            &copy
        };
        let short = |channel| {
            let means = closed.means_alone(channel).filter(|_| closed.count() >= 2)?;
            self.of_means_alone(&means, &integrals.channel(channel))
        };
        Estimate::of_values(short).unwrap_or_else(|| {
            Estimate::from_channels(|channel| {
                of_channel(closed, channel, |sample| self.estimate_channel(sample, &integrals.channel(channel)))
            })
        })
    }
}

/// `read` of one channel of closed moments.
#[inline]
fn of_channel<M: Moments, T>(closed: &M, channel: usize, read: impl FnOnce(&Sample<'_, M::Channel>) -> T) -> T {
    let epsilon = <<M::Lanes as Lanes>::Scalar as FloatCore>::epsilon().widen();
    read(&Sample { channel, count: closed.count(), epsilon, moments: &closed.channel(channel) })
}

/// Names the moments that an estimator reads, and makes accumulators of exactly these.
///
/// *Implemented by* each estimator; *called by* [`Problem::integrate`](crate::Problem::integrate)
/// and by whoever wants no more memory per pixel than the estimator needs.
pub trait Reads<const K: usize = 1>: Sized {
    /// The name in files and on the command line.
    const ID: &'static str;
    /// The same on a defensive auxiliary.
    const DEFENSIVE_ID: &'static str;
    /// The least number of draws it is defined for.
    const MIN_DRAWS: u64;
    /// Moments that give a value.
    type Value<V: Lanes>: Accumulate<Draw<V, K>> + Merge + Moments<Lanes = V> + Save + Copy + core::fmt::Debug;
    /// Moments that give a value and a standard error.
    type ErrorBar<V: Lanes>: Accumulate<Draw<V, K>> + Merge + Moments<Lanes = V> + Save + Copy + core::fmt::Debug;

    /// An empty accumulator of the value tier, for an auxiliary of defensive weight `weight`.
    #[doc(hidden)]
    fn value_on<V: Lanes>(&self, weight: f64, integrals: &Integrals<V, K>) -> Self::Value<V>;
    /// An empty accumulator of the error-bar tier, for an auxiliary of defensive weight `weight`.
    #[doc(hidden)]
    fn error_bar_on<V: Lanes>(&self, weight: f64, integrals: &Integrals<V, K>) -> Self::ErrorBar<V>;

    /// An empty accumulator that gives values without error bars.
    fn value<V: Lanes>(&self, integrals: &Integrals<V, K>) -> Self::Value<V> {
        self.value_on(0.0, integrals)
    }

    /// An empty accumulator that gives values with standard errors.
    fn error_bar<V: Lanes>(&self, integrals: &Integrals<V, K>) -> Self::ErrorBar<V> {
        self.error_bar_on(0.0, integrals)
    }

    /// This estimator on the defensive auxiliary h′ = εH + (1−ε)h, ε = `weight`.
    ///
    /// # Errors
    /// [`Error::Weight`] unless 0 ≤ `weight` < 1.
    fn defensive(self, weight: f64) -> Result<Defensive<Self>, Error> {
        Ok(Defensive { estimator: self, weight: weight_in_range(weight)? })
    }
}

/// The moments of an estimator, both tiers made by `Default`: those that need no parameters.
macro_rules! reads {
    ($estimator:ty, $id:literal, $defensive:literal, from $least:literal draws,
     value $value:ty, error_bar $error_bar:ty) => {
        impl crate::estimator::Reads for $estimator {
            const ID: &'static str = $id;
            const DEFENSIVE_ID: &'static str = $defensive;
            const MIN_DRAWS: u64 = $least;
            type Value<V: crate::Lanes> = $value;
            type ErrorBar<V: crate::Lanes> = $error_bar;
            fn value_on<V: crate::Lanes>(&self, _: f64, _: &crate::Integrals<V>) -> $value {
                Default::default()
            }
            fn error_bar_on<V: crate::Lanes>(&self, _: f64, _: &crate::Integrals<V>) -> $error_bar {
                Default::default()
            }
        }
    };
}
pub(crate) use reads;

/// Enough draws for `E`?
pub(crate) fn enough_draws<E: Reads<K>, const K: usize>(count: u64) -> Result<(), Error> {
    if count >= E::MIN_DRAWS {
        Ok(())
    } else {
        Err(Error::TooFewDraws { estimator: E::ID, needed: E::MIN_DRAWS, got: count })
    }
}
