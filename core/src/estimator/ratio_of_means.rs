//! The ratio of means: ratio control variates proper.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Sample, enough_draws, reads};
use crate::moments::{Comoments, HasMeans, Sums};

/// H·ȳ/x̄.
///
/// Consistent; bias F\[(C20 − C11)/N + …\], MSE F²(C20 + C02 − 2C11)/N to first order (Tin 1965, with
/// the indices that the seed misprints). Exact when f ∝ h. One draw gives y·H/x, error unknown;
/// x̄ = 0 gives ȳ and DENOM_ZERO.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RatioOfMeans;

reads!(RatioOfMeans, "ratio", "defensive_ratio", from 1 draws, value Sums<V>, error_bar Comoments<V>);

impl<S: HasMeans> Estimator<S> for RatioOfMeans {
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; 1]) -> Result<(), Error> {
        enough_draws::<Self, 1>(sample.count)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> ChannelEstimate {
        Remarks::with_auxiliary(sample, integral).ratio_of_means(integral)
    }
}
