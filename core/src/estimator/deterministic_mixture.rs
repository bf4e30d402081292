//! A sum of ratios: deterministic mixtures of techniques, and depths of paths.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::jackknife::{jackknifed, others};
use crate::estimator::remarks::with_error;
use crate::estimator::{Estimator, Sample};
use crate::flags::Flags;
use crate::moments::HasPairs;
use crate::planted::planted;
use crate::scaled::quotient_times;

/// Σ_k H_k·mean(w_k y)/x̄_k: the integrand in parts, Σ_k w_k = 1 where f ≠ 0, each part with the
/// auxiliary that resembles it.
///
/// Consistent; MSE Var(y − ΣF_k x_k/H_k)/N to first order with F_k = E\[w_k y\], all parts sharing the
/// draws (the supplement's Eq. 156 lacks the cross terms). It depends on the weights through the F_k alone,
/// so that constant weights, those of the best [`RandomMixture`](crate::RandomMixture), are as good as
/// any; `weights` has the heuristics. The same sum over the depths of a path needs no weights.
///
/// The error bar is the delete-a-group jackknife of the *total*: the parts share draws, and their
/// variances do not add. With G groups it has G − 1 degrees of freedom. One draw: error unknown.
///
/// A part whose auxiliary has the mean 0: 0 if the part was 0 in every draw, else its plain mean and
/// DENOM_ZERO. A known integral that is 0 or not finite: that part's plain mean and BAD_INTEGRAL.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DeterministicMixture;

impl DeterministicMixture {
    /// The name in files.
    pub const ID: &'static str = "deterministic_mixture";
}

impl<S: HasPairs<K>, const K: usize> Estimator<S, K> for DeterministicMixture {
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; K]) -> Result<(), Error> {
        if sample.count >= 1 {
            return Ok(());
        }
        Err(Error::TooFewDraws { estimator: Self::ID, needed: 1, got: 0 })
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> ChannelEstimate {
        let (count, groups) = (sample.count, sample.moments.groups());
        if count == 0 {
            return ChannelEstimate { value: f64::NAN, std_error: f64::NAN, flags: Flags::EMPTY };
        }
        let group = |k: usize| move |g: usize| sample.moments.group_of_pair(count, k, g);
        let mut flags = Flags::when(count == 1, Flags::ONE_SAMPLE);
        let (mut is_plain, mut unseen) = ([false; K], true);
        for k in 0..K {
            let (f, h) = others(groups, usize::MAX, group(k));
            let nothing = (0..groups).all(|g| group(k)(g).f == 0.0);
            unseen &= nothing;
            let bad = integrals[k] == 0.0 || !integrals[k].is_finite();
            flags |= Flags::when(bad, Flags::BAD_INTEGRAL);
            flags |= Flags::when(h == 0.0 && !nothing && !bad, Flags::DENOM_ZERO);
            flags |= Flags::when(!f.is_finite() || !h.is_finite(), Flags::NONFINITE);
            is_plain[k] = bad || h == 0.0 || !h.is_finite();
        }
        flags |= Flags::when(unseen, Flags::NO_SUPPORT);
        let total = |own: usize| {
            let rest = count - if own < groups { group(0)(own).count } else { 0 };
            (0..K).try_fold(0.0, |total, k| {
                let (f, h) = others(groups, own, group(k));
                match is_plain[k] {
                    true => Some(total + f / rest as f64),
                    // A part that a group alone has seen is not defined without it.
                    false if h == 0.0 && f != 0.0 => None,
                    false if h == 0.0 => Some(total),
                    false => Some(total + planted!("mixture_sum": 1.0, 0.5) * quotient_times(f, h, integrals[k])),
                }
            })
        };
        let value = total(usize::MAX).unwrap_or(f64::NAN);
        let sizes = (0..groups).map(|g| group(0)(g).count).filter(|count| *count > 0);
        let variance = match jackknifed(value, count, sizes, total) {
            Some((_, variance)) if count >= 2 && !unseen => variance,
            _ => f64::NAN,
        };
        let value = if value.is_finite() { value + 0.0 } else { f64::NAN };
        with_error(ChannelEstimate { value, std_error: f64::NAN, flags }, |_| libm::sqrt(variance))
    }
}
