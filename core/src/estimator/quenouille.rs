//! Quenouille's jackknife of two halves.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Sample, enough_draws, reads};
use crate::moments::{ComomentsBlock, Groups, GroupsBlock, HasGroups, HasMeans, Joined};
use crate::planted::planted;
use crate::scaled::quotient_times;

/// H·\[2R̂ − (n₁R̂₁ + n₂R̂₂)/N\], the ratios of all draws, of the odd- and of the even-numbered ones.
///
/// Bias −2F(D + 3S)/N² (Quenouille 1956; the weights n_i/N instead of ½ make that hold for odd N
/// too), MSE as the ratio of means to first order, its 1/N² term twice Beale's. Needs 2 draws; one
/// falls back to the ratio of means. A half whose x̄ is 0 gives ȳ and DENOM_ZERO.
///
/// The halves are the parities of the draws' numbers, so that a stream needs no length in advance;
/// any even number of groups serves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Quenouille;

/// Means of everything and of the halves.
type Halves<V> = crate::moments::Blocked<V, Joined<ComomentsBlock<V>, (), GroupsBlock<V, 2>>>;

reads!(Quenouille, "quenouille", "defensive_quenouille", from 2 draws, value Groups<V, 2>, error_bar Halves<V>);

impl<S: HasMeans + HasGroups> Estimator<S> for Quenouille {
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; 1]) -> Result<(), Error> {
        enough_draws::<Self, 1>(sample.count)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> ChannelEstimate {
        let remarks = Remarks::with_auxiliary(sample, integral);
        let whole = remarks.ratio_of_means(integral);
        if sample.count < 2 || whole.flags.fell_back() {
            return whole;
        }
        let means = sample.moments.means(sample.count);
        let groups = sample.moments.groups();
        let half = |parity: usize| {
            // Σ over the groups of one parity: (draws, Σy, Σx).
            (parity..groups).step_by(2).map(|g| sample.moments.group(sample.count, g)).fold(
                (0.0, 0.0, 0.0),
                |(n, f, h), group| {
                    let count = group.count as f64;
                    (n + count, f + count * group.f, h + count * group.h[0])
                },
            )
        };
        let n = sample.count as f64;
        let mut value = planted!("quenouille_sign": 2.0, 0.0) * quotient_times(means.f, means.h[0], integral);
        for (count, f, h) in [half(0), half(1)] {
            if h == 0.0 {
                return remarks.plain(remarks.zero_denominator());
            }
            let share = planted!("quenouille_weights": count / n, 0.5);
            value -= planted!("quenouille_sign": 1.0, -1.0) * share * quotient_times(f, h, integral);
        }
        remarks.value(value, &[means.f / means.h[0]])
    }
}
