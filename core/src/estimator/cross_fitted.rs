//! Coefficients for each half of the draws from the other half.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::{Coefficients, Estimator, Fit, Reads, Sample};
use crate::flags::Flags;
use crate::moments::HasFolds;
use crate::planted::planted;

/// `E` in two folds, the even- and the odd-numbered draws, each with the coefficients that the *other*
/// fold suggests: Σ_f (n_f/N)·F̂_f(coefficients of the other).
///
/// Coefficients that do not depend on the draws they serve keep `E` unbiased where it is so for given
/// ones: the cross-fitted [`Difference`](crate::Difference) and
/// [`OptimalDefensive<Mickey>`](crate::OptimalDefensive) are **exactly unbiased**, and their MSE is, to
/// first order, that of the optimal coefficients. Consistent as `E`. The shrinkage of the fit matters
/// here: at 8 draws an unshrunk β of 4 draws does more harm than good.
///
/// The variance is Σ(n_f/N)²·Var_f, each about coefficients that its draws had no part in, so that it
/// is not too small. Below 4 draws the error is unknown and nothing is fitted: ȳ, and ALPHA.
///
/// ```
/// use ratiocv_core::{moments::Accumulate, CrossFitted, Difference, Draw, Estimator, Integrals, Reads};
/// let estimator = CrossFitted(Difference::default());
/// let mut moments = estimator.error_bar(&Integrals::<f64>::new([1.5]));
/// for i in 0..64 {
///     let h = f64::from(i * 7 % 32) / 10.0;
///     moments.add(Draw::new(2.0 * h + 1.0, h));
/// }
/// let estimate = estimator.estimate(&moments, &Integrals::new([1.5]))?;
/// assert!((estimate.value - 4.0).abs() < 1e-12);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CrossFitted<E>(pub E);

impl<S, E, const K: usize> Estimator<S, K> for CrossFitted<E>
where
    S: HasFolds,
    E: Fit<S::Fold, K>,
    Self: Reads<K>,
{
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; K]) -> Result<(), Error> {
        super::enough_draws::<Self, K>(sample.count)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> ChannelEstimate {
        let fold = |fold: usize| {
            let count = (sample.count + 1 - fold as u64) / 2;
            Sample { count, ..sample.of(sample.moments.fold(fold)) }
        };
        let estimate = |one: usize| {
            let other = planted!("cross_fitted_fold": 1 - one, one);
            // A fold of one draw has estimates that no coefficients keep unbiased: below 4 draws nothing is learned.
            let count = if planted!("cross_fitted_few": sample.count < 4, false) { 0 } else { fold(other).count };
            let learned = self.0.fit(&Sample { count, ..fold(other) }, integrals);
            // They cost this fold no degree of freedom.
            let coefficients = Coefficients { parameters: 0.0, ..learned };
            self.0.estimate_with(&fold(one), integrals, &coefficients)
        };
        let first = estimate(0);
        if sample.count < 2 {
            return first;
        }
        let second = estimate(1);
        let share = |one: usize| fold(one).count as f64 / sample.count as f64;
        let error = |one: usize, estimate: &ChannelEstimate, other: &ChannelEstimate| {
            // A fold that saw nothing beside one that did has an error like any other: 0.
            let only_one_blind = estimate.flags.contains(Flags::NO_SUPPORT) && !other.flags.contains(Flags::NO_SUPPORT);
            if only_one_blind { 0.0 } else { share(one) * estimate.std_error }
        };
        let mut flags = first.flags | second.flags;
        if !(first.flags.contains(Flags::NO_SUPPORT) && second.flags.contains(Flags::NO_SUPPORT)) {
            flags = flags.without(Flags::NO_SUPPORT);
        }
        ChannelEstimate {
            value: share(0) * first.value + share(1) * second.value,
            // Their squares may leave the range.
            std_error: libm::hypot(error(0, &first, &second), error(1, &second, &first)),
            flags,
        }
    }
}
