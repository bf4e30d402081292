//! The ratio of means: ratio control variates proper.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Sample, enough_draws, reads};
use crate::flags::Flags;
use crate::moments::{Comoments, HasMeans, Means, Sums};
use crate::scaled::quotient_times;

/// H·ȳ/x̄.
///
/// Consistent; bias F\[(C20 − C11)/N + …\], MSE F²(C20 + C02 − 2C11)/N to first order (Tin 1965, with
/// the indices that the supplement misprints). Exact when f ∝ h. One draw gives y·H/x, error unknown;
/// x̄ = 0 gives ȳ and DENOM_ZERO.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RatioOfMeans;

reads!(RatioOfMeans, "ratio", "defensive_ratio", from 1 draws, value Sums<V>, error_bar Comoments<V>);

impl<S: HasMeans> Estimator<S> for RatioOfMeans {
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; 1]) -> Result<(), Error> {
        enough_draws::<Self, 1>(sample.count)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> ChannelEstimate {
        ordinary(sample, integral).unwrap_or_else(|| Remarks::with_auxiliary(sample, integral).ratio_of_means(integral))
    }
}

/// What [`Remarks`] come to where there is nothing to remark on: several draws of which sums alone are kept, and ordinary
/// numbers. So it is in nearly every pixel of a render, once per pair; asked first, for a third of the work.
#[inline]
fn ordinary<S: HasMeans>(sample: &Sample<'_, S>, integral: f64) -> Option<ChannelEstimate> {
    let sums_alone = sample.moments.spread().is_none() && sample.moments.tails().is_none();
    if !sums_alone || sample.count < 2 {
        return None;
    }
    let Means { f, h: [h] } = sample.moments.means(sample.count);
    let value = quotient_times(f, h, integral);
    let is_sound = |x: f64| x != 0.0 && x.is_finite();
    let is_negative = value < 0.0 && f >= 0.0;
    (is_sound(h) && is_sound(integral) && value.is_finite() && !is_negative).then_some(ChannelEstimate {
        value: value + 0.0,
        std_error: f64::NAN,
        flags: Flags::NONE,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Draw;
    use crate::moments::{Accumulate, Moments};

    #[test]
    fn the_short_way_has_the_bits_of_the_long_one() {
        let odd = [0.0, -0.0, 1.0, -2.5, 1e-310, 1e-200, -1e200, 1.7e308, f64::INFINITY, f64::NAN];
        let mut short = 0;
        for f in odd {
            for h in odd {
                for integral in odd {
                    for count in 0..4 {
                        let mut moments = Sums::<f64>::default();
                        for _ in 0..count {
                            moments.add(Draw::new(f, h));
                        }
                        let channel = moments.closed().channel(0);
                        let sample = Sample { channel: 0, count, epsilon: f64::EPSILON, moments: &channel };
                        let long = Remarks::with_auxiliary(&sample, integral).ratio_of_means(integral);
                        let ours = RatioOfMeans.estimate_channel(&sample, &[integral]);
                        let bits = |x: ChannelEstimate| (x.value.to_bits(), x.std_error.to_bits(), x.flags);
                        assert_eq!(bits(ours), bits(long), "{count} draws ({f}, {h}), H = {integral}");
                        short += u32::from(ordinary(&sample, integral).is_some());
                    }
                }
            }
        }
        assert!(short >= 400, "{short}");
    }

    #[test]
    fn moments_with_an_error_bar_go_the_long_way() {
        let mut moments = Comoments::<f64>::default();
        for h in [1.0, 2.0, 3.0] {
            moments.add(Draw::new(h * h, h));
        }
        let channel = moments.closed().channel(0);
        let sample = Sample { channel: 0, count: 3, epsilon: f64::EPSILON, moments: &channel };
        assert_eq!(ordinary(&sample, 1.0), None);
        assert!(RatioOfMeans.estimate_channel(&sample, &[1.0]).std_error > 0.0);
    }
}
