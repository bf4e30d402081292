//! What moments should be, and how far rounding may take them from it.

use crate::exact::Exact;
use num_traits::float::FloatCore;
use ratiocv_core::{Lanes, Scalar};

/// Rounding of sums in `S` over blocks, in units of its ε, for means relative to the range of the numbers: a block's
/// 64 terms, or a batch's 8 + 16 + 3, each below the range, and what the merges add.
const OF_MEANS: f64 = 80.0;

/// The same for sums of squares and products, relative to the number of draws times the ranges.
const OF_SQUARES: f64 = 400.0;

/// Numbers with their exact sum.
#[derive(Debug)]
pub(crate) struct Truth {
    pub(crate) count: Exact,
    pub(crate) sum: Exact,
    /// The largest size.
    pub(crate) most: f64,
    /// The largest less the smallest; infinite beyond `f64`.
    pub(crate) range: f64,
    numbers: Vec<Exact>,
}

impl Truth {
    /// Of at least one number.
    pub(crate) fn new(numbers: &[f64]) -> Self {
        let (least, greatest) =
            numbers.iter().fold((numbers[0], numbers[0]), |(low, high), x| (low.min(*x), high.max(*x)));
        let exact: Vec<Exact> = numbers.iter().map(|x| Exact::new(*x)).collect();
        Self {
            count: Exact::new(numbers.len() as f64),
            sum: Exact::sum(exact.iter().cloned()),
            most: least.abs().max(greatest.abs()),
            range: greatest - least,
            numbers: exact,
        }
    }

    /// The same numbers, with a range that is larger by `more`.
    pub(crate) fn widened(self, more: f64) -> Self {
        Self { range: self.range + more, ..self }
    }

    /// N·Σ(x − x̄)(y − ȳ).
    pub(crate) fn products(&self, other: &Self) -> Exact {
        let raw = Exact::sum(self.numbers.iter().zip(&other.numbers).map(|(x, y)| x * y));
        &(&self.count * &raw) - &(&self.sum * &other.sum)
    }

    /// How far a mean in `S` may be from the true one, absolutely.
    pub(crate) fn mean_tolerance<S: Scalar>(&self) -> f64 {
        let n = self.numbers.len() as f64;
        OF_MEANS * epsilon::<S>() * self.range
            + f64::EPSILON * (4.0 * self.most + (n + 8.0) * self.range)
            + (n + 4.0) * 5e-324
    }

    /// Panics unless `ours` is the mean, but for rounding in `S`; not finite only if numbers are apart by so much that
    /// sums of them overflow.
    pub(crate) fn mean_is<S: Scalar>(&self, ours: f64, what: &str) {
        if !ours.is_finite() {
            assert!(self.range > greatest::<S>() / 2048.0, "{what}: {ours} though no sum overflows");
            return;
        }
        let off = (&(&Exact::new(ours) * &self.count) - &self.sum).abs().over(&self.count);
        let allowed = self.mean_tolerance::<S>();
        assert!(off <= allowed, "{what}: {ours:e} is off by {off:e}, allowed {allowed:e}");
    }

    /// Panics unless `ours` is Σ(x − x̄)(y − ȳ), summed up in `S` from x and from y + `steepest`·x; infinite or NaN
    /// only where squares leave the range.
    pub(crate) fn products_are<S: Scalar>(&self, other: &Self, steepest: f64, ours: f64, what: &str) {
        let range = |truth: &Self| truth.range + steepest * if core::ptr::eq(truth, self) { 0.0 } else { self.range };
        let n = self.numbers.len() as f64;
        let size = range(self) * range(other);
        let largest = range(self).max(range(other));
        if !ours.is_finite() {
            let over = largest > libm::sqrt(greatest::<S>()) / 4096.0;
            assert!(
                over || ours.is_nan() && self.is_fine::<S>(other),
                "{what}: {ours} though no square leaves the range"
            );
            return;
        }
        if !size.is_finite() {
            return;
        }
        let right = self.products(other);
        let off = (&(&Exact::new(ours) * &self.count) - &right).abs().over(&self.count);
        let allowed = (OF_SQUARES * epsilon::<S>() + 8.0 * (n + 8.0) * f64::EPSILON) * n * size
            + n * Lanes::widen(<S as FloatCore>::min_positive_value())
            + n * n * 5e-324 * (range(self) + range(other)); // means that are denormal
        assert!(off <= allowed, "{what}: {ours:e} is off by {off:e}, allowed {allowed:e}");
    }

    /// Whether numbers are so close together that squares of their differences may underflow.
    fn is_fine<S: Scalar>(&self, other: &Self) -> bool {
        let limit = 64.0 * libm::sqrt(Lanes::widen(<S as FloatCore>::min_positive_value()) / epsilon::<S>());
        [self, other].iter().any(|truth| {
            let mut sorted: Vec<f64> = truth.numbers.iter().map(Exact::value).collect();
            sorted.sort_by(f64::total_cmp);
            sorted.windows(2).any(|pair| pair[0] != pair[1] && pair[1] - pair[0] < limit)
        })
    }
}

pub(crate) fn epsilon<S: Scalar>() -> f64 {
    Lanes::widen(<S as FloatCore>::epsilon())
}

fn greatest<S: Scalar>() -> f64 {
    Lanes::widen(<S as FloatCore>::max_value())
}
