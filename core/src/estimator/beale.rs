//! Beale's almost unbiased ratio.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Sample, enough_draws, reads};
use crate::moments::{Comoments, HasComoments};
use crate::planted::planted;
use crate::scaled::quotient_times;

/// H·(ȳx̄ + s_xy/N)/(x̄² + s_xx/N), sample covariances with divisor N − 1.
///
/// Bias −2F(D + S)/N² (Beale 1962; the supplement's S_fh and S_hh must be sample covariances for that to
/// hold), MSE as the ratio of means to first order. Needs 2 draws; one falls back to the ratio of
/// means. Defined at x̄ = 0 if h varies; all x = 0 gives ȳ and DENOM_ZERO.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Beale;

reads!(Beale, "beale", "defensive_beale", from 2 draws, value Comoments<V>, error_bar Comoments<V>);

impl<S: HasComoments> Estimator<S> for Beale {
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; 1]) -> Result<(), Error> {
        enough_draws::<Self, 1>(sample.count)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> ChannelEstimate {
        let remarks = Remarks::with_auxiliary(sample, integral);
        if sample.count < 2 {
            return remarks.ratio_of_means(integral);
        }
        let (means, spread, n) = (sample.moments.means(sample.count), sample.moments.comoments(), sample.count as f64);
        let divisor = planted!("beale_divisor": n - 1.0, n) * n;
        let (s_xx, s_xy) = (planted!("beale_s_xx": spread.hh[0][0], spread.ff()) / divisor, spread.fh(0) / divisor);
        // In units of the larger of |x̄| and s_x/√N: squares of x itself would leave the exponent
        // range long before the estimate does, and x̄ may be 0.
        let unit = means.h[0].abs().max(libm::sqrt(s_xx));
        if remarks.flags().fell_back() || unit == 0.0 {
            return remarks.plain(remarks.zero_denominator());
        }
        let x = means.h[0] / unit;
        let ratio = (means.f * x + s_xy / unit) / (x * x + s_xx / unit / unit);
        remarks.value(quotient_times(ratio, unit, integral), &[ratio / unit])
    }
}
