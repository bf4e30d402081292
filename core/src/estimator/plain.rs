//! Plain Monte Carlo.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Reads, Sample, enough_draws};
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::{HasMeans, Mean, Variance};

/// The mean ȳ of f/g: vector-valued importance sampling.
///
/// Unbiased and consistent; MSE Var(y)/N. One draw gives that draw, error unknown; NaN in a channel
/// gives NaN and NONFINITE there. Reads no auxiliary.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plain;

impl<const K: usize> Reads<K> for Plain {
    const ID: &'static str = "mc";
    const DEFENSIVE_ID: &'static str = "mc";
    const MIN_DRAWS: u64 = 1;
    type Value<V: Lanes> = Mean<V, K>;
    type ErrorBar<V: Lanes> = Variance<V, K>;
    fn value_on<V: Lanes>(&self, _: f64, _: &Integrals<V, K>) -> Mean<V, K> {
        Mean::default()
    }
    fn error_bar_on<V: Lanes>(&self, _: f64, _: &Integrals<V, K>) -> Variance<V, K> {
        Variance::default()
    }
}

impl<S: HasMeans<K>, const K: usize> Estimator<S, K> for Plain {
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; K]) -> Result<(), Error> {
        enough_draws::<Self, K>(sample.count)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, _: &[f64; K]) -> ChannelEstimate {
        Remarks::without_auxiliary(sample).value(sample.moments.means(sample.count).f, &[0.0; K])
    }
}
