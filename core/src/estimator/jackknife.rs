//! The delete-a-group jackknife.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Sample, enough_draws, reads};
use crate::flags::Flags;
use crate::moments::{Group, Groups, HasGroups, HasMeans};
use crate::planted::planted;
use crate::scaled::quotient_times;

/// G·R̂ − Σ_g (1 − n_g/N)·R̂₍₋g₎, times H: R̂₍₋g₎ the ratio of all groups but g.
///
/// Consistent; bias −(G/(G−1))F(D + 3S)/N², MSE F²\[V/N + G/(G−1)·(C20·V + E²)/N²\] with
/// E = C11 − C20: two groups are Quenouille's halves, one per draw the classical jackknife. The
/// error bar needs no co-moments: it is the jackknife's own, (G−1)/G·Σ(R̂₍₋g₎ − mean)² for groups of
/// one size, in general that of Busing, Meijer and van der Leeden (1999), which the weights are from
/// too. With 8 groups it has 7 degrees of freedom.
///
/// Needs 2 draws; one falls back to the ratio of means. With fewer draws than groups each draw is a
/// group. A Σx of 0 over all groups but one gives ȳ and DENOM_ZERO. Group means of f that are all 0 are
/// taken for NO_SUPPORT.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Groups}, Draw, Estimator, Integrals, Jackknife};
/// let mut pixel = Groups::<f64, 8>::default();
/// for i in 0..64 {
///     let h = 0.5 + f64::from(i % 7) / 7.0;
///     pixel.add(Draw::new(3.0 * h + f64::from(i % 3), h));
/// }
/// let jackknife = Jackknife.estimate(&pixel, &Integrals::ONE)?;
/// assert!(jackknife.std_error > 0.0); // from group means alone
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Jackknife;

reads!(Jackknife, "jackknife", "defensive_jackknife", from 2 draws, value Groups<V, 8>, error_bar Groups<V, 8>);

impl<S: HasMeans + HasGroups> Estimator<S> for Jackknife {
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; 1]) -> Result<(), Error> {
        enough_draws::<Self, 1>(sample.count)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, &[integral]: &[f64; 1]) -> ChannelEstimate {
        let group = |g: usize| sample.moments.group(sample.count, g);
        // Group means tell as well as a spread would that every f was 0; where they cancel, rounding may leave a mean.
        let nothing = sample.count > 0 && sample.moments.means(sample.count).f == 0.0;
        let unseen = nothing && (0..sample.moments.groups()).all(|g| group(g).f == 0.0);
        let remarks = Remarks::with_auxiliary(sample, integral).and(Flags::when(unseen, Flags::NO_SUPPORT));
        let ratio = remarks.ratio_of_means(integral);
        if sample.count < 2 || ratio.flags.fell_back() {
            return ratio;
        }
        let without = |g: usize| {
            let (f, h) = others(sample.moments.groups(), g, group);
            (h != 0.0).then(|| quotient_times(f, h, integral))
        };
        let sizes = || (0..sample.moments.groups()).map(|g| group(g).count).filter(|count| *count > 0);
        match jackknifed(ratio.value, sample.count, sizes(), without) {
            Some((value, variance)) => remarks.value_with_error(value, libm::sqrt(variance)),
            None => remarks.plain(remarks.zero_denominator()),
        }
    }
}

/// Σf and Σh over all groups but `own`. Added up, not taken as the difference to the whole: where one
/// group holds nearly all of Σh, the difference would have no digits left.
pub(super) fn others(groups: usize, own: usize, group: impl Fn(usize) -> Group) -> (f64, f64) {
    (0..groups).filter(|g| *g != own).map(group).fold((0.0, 0.0), |(f, h), other| {
        let count = other.count as f64;
        // A group without draws has no means to speak of.
        if other.count == 0 { (f, h) } else { (f + count * other.f, h + count * other.h[0]) }
    })
}

/// The jackknifed value of a statistic that is `whole` on all draws and `without(g)` on all but group
/// g's, and its variance; `None` where one of them is undefined. Empty groups come last.
pub(super) fn jackknifed(
    whole: f64,
    count: u64,
    sizes: impl Iterator<Item = u64> + Clone,
    without: impl Fn(usize) -> Option<f64>,
) -> Option<(f64, f64)> {
    let groups = sizes.clone().count() as f64;
    let mut value = groups * whole;
    for (g, size) in sizes.clone().enumerate() {
        value -= planted!("jackknife_weight": 1.0 - size as f64 / count as f64, 1.0) * without(g)?;
    }
    let mut variance = 0.0;
    for (g, size) in sizes.enumerate() {
        let share = count as f64 / size as f64;
        let pseudovalue = share * whole - (share - 1.0) * without(g)?;
        let off = pseudovalue - value;
        variance += off * off / planted!("jackknife_variance": share - 1.0, share) / groups;
    }
    // ∞ − ∞ of pseudovalues is as far out of the range as ∞.
    Some((value, if variance.is_nan() && whole.is_finite() { f64::INFINITY } else { variance }))
}
