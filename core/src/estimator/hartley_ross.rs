//! Hartley and Ross's unbiased ratio.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Reads, Sample, enough_draws};
use crate::flags::Flags;
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::{Blocked, ComomentsBlock, HasMeans, HasRatioMean, Joined, RatioOf, SumsBlock, UnivariateBlock};
use crate::planted::planted;

/// H·r̄ + N/(N−1)·(ȳ − r̄x̄) with r = f/h.
///
/// Exactly unbiased and consistent (Hartley and Ross 1954); MSE Var(y − ρx)/N + \[Var r·Var x +
/// Cov(r, x)²\]/(N(N−1)) exactly, with ρ = E\[r\], not R: it can be far above the ratio's unless f/h is
/// nearly constant. Needs 2 draws; one falls back to the ratio of means. A draw with h = 0 ≠ f gives
/// ȳ and UNBOUNDED_RATIO; where f = h = 0, r counts as 0, which keeps it unbiased.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HartleyRoss;

type WithRatioMean<V, B> = Blocked<V, Joined<B, UnivariateBlock<RatioOf<V>, 0>>>;

impl Reads for HartleyRoss {
    const ID: &'static str = "hartley_ross";
    const DEFENSIVE_ID: &'static str = "defensive_hartley_ross";
    const MIN_DRAWS: u64 = 2;
    type Value<V: Lanes> = WithRatioMean<V, SumsBlock<V, 1>>;
    type ErrorBar<V: Lanes> = WithRatioMean<V, ComomentsBlock<V>>;
    fn value_on<V: Lanes>(&self, weight: f64, integrals: &Integrals<V>) -> Self::Value<V> {
        Blocked::with_ratios(Blocked::on(weight, integrals))
    }
    fn error_bar_on<V: Lanes>(&self, weight: f64, integrals: &Integrals<V>) -> Self::ErrorBar<V> {
        Blocked::with_ratios(Blocked::on(weight, integrals))
    }
}

impl<S: HasMeans + HasRatioMean> Estimator<S> for HartleyRoss {
    fn check(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> Result<(), Error> {
        enough_draws::<Self, 1>(sample.count)?;
        let known = sample.moments.ratio(0.0, integral);
        known.map(|_| ()).ok_or(Error::OtherAuxiliary { estimator: Self::ID, channel: 0 })
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> ChannelEstimate {
        let remarks = Remarks::with_auxiliary(sample, integral);
        if sample.count < 2 {
            return remarks.ratio_of_means(integral);
        }
        let (means, n) = (sample.moments.means(sample.count), sample.count as f64);
        match sample.moments.ratio(0.0, integral) {
            _ if remarks.flags().fell_back() => remarks.plain(Flags::NONE),
            None => remarks.plain(Flags::BAD_INTEGRAL),
            Some(ratio) if !ratio.mean.is_finite() => remarks.plain(Flags::UNBOUNDED_RATIO),
            Some(ratio) => {
                let r = planted!("hartley_ross_coefficient": ratio.mean, means.f / means.h[0]);
                let factor = planted!("hartley_ross_factor": n / (n - 1.0), 1.0);
                remarks.value(integral * r + factor * (means.f - r * means.h[0]), &[r])
            }
        }
    }
}
