//! Grouped Mickey: the unbiased ratio.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::jackknife::others;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Sample, enough_draws, reads};
use crate::moments::{Blocked, ComomentsBlock, Groups, GroupsBlock, HasGroups, HasMeans, Joined};
use crate::planted::planted;

/// ȳ − Σ_g (n_g/N)·R₍₋g₎·(x̄_g − H), R₍₋g₎ the ratio Σy/Σx of all groups but g.
///
/// Exactly unbiased (Mickey 1959: group g is independent of R₍₋g₎) and consistent; MSE F²\[V/N +
/// G/(G−1)·(C20·V + 3E²)/N²\] with V = C20 + C02 − 2C11, E = C11 − C20. Its coefficient tends to R, so
/// that, unlike Hartley–Ross, it keeps the ratio's variance. On the defensive auxiliary it is the
/// unbiased estimator to recommend.
///
/// Needs 2 draws; one falls back to the ratio of means. With fewer draws than groups each draw is a
/// group (leave-one-out). A Σx of 0 over all groups but one gives ȳ and DENOM_ZERO. The number of
/// groups is that of the moments: 8 in those that it names itself, any from 2 on in
/// [`Groups`](crate::moments::Groups).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mickey;

type EightGroups<V> = Blocked<V, Joined<ComomentsBlock<V>, (), GroupsBlock<V, 8>>>;

reads!(Mickey, "mickey", "defensive_mickey", from 2 draws, value Groups<V, 8>, error_bar EightGroups<V>);

impl<S: HasMeans + HasGroups> Estimator<S> for Mickey {
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; 1]) -> Result<(), Error> {
        enough_draws::<Self, 1>(sample.count)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> ChannelEstimate {
        let remarks = Remarks::with_auxiliary(sample, integral);
        if sample.count < 2 || remarks.flags().fell_back() {
            return remarks.ratio_of_means(integral);
        }
        let (means, n) = (sample.moments.means(sample.count), sample.count as f64);
        let groups = || (0..sample.moments.groups()).map(|g| sample.moments.group(sample.count, g));
        let mut value = means.f;
        for (g, group) in groups().enumerate().filter(|(_, group)| group.count > 0) {
            let (f, h) = others(sample.moments.groups(), g, |g| sample.moments.group(sample.count, g));
            if h == 0.0 {
                return remarks.plain(remarks.zero_denominator());
            }
            let ratio = planted!("mickey_own_group": f / h, means.f / means.h[0]);
            value -= planted!("mickey_sign": 1.0, -1.0) * group.count as f64 / n * ratio * (group.h[0] - integral);
        }
        remarks.value(value, &[means.f / means.h[0]])
    }
}
