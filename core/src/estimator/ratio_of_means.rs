//! The ratio of means: ratio control variates proper.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Sample, enough_draws, reads};
use crate::moments::{Comoments, HasMeans, Means, Sums};
use crate::scaled::{are_ordinary, quotient_times};

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
        Remarks::with_auxiliary(sample, integral).ratio_of_means(integral)
    }
    /// Of ordinary numbers, and not negative where f is not.
    #[inline(always)]
    fn of_means_alone(&self, &Means { f, h: [h] }: &Means, &[integral]: &[f64; 1]) -> Option<f64> {
        if !are_ordinary(f, h, integral) {
            return None;
        }
        let value = quotient_times(f, h, integral);
        let is_negative = value < 0.0 && f >= 0.0;
        (!is_negative).then_some(value + 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Draw;
    use crate::estimator::Reads;
    use crate::integrals::Integrals;
    use crate::moments::{Accumulate, Moments, SumsState};

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
                        let moments = moments.closed();
                        for weight in [0.0, 0.01, 0.5] {
                            let estimator = RatioOfMeans.defensive(weight).expect("a weight");
                            let channel = moments.channel(0);
                            let sample = Sample { channel: 0, count, epsilon: f64::EPSILON, moments: &channel };
                            let long = estimator.estimate_channel(&sample, &[integral]);
                            let ours = estimator.estimate_anyway(&moments, &Integrals::new([integral]));
                            let bits = |x: ChannelEstimate| (x.value.to_bits(), x.std_error.to_bits(), x.flags);
                            let ours = bits(ours.channel(0));
                            assert_eq!(ours, bits(long), "{count} draws ({f}, {h}), H = {integral}, {weight}");
                            let means = moments.means_alone(0).expect("sums");
                            let value = Estimator::<SumsState<f64, 1>>::of_means_alone(&estimator, &means, &[integral]);
                            short += u32::from(value.is_some());
                        }
                    }
                }
            }
        }
        assert!(short >= 700, "{short}");
    }

    #[test]
    fn moments_with_an_error_bar_go_the_long_way() {
        let mut moments = Comoments::<f64>::default();
        for h in [1.0, 2.0, 3.0] {
            moments.add(Draw::new(h * h, h));
        }
        assert!(moments.closed().means_alone::<1>(0).is_none());
        assert!(RatioOfMeans.estimate_anyway(&moments, &Integrals::ONE).std_error > 0.0);
    }
}
