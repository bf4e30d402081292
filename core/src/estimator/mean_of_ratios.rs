//! The mean of ratios: for comparison, since its bias does not vanish.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Reads, Sample, enough_draws};
use crate::flags::Flags;
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::{Blocked, HasMeans, HasRatioMean, IntegrandOf, Joined, RatioOf, UnivariateBlock};
use crate::planted::planted;

/// H·r̄ with r = f/h.
///
/// **Not consistent**: bias −Cov(r, x) and MSE H²Var(r)/N + Cov(r, x)², exactly and for every N. The
/// standard error covers the noise alone, not that bias. One draw gives f·H/h. A draw with h = 0 ≠ f
/// gives ȳ and UNBOUNDED_RATIO; where f = h = 0, r counts as 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MeanOfRatios;

/// The mean of f, to fall back to, beside the ratios.
type Ratios<V, const S: usize> =
    Blocked<V, Joined<UnivariateBlock<IntegrandOf<V, 1>, 0>, UnivariateBlock<RatioOf<V>, S>>>;

impl Reads for MeanOfRatios {
    const ID: &'static str = "mean_of_ratios";
    const DEFENSIVE_ID: &'static str = "defensive_mean_of_ratios";
    const MIN_DRAWS: u64 = 1;
    type Value<V: Lanes> = Ratios<V, 0>;
    type ErrorBar<V: Lanes> = Ratios<V, 1>;
    fn value_on<V: Lanes>(&self, weight: f64, integrals: &Integrals<V>) -> Ratios<V, 0> {
        Blocked::with_ratios(Blocked::on(weight, integrals))
    }
    fn error_bar_on<V: Lanes>(&self, weight: f64, integrals: &Integrals<V>) -> Ratios<V, 1> {
        Blocked::with_ratios(Blocked::on(weight, integrals))
    }
}

impl<S: HasMeans + HasRatioMean> Estimator<S> for MeanOfRatios {
    fn check(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> Result<(), Error> {
        enough_draws::<Self, 1>(sample.count)?;
        let known = sample.moments.ratio(0.0, integral);
        known.map(|_| ()).ok_or(Error::OtherAuxiliary { estimator: Self::ID, channel: 0 })
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> ChannelEstimate {
        let remarks = Remarks::with_ratios(sample, integral);
        let n = sample.count as f64;
        match sample.moments.ratio(0.0, integral) {
            _ if remarks.flags().fell_back() => remarks.plain(Flags::NONE),
            None => remarks.plain(Flags::BAD_INTEGRAL),
            Some(ratio) if !ratio.mean.is_finite() => {
                // A mean of h that is a number rules out that h was not.
                let known = sample.moments.means(sample.count).h[0].is_finite();
                remarks.plain(Flags::UNBOUNDED_RATIO | Flags::when(!known, Flags::NONFINITE))
            }
            Some(ratio) => {
                let error = ratio.squares.map_or(f64::NAN, |squares| libm::sqrt(squares / (n - 1.0) / n));
                let value = planted!("mean_of_ratios_integral": integral, 1.0) * ratio.mean;
                // Infinite squares make an infinite error, which says so itself.
                let underflow = n > 1.0 && ratio.squares.is_some_and(f64::is_nan);
                // Every f was 0: known of the ratios even where squares of h are not.
                let unseen =
                    sample.moments.means(sample.count).f == 0.0 && ratio.mean == 0.0 && ratio.squares == Some(0.0);
                let more = Flags::when(underflow, Flags::UNDERFLOW) | Flags::when(unseen, Flags::NO_SUPPORT);
                remarks.and(more).value_with_error(value, integral.abs() * error)
            }
        }
    }
}
