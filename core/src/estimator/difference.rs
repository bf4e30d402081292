//! Difference control variates.

use crate::estimate::ChannelEstimate;
use crate::estimator::fixed::fits_its_own_draws;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Coefficients, Fit, Fixed, Regression, Sample, WithCoefficients};
use crate::flags::Flags;
use crate::moments::{ComomentsBlock, HasComoments, HasMeans};
use crate::planted::planted;

/// ȳ + Σ_k β_k(H_k − x̄_k).
///
/// With β given ([`fixed`](Difference::fixed), or learned from other draws): unbiased for every β, MSE
/// Var(y − Σβ_k x_k)/N, least for β* = Cov(x)⁻¹Cov(x, y) (the supplement's Lemma 7). With β̂ fitted to the same
/// draws, as it stands: consistent, bias −F(C21 − aC30)/(C20·N) with a = C11/C20 for one auxiliary, MSE
/// of β* to first order. [`CrossFitted`](crate::CrossFitted) is unbiased *and* fitted.
///
/// Never divides by x̄: a mean of h near 0 does no harm. Two draws leave nothing to fit: ȳ and ALPHA.
/// Dependent auxiliaries raise RANK. The error bar of fitted coefficients counts the degrees of freedom
/// that they took and the distance of x̄ from H.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, Difference, Estimator, Integrals};
/// let mut moments = Comoments::<f64, 2>::default();
/// for i in 0..32 {
///     let (a, b) = (f64::from(i % 4), f64::from(i / 4));
///     moments.add(Draw { f: 1.0 + 2.0 * a - b, h: [a, b] });
/// }
/// let estimate = Difference::default().estimate(&moments, &Integrals::new([1.0, 3.0]))?;
/// assert!((estimate.value - 0.0).abs() < 1e-12); // 1 + 2·1 − 3, without noise
/// let fixed = Difference::default().fixed([2.0, 0.0]);
/// assert!((fixed.estimate(&moments, &Integrals::new([1.0, 3.0]))?.value - -0.5).abs() < 1e-12);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// How β is fitted.
    pub regression: Regression,
}

impl Difference {
    /// With the coefficients β given.
    pub const fn fixed<W, const K: usize>(self, beta: [W; K]) -> Fixed<Self, W, K> {
        Fixed { estimator: self, coefficients: beta }
    }
}

fits_its_own_draws!(
    Difference, "difference", "defensive_difference", "cross_fitted_difference",
    block ComomentsBlock<V, K>, S: HasComoments<K>
);

impl<S: HasComoments<K>, const K: usize> Fit<S, K> for Difference {
    fn fit(&self, sample: &Sample<'_, S>, _: &[f64; K]) -> Coefficients<K> {
        self.regression.fit(sample)
    }
}

impl<S: HasMeans<K>, const K: usize> WithCoefficients<S, K> for Difference {
    fn estimate_with(
        &self,
        sample: &Sample<'_, S>,
        integrals: &[f64; K],
        coefficients: &Coefficients<K>,
    ) -> ChannelEstimate {
        let remarks = Remarks::with_auxiliaries(sample, integrals);
        if remarks.flags().fell_back() {
            return remarks.plain(Flags::NONE);
        }
        // Nothing is divided by x̄.
        let remarks = remarks.without(Flags::DENOM_ILL).and(coefficients.flags);
        let means = sample.moments.means(sample.count);
        let beta = &coefficients.values;
        // An auxiliary that is not used must not be multiplied by 0: its mean may be enormous.
        let value = (0..K).filter(|k| beta[*k] != 0.0).fold(means.f, |value, k| {
            value + beta[k] * planted!("difference_sign": integrals[k] - means.h[k], means.h[k] - integrals[k])
        });
        remarks.value_with_fit(value, beta, coefficients.parameters)
    }
}
