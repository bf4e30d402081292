//! The random mixture ratio: several auxiliaries as one.

use crate::estimate::ChannelEstimate;
use crate::estimator::fixed::fits_its_own_draws;
use crate::estimator::nonnegative::nonnegative;
use crate::estimator::{
    Coefficients, Combined, Estimator, Fit, Fixed, Mickey, RatioOfMeans, Regression, Sample, WithCoefficients,
};
use crate::flags::Flags;
use crate::moments::{ComomentsBlock, GroupsBlock, HasComoments, HasGroups, HasMeans, Joined};
use crate::planted::planted;
use crate::solve::solve;
use core::array;

/// The random mixture ratio: `E` on the auxiliary h′ = Σ_k a_k·h_k/H_k, of integral Σa_k.
///
/// With the ratio of means, ȳ·Σα_kH_k/Σα_k x̄_k for α_k = a_k/H_k: consistent, MSE
/// Var(y − FΣ_k a_k x_k/H_k)/N to first order for Σa_k = 1. The least, over all a, is a least-squares
/// problem in h_k/H_k (the supplement's Lemma 12, which lacks the H_k), for two auxiliaries
/// a_2 = Cov(u_2 − u_1, y/F − u_1)/Var(u_2 − u_1), u_k = x_k/H_k.
///
/// As it stands a is learned from the draws, Σa = 1 and a ≥ 0, so that the denominator is positive where
/// every h is; where F̂ = 0 or auxiliaries coincide the weights are equal, or shared equally (ALPHA,
/// RANK). Weights that are given ([`fixed`](RandomMixture::fixed)) may be anything; Σa_k x̄_k/H_k = 0
/// gives ȳ and DENOM_ZERO.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, Estimator, Integrals, RandomMixture};
/// let mut moments = Comoments::<f64, 2>::default();
/// for i in 0..32 {
///     let (a, b) = (f64::from(i % 4), f64::from(i / 4));
///     moments.add(Draw { f: 3.0 * a + b, h: [a, b] });
/// }
/// let estimate = RandomMixture::default().estimate(&moments, &Integrals::new([1.0, 3.0]))?;
/// assert!((estimate.value - 6.0).abs() < 1e-12); // f is a mixture of the two
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RandomMixture<E = RatioOfMeans> {
    /// The estimator on the mixture.
    pub estimator: E,
    /// How the weights are fitted.
    pub regression: Regression,
}

impl<E> RandomMixture<E> {
    /// With the weights a given; a_k multiplies h_k/H_k.
    pub fn fixed<W, const K: usize>(self, weights: [W; K]) -> Fixed<Self, W, K> {
        Fixed { estimator: self, coefficients: weights }
    }
}

fits_its_own_draws!(
    RandomMixture, "random_mixture", "random_mixture", "cross_fitted_random_mixture",
    block ComomentsBlock<V, K>, S: HasComoments<K>
);
fits_its_own_draws!(
    RandomMixture<Mickey>, "random_mixture_mickey", "random_mixture_mickey", "cross_fitted_random_mixture_mickey",
    block Joined<ComomentsBlock<V, K>, (), GroupsBlock<V, 8, K>>, S: HasComoments<K> + HasGroups<K>
);

impl<S: HasComoments<K>, E, const K: usize> Fit<S, K> for RandomMixture<E>
where
    E: for<'a> Estimator<Combined<'a, S, K>>,
{
    fn fit(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> Coefficients<K> {
        let mut weights = self.weights_among(&self.regression, sample, integrals, &[true; K]);
        if weights.values.iter().any(|weight| *weight < 0.0) {
            let free = Regression { shrink: false, ..self.regression };
            let among = nonnegative(|among| self.weights_among(&free, sample, integrals, among).values);
            let again = self.weights_among(&self.regression, sample, integrals, &among);
            weights = Coefficients { flags: again.flags | weights.flags | Flags::ALPHA, ..again };
        }
        weights
    }
}

impl<E> RandomMixture<E> {
    /// The best weights that are 0 but for the auxiliaries `among`, of which there is at least one.
    ///
    /// Equal weights e and a correction δ with Σδ = 0: y/F − Σe_k u_k is regressed on the differences
    /// u_k − u_b from one auxiliary b of them, u = x/H.
    fn weights_among<S: HasComoments<K>, const K: usize>(
        &self,
        regression: &Regression,
        sample: &Sample<'_, S>,
        integrals: &[f64; K],
        among: &[bool; K],
    ) -> Coefficients<K> {
        let (spread, mean) = (sample.moments.comoments(), self.regression.estimate(sample, integrals));
        let number = among.iter().filter(|taken| **taken).count() as f64;
        let equal: [f64; K] = array::from_fn(|k| if among[k] { 1.0 / number } else { 0.0 });
        let base = among.iter().position(|taken| *taken).unwrap_or(0);
        let uu = |i: usize, j: usize| spread.hh[i][j] / integrals[i] / integrals[j];
        let yu = |k: usize| spread.fh(k) / integrals[k] / mean;
        let from_base = |k: usize, j: usize| uu(k, j) - uu(base, j);
        let matrix = array::from_fn(|i| array::from_fn(|j| from_base(i, j) - from_base(i, base)));
        let equally = |k: usize| (0..K).map(|j| equal[j] * from_base(k, j)).sum::<f64>();
        let right: [f64; K] = array::from_fn(|k| yu(k) - yu(base) - equally(k));
        let wanted = array::from_fn(|k| {
            let differs = matrix[k][k] > 64.0 * sample.epsilon * (uu(k, k) + uu(base, base));
            f64::from(u8::from(among[k] && k != base && differs))
        });
        let solution = solve(&matrix, &right, &wanted, 64.0 * sample.epsilon);
        let rank = solution.determined.iter().sum::<f64>();
        let freedom = sample.count as f64 - 1.0 - rank;
        let explained: f64 = (0..K).map(|k| solution.x[k] * right[k]).sum();
        let lost: f64 = solution.x.iter().sum();
        let change =
            |k: usize| planted!("random_mixture_base": if k == base { -lost } else { solution.x[k] }, solution.x[k]);
        let c = array::from_fn(|k| if among[k] { mean * (equal[k] + change(k)) / integrals[k] } else { 0.0 });
        let kept = regression.kept(explained, spread.about(&c) / mean / mean, rank, freedom);
        let values = array::from_fn(|k| if among[k] { equal[k] + kept * change(k) } else { 0.0 });
        let lacks = (0..K).any(|k| among[k] && k != base && solution.determined[k] == 0.0);
        let flags = Flags::when(lacks, Flags::RANK);
        if sample.count < 2 || mean == 0.0 || values.iter().any(|weight: &f64| !weight.is_finite()) {
            return Coefficients { flags: flags | Flags::ALPHA, ..Coefficients::given(equal) };
        }
        Coefficients {
            values,
            parameters: rank,
            flags: flags | Flags::when(freedom <= 0.0 && rank > 0.0, Flags::ALPHA),
        }
    }
}

impl<S: HasMeans<K>, E, const K: usize> WithCoefficients<S, K> for RandomMixture<E>
where
    E: for<'a> Estimator<Combined<'a, S, K>>,
{
    fn estimate_with(
        &self,
        sample: &Sample<'_, S>,
        integrals: &[f64; K],
        coefficients: &Coefficients<K>,
    ) -> ChannelEstimate {
        Combined::estimate(&self.estimator, sample, integrals, 0.0, coefficients)
    }
}
