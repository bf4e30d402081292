//! Regression ratios: powers of H/x̄.

use crate::estimate::ChannelEstimate;
use crate::estimator::fixed::fits_its_own_draws;
use crate::estimator::remarks::{Remarks, with_error};
use crate::estimator::{Coefficients, Fit, Fixed, Regression, Sample, WithCoefficients};
use crate::flags::Flags;
use crate::moments::{ComomentsBlock, HasComoments, HasMeans};
use crate::planted::planted;
use crate::scaled::quotient_times;

/// ȳ·Π_k (H_k/x̄_k)^α_k: the regression ratio, for several auxiliaries the multiple regression ratio.
///
/// α = 0 is plain Monte Carlo and α = 1 the ratio of means, both to the bit; α = −1 is the product
/// estimator, for auxiliaries that fall where f rises. Consistent for every α. Bias for one auxiliary
/// F\[α(α+1)C20/2 − αC11\]/N, MSE F²(C02 + α²C20 − 2αC11)/N to first order, least for α* = β*H/F
/// (the supplement's Lemma 11 with F/H as it should be): that of the optimal difference.
///
/// As it stands α is learned from the draws, α̂_k = β̂_k·x̄_k/ȳ, shrunk and **clamped** (to \[−1, 2\] by
/// default; ALPHA where the clamp acts): free α̂ has no finite mean where ȳ can be near 0. An auxiliary
/// that is constant in the draws gets α = `undetermined`. Given ([`fixed`](RegressionRatio::fixed)) or
/// learned elsewhere ([`Fit::learn`]), any real α will do.
///
/// The error bar is that of the first-order form, and the distance between the two in quadrature: where f
/// is affine in h nothing else is left.
///
/// x̄_k = 0 with α_k > 0 gives ȳ and DENOM_ZERO; a fractional power of a negative H_k/x̄_k gives ȳ and
/// DENOM_SIGN.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Sums}, Draw, Estimator, Integrals, RegressionRatio};
/// let mut moments = Sums::<f64>::default(); // given α, means are all it reads
/// for (f, h) in [(3.0, 2.0), (5.0, 6.0)] {
///     moments.add(Draw::new(f, h));
/// }
/// let root = RegressionRatio::default().fixed([0.5]);
/// assert_eq!(root.estimate(&moments, &Integrals::ONE)?.value, 2.0); // 4·√(1/4)
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegressionRatio {
    /// How β, and with it α, is fitted.
    pub regression: Regression,
    /// The least and the greatest α.
    pub clamp: (f64, f64),
    /// α of an auxiliary that is constant in the draws.
    pub undetermined: f64,
}

impl Default for RegressionRatio {
    /// Shrunk, clamped to \[−1, 2\], 0 where undetermined.
    fn default() -> Self {
        Self { regression: Regression::default(), clamp: (-1.0, 2.0), undetermined: 0.0 }
    }
}

impl RegressionRatio {
    /// With the exponents α given.
    pub const fn fixed<W, const K: usize>(self, alpha: [W; K]) -> Fixed<Self, W, K> {
        Fixed { estimator: self, coefficients: alpha }
    }
}

fits_its_own_draws!(
    RegressionRatio,
    if K == 1 { "regression_ratio" } else { "multiple_regression_ratio" },
    "defensive_regression_ratio", "cross_fitted_regression_ratio",
    block ComomentsBlock<V, K>, S: HasComoments<K>
);

impl<S: HasComoments<K>, const K: usize> Fit<S, K> for RegressionRatio {
    fn fit(&self, sample: &Sample<'_, S>, _: &[f64; K]) -> Coefficients<K> {
        let (beta, means) = (self.regression.fit(sample), sample.moments.means(sample.count));
        let spread = sample.moments.comoments();
        let mut flags = beta.flags;
        let alpha = beta.map(|k| {
            let alpha = planted!("regression_ratio_alpha": beta.values[k] * (means.h[k] / means.f), beta.values[k]);
            if sample.count < 2 || spread.hh[k][k] == 0.0 || means.f == 0.0 || !alpha.is_finite() {
                let unclear = sample.count < 2 || (spread.hh[k][k] != 0.0 && means.f != 0.0);
                flags |= Flags::when(unclear, Flags::ALPHA);
                return self.undetermined;
            }
            let (least, greatest) = self.clamp;
            let clamped = if alpha < least {
                least
            } else if alpha > greatest {
                greatest
            } else {
                alpha
            };
            flags |= Flags::when(clamped != alpha, Flags::ALPHA);
            clamped
        });
        Coefficients { flags, ..alpha }
    }
}

impl<S: HasMeans<K>, const K: usize> WithCoefficients<S, K> for RegressionRatio {
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
        let remarks = remarks.and(coefficients.flags);
        let means = sample.moments.means(sample.count);
        let (mut value, mut c) = (means.f, [0.0; K]);
        for k in 0..K {
            let (alpha, x, integral) = (coefficients.values[k], means.h[k], integrals[k]);
            // α = 0 and ±1 without a power, which would round; and whatever x̄ is, α = 0 is plain.
            if alpha == 0.0 {
                continue;
            }
            if x == 0.0 && alpha > 0.0 {
                return remarks.plain(remarks.zero_denominator());
            }
            let quotient = quotient_times(1.0, x, integral);
            if quotient < 0.0 && libm::trunc(alpha) != alpha {
                return remarks.plain(Flags::DENOM_SIGN);
            }
            value = if alpha == 1.0 {
                quotient_times(value, x, integral)
            } else if alpha == -1.0 {
                quotient_times(value, integral, x)
            } else {
                value * libm::pow(quotient, alpha)
            };
            c[k] =
                planted!("regression_ratio_coefficient": alpha, 1.0) * (means.f / if x == 0.0 { integral } else { x });
        }
        let estimate = remarks.value_with_fit(value, &c, coefficients.parameters);
        // The error bar is that of ȳ + Σc_k(H_k − x̄_k); how far the power is from it is known, and counts.
        let linear = (0..K).filter(|k| c[*k] != 0.0).fold(means.f, |sum, k| sum + c[k] * (integrals[k] - means.h[k]));
        let curvature = planted!("regression_ratio_curvature": value - linear, 0.0);
        if estimate.flags.fell_back()
            || coefficients.values.iter().all(|alpha| *alpha == 0.0 || (K == 1 && *alpha == 1.0))
        {
            return estimate;
        }
        // An unknown error stays unknown: hypot(NaN, ∞) is ∞.
        with_error(estimate, |error| if error.is_nan() { error } else { libm::hypot(error, curvature) })
    }
}
