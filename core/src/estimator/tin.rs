//! Tin's almost unbiased ratio.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Sample, enough_draws, reads};
use crate::moments::{Comoments, HasComoments};
use crate::planted::planted;
use crate::scaled::quotient_times;

/// H·\[ȳ/x̄ + (s_xy/x̄² − ȳ·s_xx/x̄³)/N\], sample covariances with divisor N − 1.
///
/// Bias −F(2D + 3S)/N² (Tin 1965), MSE as Beale. Needs 2 draws; one falls back to the ratio of
/// means. x̄ = 0 gives ȳ and DENOM_ZERO.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tin;

reads!(Tin, "tin", "defensive_tin", from 2 draws, value Comoments<V>, error_bar Comoments<V>);

impl<S: HasComoments> Estimator<S> for Tin {
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; 1]) -> Result<(), Error> {
        enough_draws::<Self, 1>(sample.count)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> ChannelEstimate {
        let remarks = Remarks::with_auxiliary(sample, integral);
        let x = sample.moments.means(sample.count).h[0];
        if sample.count < 2 || remarks.flags().fell_back() || x == 0.0 {
            return remarks.ratio_of_means(integral);
        }
        let (f, spread, n) = (sample.moments.means(sample.count).f, sample.moments.comoments(), sample.count as f64);
        let divisor = planted!("tin_divisor": n - 1.0, n) * n;
        // One x̄ at a time, so that no power of x̄ over- or underflows.
        let first = spread.fh(0) / divisor / x;
        let second = f * (planted!("tin_s_xx": spread.hh[0][0], spread.fh(0)) / divisor / x / x);
        let corrected = f + planted!("tin_sign": first - second, second - first);
        remarks.value(quotient_times(corrected, x, integral), &[f / x])
    }
}
