//! The least-squares coefficients β of f on the auxiliaries, from the moments of the draws.

use crate::estimator::Sample;
use crate::flags::Flags;
use crate::moments::{HasComoments, Spread};
use crate::planted::planted;
use crate::solve::solve;

/// What to do with auxiliaries that are linear combinations of others, as far as the draws can tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dependent {
    /// Of all coefficients that fit equally well, those of least Σβ²: two identical auxiliaries share.
    #[default]
    MinimumNorm,
    /// Leave out those that the others explain.
    Drop,
    /// No coefficient at all, the plain mean; also where one auxiliary is constant in the draws.
    Plain,
}

/// How coefficients are fitted: β̂ = Cov(x)⁻¹Cov(x, y), sample covariances, rank-revealing.
///
/// With `shrink`, β̂ is multiplied by max(0, 1 − rank·s²/(β̂ᵀS_xxβ̂)), s² the residual variance with
/// N − 1 − rank degrees of freedom: 1 less the reciprocal of the F statistic (after James and Stein
/// 1961). What fits no better than noise would is left out; the factor tends to 1 as 1/N where the
/// auxiliaries help. Without a degree of freedom left it is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regression {
    /// What becomes of dependent auxiliaries. RANK says that there were any: two that are the same but
    /// for the sign always, others where the moments have the digits to tell, a share of 64 ε of an
    /// auxiliary's variance. An outlier among n draws may cost n ε; the auxiliaries then have
    /// coefficients like independent ones, large, and f is fitted as well by them.
    pub dependent: Dependent,
    /// Whether β̂ is shrunk.
    pub shrink: bool,
}

impl Default for Regression {
    /// Shrunk, of minimum norm.
    fn default() -> Self {
        Self { dependent: Dependent::MinimumNorm, shrink: true }
    }
}

/// One coefficient per auxiliary, for one channel, and how they came about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients<const K: usize = 1> {
    /// The coefficients.
    pub values: [f64; K],
    /// Degrees of freedom that fitting took from these very draws; 0 if they come from elsewhere.
    pub parameters: f64,
    /// ALPHA, RANK.
    pub flags: Flags,
}

impl<const K: usize> Coefficients<K> {
    /// Coefficients that do not depend on the draws.
    pub const fn given(values: [f64; K]) -> Self {
        Self { values, parameters: 0.0, flags: Flags::NONE }
    }

    /// The same, changed one by one.
    pub(super) fn map(&self, change: impl FnMut(usize) -> f64) -> Self {
        Self { values: core::array::from_fn(change), ..*self }
    }
}

impl Regression {
    /// β̂ from `sample`: 0 for an auxiliary that is constant in it.
    pub(super) fn fit<S: HasComoments<K>, const K: usize>(&self, sample: &Sample<'_, S>) -> Coefficients<K> {
        self.fit_among(sample, &[true; K])
    }

    /// β̂ on the auxiliaries `among` alone, 0 for the others.
    pub(super) fn fit_among<S: HasComoments<K>, const K: usize>(
        &self,
        sample: &Sample<'_, S>,
        among: &[bool; K],
    ) -> Coefficients<K> {
        let (spread, none) = (sample.moments.comoments(), Coefficients::given([0.0; K]));
        if sample.count < 2 {
            return Coefficients { flags: Flags::ALPHA, ..none };
        }
        let wanted = core::array::from_fn(|k| f64::from(u8::from(among[k] && spread.hh[k][k] != 0.0)));
        let tolerance = 64.0 * sample.epsilon;
        // Where all are wanted, what is left in the residuals is added to the slopes that they are about:
        // that keeps the digits.
        let refined = solve(&spread.hh, &spread.eh, &wanted, tolerance);
        let is_whole = wanted == [1.0; K] && refined.determined == wanted;
        let fitted = solve(&spread.hh, &core::array::from_fn(|k| spread.fh(k)), &wanted, tolerance);
        let lacks_rank = fitted.lacks_rank(&wanted) != 0.0;
        let mut values = match self.dependent {
            _ if is_whole => core::array::from_fn(|k| spread.slope[k] + refined.x[k]),
            Dependent::MinimumNorm if lacks_rank => {
                let least = fitted.of_minimum_norm();
                core::array::from_fn(|k| wanted[k] * least[k])
            }
            Dependent::Plain if fitted.determined != [1.0; K] => [0.0; K],
            _ => fitted.x,
        };
        let flags = Flags::when(lacks_rank, Flags::RANK);
        if values.iter().any(|value| !value.is_finite()) {
            return Coefficients { flags: flags | Flags::ALPHA, ..none };
        }
        let rank = fitted.determined.iter().sum::<f64>();
        let freedom = sample.count as f64 - 1.0 - rank;
        let explained: f64 = (0..K).map(|k| values[k] * spread.fh(k)).sum();
        let kept = self.kept(explained, spread.about(&values), rank, freedom);
        values = values.map(|value| kept * value);
        let unclear = Flags::when(freedom <= 0.0 && rank > 0.0, Flags::ALPHA);
        Coefficients { values, parameters: rank, flags: flags | unclear }
    }

    /// ȳ + Σβ̂_k(H_k − x̄_k), a first estimate of F for the weights of mixtures: with it they are exact where f
    /// is a mixture of the auxiliaries.
    pub(super) fn estimate<S: HasComoments<K>, const K: usize>(
        &self,
        sample: &Sample<'_, S>,
        integrals: &[f64; K],
    ) -> f64 {
        let (beta, means) = (self.fit(sample).values, sample.moments.means(sample.count));
        (0..K).filter(|k| beta[*k] != 0.0).fold(means.f, |value, k| value + beta[k] * (integrals[k] - means.h[k]))
    }

    /// The factor of shrinkage for a regression that explains the square sum `explained` and leaves
    /// `residual`, with `freedom` degrees of freedom.
    pub(super) fn kept(&self, explained: f64, residual: f64, rank: f64, freedom: f64) -> f64 {
        let noise = rank * residual / freedom;
        if !self.shrink {
            1.0
        } else if freedom > 0.0 && noise < explained {
            planted!("regression_shrink": 1.0 - noise / explained, noise / explained)
        } else {
            0.0
        }
    }
}

/// dᵀS⁻¹d for the sums of squares S of `spread`: how much further than 1/N a regression reaches out to
/// means that are `apart` from those of the draws.
pub(super) fn leverage<const K: usize>(spread: &Spread<K>, apart: &[f64; K], epsilon: f64) -> f64 {
    let along = solve(&spread.hh, apart, &[1.0; K], 64.0 * epsilon).x;
    let sum: f64 = (0..K).map(|k| along[k] * apart[k]).sum();
    if sum > 0.0 { sum } else { 0.0 }
}
