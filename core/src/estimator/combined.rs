//! A linear combination of auxiliaries is an auxiliary: its moments, formed when the estimate is made.

use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::{Remarks, with_error};
use crate::estimator::{Coefficients, Estimator, Sample};
use crate::flags::Flags;
use crate::moments::{Group, HasComoments, HasGroups, HasMeans, HasRatioMean, Means, RatioMoments, Spread, Tails};
use crate::planted::planted;

/// The moments of (f, h′), h′ = constant + Σ_k coefficient_k·h_k, seen through those of (f, h).
///
/// Costs nothing per draw, and any estimator of one auxiliary runs on it: the defensive auxiliary
/// (`K` = 1) and mixtures of several are made so. Only f/h′ cannot be formed afterwards.
#[derive(Clone, Copy, Debug)]
pub struct Combined<'a, S, const K: usize = 1> {
    moments: &'a S,
    constant: f64,
    coefficients: [f64; K],
    /// The defensive weight, for moments that accumulate f/h′.
    weight: f64,
}

impl<'a, S> Combined<'a, S> {
    /// h′ = εH + (1−ε)h, ε = `weight`: of integral H.
    #[inline(always)]
    pub(super) const fn defensive(moments: &'a S, weight: f64, constant: f64) -> Self {
        Self { moments, constant, coefficients: [1.0 - weight], weight }
    }
}

impl<S, const K: usize> Combined<'_, S, K> {
    /// The estimate of `estimator` on h′ = a_0 + Σ_k a_k·h_k/H_k, of integral Σa, a_0 being `of_proposal`.
    pub(super) fn estimate<E>(
        estimator: &E,
        sample: &Sample<'_, S>,
        integrals: &[f64; K],
        of_proposal: f64,
        weights: &Coefficients<K>,
    ) -> ChannelEstimate
    where
        S: HasMeans<K>,
        E: for<'b> Estimator<Combined<'b, S, K>>,
    {
        let remarks = Remarks::with_auxiliaries(sample, integrals);
        if remarks.flags().fell_back() {
            return remarks.plain(Flags::NONE);
        }
        let integral = of_proposal + weights.values.iter().sum::<f64>();
        if integral == 0.0 {
            return remarks.plain(remarks.zero_denominator());
        }
        let over_integral =
            core::array::from_fn(|k| if weights.values[k] == 0.0 { 0.0 } else { weights.values[k] / integrals[k] });
        let combined =
            Combined { moments: sample.moments, constant: of_proposal, coefficients: over_integral, weight: f64::NAN };
        let estimate = estimator.estimate_channel(&sample.of(&combined), &[integral]);
        let flags = estimate.flags | weights.flags;
        with_error(ChannelEstimate { flags, ..estimate }, |error| error * remarks.wider(weights.parameters))
    }

    /// A mean of h′ from those of each h.
    #[inline(always)]
    pub(super) fn mean(&self, h: &[f64; K]) -> f64 {
        (0..K).fold(self.constant, |mean, k| mean + self.coefficients[k] * h[k])
    }

    fn spread_of(&self, spread: &Spread<K>) -> Spread {
        let along = |of: &dyn Fn(usize) -> f64| -> f64 { (0..K).map(|k| self.coefficients[k] * of(k)).sum() };
        let hh = along(&|i| along(&|j| spread.hh[i][j]));
        // The residuals of f about the least-squares multiple of h′; for one auxiliary they are the same.
        let slope = match self.coefficients[..] {
            [one] if one != 0.0 => spread.slope[0] / one,
            _ => along(&|k| spread.fh(k)) / hh,
        };
        let slope = if slope.is_finite() { slope } else { 0.0 };
        let c = self.coefficients.map(|coefficient| slope * coefficient);
        let turned = |k: usize| -> f64 {
            (0..K).map(|j| (spread.slope[j] - planted!("combined_turn": c[j], 0.0)) * spread.hh[k][j]).sum()
        };
        let eh = if K == 1 { along(&|k| spread.eh[k]) } else { along(&|k| spread.eh[k] + turned(k)) };
        Spread {
            slope: [slope],
            ee: if K == 1 && slope != 0.0 { spread.ee } else { spread.about(&c) },
            eh: [eh],
            hh: [[hh]],
        }
    }
}

impl<S: HasMeans<K>, const K: usize> HasMeans for Combined<'_, S, K> {
    fn means(&self, count: u64) -> Means {
        let Means { f, h } = self.moments.means(count);
        Means { f, h: [self.mean(&h)] }
    }
    fn spread(&self) -> Option<Spread> {
        self.moments.spread().map(|spread| self.spread_of(&spread))
    }
    /// As of h: the condition of a sum that is defended is no worse.
    fn tails(&self) -> Option<Tails> {
        let tails = self.moments.tails().filter(|_| K == 1)?;
        let abs_h = self.coefficients.iter().map(|coefficient| coefficient.abs() * tails.abs_h).sum();
        Some(Tails { abs_h, nothing: 0, unbounded: 0, ..tails })
    }
}

impl<S: HasComoments<K>, const K: usize> HasComoments for Combined<'_, S, K> {
    fn comoments(&self) -> Spread {
        self.spread_of(&self.moments.comoments())
    }
}

impl<S: HasRatioMean> HasRatioMean for Combined<'_, S> {
    fn ratio(&self, weight: f64, integral: f64) -> Option<RatioMoments> {
        self.moments.ratio(mixed_twice(self.weight, weight), integral)
    }
}

/// The weight of H in an auxiliary that is mixed with it twice.
pub(super) fn mixed_twice(first: f64, second: f64) -> f64 {
    first + second - first * second
}

impl<S: HasGroups<K>, const K: usize> HasGroups for Combined<'_, S, K> {
    fn groups(&self) -> usize {
        self.moments.groups()
    }
    #[inline(always)]
    fn group(&self, count: u64, group: usize) -> Group {
        let Group { count, f, h } = self.moments.group(count, group);
        Group { count, f, h: [self.mean(&h)] }
    }
}
