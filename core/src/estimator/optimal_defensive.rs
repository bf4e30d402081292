//! The optimal defensive ratio: the proposal as one more auxiliary.

use crate::estimate::ChannelEstimate;
use crate::estimator::fixed::fits_its_own_draws;
use crate::estimator::nonnegative::nonnegative;
use crate::estimator::{
    Coefficients, Combined, Estimator, Fit, Fixed, Mickey, RatioOfMeans, Regression, Sample, WithCoefficients,
};
use crate::flags::Flags;
use crate::moments::{ComomentsBlock, GroupsBlock, HasComoments, HasGroups, HasMeans, Joined};
use crate::planted::planted;

/// The optimal defensive ratio: `E` on h′ = a_0 + Σ_k a_k·h_k/H_k, a_0 = 1 − Σa_k, of integral 1.
///
/// A mixture with the proposal g as the 0-th auxiliary. For one auxiliary and a = α* = C11/C20 in
/// \[0, 1 − ε\] the first-order bias vanishes *and* the MSE is that of the optimal difference control
/// variate; outside, the clamp loses: take [`Difference`](crate::Difference). a_k = β̂_k·H_k/F̂, F̂ the
/// regression estimate, learned from the draws: the best a ≥ 0, then scaled down to a_0 ≥ `floor`, so that
/// denominators are positive where every h is (ALPHA where either acts). With [`Mickey`] on it and a given,
/// or [`CrossFitted`](crate::CrossFitted), it is exactly unbiased.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, Estimator, Integrals, OptimalDefensive};
/// let mut moments = Comoments::<f64>::default();
/// for i in 0..32 {
///     let h = f64::from(i % 4);
///     moments.add(Draw::new(1.0 + 2.0 * h, h)); // f = g + 2h
/// }
/// let estimate = OptimalDefensive::default().estimate(&moments, &Integrals::new([2.0]))?;
/// assert!((estimate.value - 5.0).abs() < 1e-12); // the ratio of means would give 5.33
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptimalDefensive<E = RatioOfMeans> {
    /// The estimator on the mixture.
    pub estimator: E,
    /// How the weights are fitted.
    pub regression: Regression,
    /// The least weight a_0 of the proposal.
    pub floor: f64,
}

impl<E> OptimalDefensive<E> {
    /// `estimator` on the optimal defensive auxiliary.
    pub fn of(estimator: E) -> Self {
        Self { estimator, regression: Regression::default(), floor: 0.01 }
    }

    /// With the weights a of the auxiliaries given; a_k multiplies h_k/H_k.
    pub fn fixed<W, const K: usize>(self, weights: [W; K]) -> Fixed<Self, W, K> {
        Fixed { estimator: self, coefficients: weights }
    }
}

impl<E: Default> Default for OptimalDefensive<E> {
    fn default() -> Self {
        Self::of(E::default())
    }
}

fits_its_own_draws!(
    OptimalDefensive, "optimal_defensive_ratio", "optimal_defensive_ratio", "cross_fitted_optimal_defensive_ratio",
    block ComomentsBlock<V, K>, S: HasComoments<K>
);
fits_its_own_draws!(
    OptimalDefensive<Mickey>, "optimal_defensive_mickey", "optimal_defensive_mickey",
    "cross_fitted_optimal_defensive_mickey",
    block Joined<ComomentsBlock<V, K>, (), GroupsBlock<V, 8, K>>, S: HasComoments<K> + HasGroups<K>
);

impl<S: HasComoments<K>, E, const K: usize> Fit<S, K> for OptimalDefensive<E>
where
    E: for<'a> Estimator<Combined<'a, S, K>>,
{
    fn fit(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> Coefficients<K> {
        let mean = self.regression.estimate(sample, integrals);
        let weights_among = |regression: &Regression, among: &[bool; K]| {
            let beta = regression.fit_among(sample, among);
            beta.map(|k| if beta.values[k] == 0.0 { 0.0 } else { beta.values[k] * (integrals[k] / mean) })
        };
        let mut weights = weights_among(&self.regression, &[true; K]);
        if weights.values.iter().any(|weight| *weight < 0.0) {
            let free = Regression { shrink: false, ..self.regression };
            let among = nonnegative(|among| weights_among(&free, among).values);
            let again = weights_among(&self.regression, &among);
            weights = Coefficients { flags: again.flags | weights.flags | Flags::ALPHA, ..again };
        }
        if weights.values.iter().any(|weight| !weight.is_finite()) {
            return Coefficients { flags: weights.flags | Flags::ALPHA, ..Coefficients::given([0.0; K]) };
        }
        let (sum, most) = (weights.values.iter().sum::<f64>(), 1.0 - self.floor);
        if sum <= most {
            return weights;
        }
        let scale = planted!("optimal_defensive_clamp": most / sum, 1.0);
        Coefficients { flags: weights.flags | Flags::ALPHA, ..weights.map(|k| scale * weights.values[k]) }
    }
}

impl<S: HasMeans<K>, E, const K: usize> WithCoefficients<S, K> for OptimalDefensive<E>
where
    E: for<'a> Estimator<Combined<'a, S, K>>,
{
    fn estimate_with(
        &self,
        sample: &Sample<'_, S>,
        integrals: &[f64; K],
        coefficients: &Coefficients<K>,
    ) -> ChannelEstimate {
        let of_proposal = 1.0 - coefficients.values.iter().sum::<f64>();
        Combined::estimate(&self.estimator, sample, integrals, of_proposal, coefficients)
    }
}
