//! The part of an estimate that is the same for all estimators: fall-backs, error bar, flags.

use crate::estimate::ChannelEstimate;
use crate::estimator::Sample;
use crate::estimator::regression::leverage;
use crate::flags::Flags;
use crate::moments::{HasMeans, Spread, Tails};
use crate::planted::planted;
use crate::scaled::quotient_times;

/// What there is to say about one channel before any formula is applied.
#[derive(Clone, Copy, Debug)]
pub(super) struct Remarks<const K: usize = 1> {
    count: u64,
    epsilon: f64,
    mean_f: f64,
    mean_h: [f64; K],
    /// Those of the auxiliaries that are read; 0 before that is known.
    integrals: [f64; K],
    spread: Option<Spread<K>>,
    tails: Option<Tails>,
    flags: Flags,
}

impl<const K: usize> Remarks<K> {
    /// Of an estimator that reads no auxiliary.
    pub(super) fn without_auxiliary<S: HasMeans<K>>(sample: &Sample<'_, S>) -> Self {
        // f/f: an auxiliary about which there is nothing to remark.
        let mean_f = sample.moments.means(sample.count).f;
        let mut remarks = Self::new(sample, mean_f, [if mean_f == 0.0 { 0.0 } else { 1.0 }; K]);
        // Nor is it f's concern if squares of an auxiliary left the range.
        if let Some(spread) = remarks.spread.as_mut().filter(|spread| spread.ff().is_finite()) {
            *spread = Spread::of_integrand(spread.ff());
            remarks.flags = remarks.flags.without(Flags::OVERFLOW | Flags::UNDERFLOW);
        }
        remarks
    }

    /// Of an estimator that reads the auxiliaries whose integrals are `integrals`.
    pub(super) fn with_auxiliaries<S: HasMeans<K>>(sample: &Sample<'_, S>, integrals: &[f64; K]) -> Self {
        let means = sample.moments.means(sample.count);
        let mut remarks = Self { integrals: *integrals, ..Self::new(sample, means.f, means.h) };
        for (k, integral) in integrals.iter().enumerate() {
            remarks.judge_auxiliary(k, *integral);
        }
        remarks
    }

    fn new<S: HasMeans<K>>(sample: &Sample<'_, S>, mean_f: f64, mean_h: [f64; K]) -> Self {
        let (spread, tails) = (sample.moments.spread(), sample.moments.tails());
        let mut flags = Flags::when(sample.count == 0, Flags::EMPTY)
            | Flags::when(sample.count == 1, Flags::ONE_SAMPLE)
            | Flags::when(!mean_f.is_finite() || mean_h.iter().any(|h| h.is_infinite()), Flags::NONFINITE);
        if sample.count > 0 && mean_f == 0.0 {
            // Zero draws, or draws that cancel? Only the spread can tell, or auxiliaries that are zero
            // as well.
            let unseen = spread.map_or(mean_h.iter().all(|h| *h == 0.0), |spread| spread.ff() == 0.0);
            flags |= Flags::when(unseen, Flags::NO_SUPPORT);
        }
        let finite = mean_f.is_finite() && mean_h.iter().all(|h| h.is_finite());
        if let Some(Spread { ee, eh, hh, .. }) = spread.filter(|_| finite) {
            let overflow = ee.is_infinite() || eh.iter().chain(hh.as_flattened()).any(|square| square.is_infinite());
            flags |= Flags::when(overflow, Flags::OVERFLOW);
            let underflow = ee.is_nan() || (0..K).any(|k| hh[k][k].is_nan());
            flags |= Flags::when(!overflow && underflow, Flags::UNDERFLOW);
        }
        if let (Some(tails), Some(spread)) = (tails, spread) {
            let squares = spread.ff() + sample.count as f64 * mean_f * mean_f;
            let heavy = sample.count >= 100 && tails.max_f * tails.max_f > 0.1 * squares;
            flags |= Flags::when(heavy, Flags::HEAVY_TAIL);
        }
        Self { count: sample.count, epsilon: sample.epsilon, mean_f, mean_h, integrals: [0.0; K], spread, tails, flags }
    }

    fn judge_auxiliary(&mut self, k: usize, integral: f64) {
        let (n, mean) = (self.count as f64, self.mean_h[k]);
        self.flags |= bad(integral) | Flags::when(self.count > 0 && !mean.is_finite(), Flags::NONFINITE);
        if let Some(tails) = self.tails.filter(|_| K == 1) {
            // κ = Σ|h|/|Σh|: fewer than four digits left?
            let ill = self.epsilon * tails.abs_h > 1e-4 * (n * mean).abs();
            self.flags |= Flags::when(ill && tails.abs_h > 0.0, Flags::DENOM_ILL);
        }
        let Some(hh) = self.spread.map(|spread| spread.hh[k][k]) else { return };
        if self.count < 2 || mean == 0.0 || !hh.is_finite() {
            return;
        }
        let error = libm::sqrt(hh / (n - 1.0) / n);
        let ess = n / (1.0 + hh / n / mean / mean);
        let off = (mean - integral).abs();
        let rounding = 8.0 * self.epsilon * (mean.abs() + integral.abs());
        self.flags |= Flags::when(mean.abs() < 5.0 * error, Flags::DENOM_ILL)
            | Flags::when(ess < (n / 10.0).min(100.0), Flags::LOW_ESS)
            | Flags::when(integral.is_finite() && off > chance_limit(n - 1.0) * error + rounding, Flags::AUX_MISMATCH);
    }

    /// The flags so far.
    pub(super) fn flags(&self) -> Flags {
        self.flags
    }

    /// These remarks without those in `others`.
    pub(super) fn without(mut self, others: Flags) -> Self {
        self.flags = self.flags.without(others);
        self
    }

    /// These remarks and `more`.
    pub(super) fn and(mut self, more: Flags) -> Self {
        self.flags |= more;
        self
    }

    /// The plain mean, with its own error bar: what an undefined result falls back to.
    pub(super) fn plain(&self, why: Flags) -> ChannelEstimate {
        self.finish(self.mean_f, &[0.0; K], why)
    }

    /// DENOM_ZERO, unless the flags already say why there is no estimate.
    pub(super) fn zero_denominator(&self) -> Flags {
        Flags::when(!self.flags.fell_back() && !self.flags.contains(Flags::NO_SUPPORT), Flags::DENOM_ZERO)
    }

    /// `value`, whose error to first order is that of y − Σc_k·x_k.
    pub(super) fn value(&self, value: f64, c: &[f64; K]) -> ChannelEstimate {
        self.value_with_fit(value, c, 0.0)
    }

    /// The same for coefficients that were fitted to these very draws, of `parameters` degrees of freedom.
    pub(super) fn value_with_fit(&self, value: f64, c: &[f64; K], parameters: f64) -> ChannelEstimate {
        let value = value + 0.0; // −0 becomes 0
        let negative = Flags::when(value < 0.0 && self.mean_f >= 0.0, Flags::NEGATIVE);
        with_error(self.finish(value, c, negative), |error| error * self.wider(parameters))
    }

    /// By how much fitting `parameters` coefficients to the draws widens the error bar: they took that
    /// many degrees of freedom from the residuals, and reach out from x̄ to H, as in any regression. NaN
    /// where no freedom is left.
    pub(super) fn wider(&self, parameters: f64) -> f64 {
        let (n, Some(spread)) = (self.count as f64, self.spread.as_ref()) else { return 1.0 };
        if parameters == 0.0 {
            return 1.0;
        }
        let apart = core::array::from_fn(|k| self.integrals[k] - self.mean_h[k]);
        let reach = 1.0 + planted!("fit_leverage": n, 1.0) * leverage(spread, &apart, self.epsilon);
        let freedom = n - 1.0 - parameters;
        if freedom > 0.0 { libm::sqrt(reach * planted!("fit_freedom": (n - 1.0) / freedom, 1.0)) } else { f64::NAN }
    }

    /// `value`, whose standard error is `error`.
    pub(super) fn value_with_error(&self, value: f64, error: f64) -> ChannelEstimate {
        let known = self.known_error();
        with_error(self.value(value, &[0.0; K]), |_| if known { error } else { f64::NAN })
    }

    fn known_error(&self) -> bool {
        self.count >= 2 && !self.flags.contains(Flags::NO_SUPPORT)
    }

    fn finish(&self, value: f64, c: &[f64; K], flags: Flags) -> ChannelEstimate {
        let mut flags = self.flags | flags;
        if self.count == 0 || !value.is_finite() {
            let value = if self.count == 0 { f64::NAN } else { value };
            // A finite mean that the formula drove out of range is undefined too.
            if self.count > 0 && self.mean_f.is_finite() && value != self.mean_f {
                return self.finish(self.mean_f, &[0.0; K], flags | Flags::NONFINITE);
            }
            return ChannelEstimate { value: f64::NAN, std_error: f64::NAN, flags };
        }
        let std_error = match self.spread.filter(|_| self.known_error()) {
            None => f64::NAN,
            Some(spread) => {
                let squares = spread.about(c);
                let floor = spread.rounding_floor(self.epsilon);
                let below = squares > 0.0 && squares < floor;
                flags |= Flags::when(below, Flags::ROUNDING);
                // ∞ − ∞: a coefficient whose square is beyond the range.
                let unexplained = !flags.contains(Flags::UNDERFLOW) && !flags.contains(Flags::NONFINITE);
                flags |= Flags::when(squares.is_nan() && unexplained, Flags::OVERFLOW);
                let n = self.count as f64;
                let variance = if below { floor } else { squares } / planted!("std_error_divisor": n - 1.0, n);
                libm::sqrt(variance / n)
            }
        };
        with_error(ChannelEstimate { value: value + 0.0, std_error, flags }, |error| error)
    }
}

impl Remarks {
    /// Of an estimator that reads the auxiliary whose integral is `integral`.
    pub(super) fn with_auxiliary<S: HasMeans>(sample: &Sample<'_, S>, integral: f64) -> Self {
        Self::with_auxiliaries(sample, &[integral])
    }

    /// Of an estimator that reads ratios f/h alone, h with the integral `integral`.
    pub(super) fn with_ratios<S: HasMeans>(sample: &Sample<'_, S>, integral: f64) -> Self {
        let mut remarks = Self::without_auxiliary(sample);
        remarks.flags |= bad(integral);
        remarks
    }

    /// H·ȳ/x̄, or the plain mean where that is undefined.
    pub(super) fn ratio_of_means(&self, integral: f64) -> ChannelEstimate {
        let [mean_h] = self.mean_h;
        if self.flags.fell_back() || mean_h == 0.0 {
            return self.plain(self.zero_denominator());
        }
        self.value(quotient_times(self.mean_f, mean_h, integral), &[self.mean_f / mean_h])
    }
}

/// BAD_INTEGRAL, if it is.
fn bad(integral: f64) -> Flags {
    Flags::when(integral == 0.0 || !integral.is_finite(), Flags::BAD_INTEGRAL)
}

/// `estimate` with another standard error. One beyond the range is unknown, and OVERFLOW says why, unless NONFINITE does.
pub(super) fn with_error(estimate: ChannelEstimate, error: impl FnOnce(f64) -> f64) -> ChannelEstimate {
    let why = Flags::when(!estimate.flags.contains(Flags::NONFINITE), Flags::OVERFLOW);
    match error(estimate.std_error) {
        f64::INFINITY => ChannelEstimate { std_error: f64::NAN, flags: estimate.flags | why, ..estimate },
        std_error => ChannelEstimate { std_error, ..estimate },
    }
}

/// How many standard errors chance allows with `freedom` degrees of freedom: Student's quantile at
/// the two-sided probability 2e-9 of six standard errors, by Wallace's approximation (1959),
/// inverted; 6 for many draws, 7.0 for 64, and out of reach for two.
fn chance_limit(freedom: f64) -> f64 {
    let z = 6.0 * (8.0 * freedom + 3.0) / (8.0 * freedom + 1.0);
    libm::sqrt(freedom * libm::expm1(z * z / freedom))
}

#[cfg(test)]
mod tests {
    use super::chance_limit;

    #[test]
    fn chance_limits_are_students_quantiles() {
        // scipy.stats.t.isf(9.865876450376946e-10, freedom), SciPy 1.17.1.
        for (freedom, right) in [(7.0, 38.781), (15.0, 12.7052), (63.0, 7.003177), (1e6, 6.0000555)] {
            let ours = chance_limit(freedom);
            assert!((ours / right - 1.0).abs() <= 0.08, "{freedom}: {ours} for {right}");
        }
    }
}
