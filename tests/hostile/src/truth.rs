//! What moments should be, and how far rounding may take them from it.

use crate::exact::Exact;
use num_traits::float::FloatCore;
use ratiocv_core::{Lanes, Scalar};

// Rounding of sums in `S` over blocks, to first order, in its ε = 2u. A term is a difference from the block's first draw,
// off by u of the range of the numbers at most, and is in at most 80 sums: those of a run of 64, and of 16 runs.

/// Of a mean, relative to the range: u for the difference and 80 u for the sums.
const OF_MEANS: f64 = 41.0;

/// Of a sum of squares or products, relative to the number of draws times the ranges, residuals on K ≤ 3 slopes: K + 2 u
/// for each of the two factors, u for the product and 80 u for the sums; 162 u for the means that are taken off, twice
/// as far off as a mean, and as much for those of the blocks about their mean. 415 u.
const OF_SQUARES: f64 = 208.0;

/// Of a mean in a merge, in the ε of `f64`: 2 u for differences of anchors and means of half the draws, u for the product
/// and u for the sum.
const OF_MEANS_MERGED: f64 = 2.0;

/// Of a sum of squares in a merge: some 30 u for two slopes that turn, three sums and e², and 16·2 ε for means that were
/// off and each of whose draws are in the smaller part of 8 merges at most.
const OF_SQUARES_MERGED: f64 = 48.0;

/// Numbers with their exact sum.
#[derive(Clone, Debug)]
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

    /// The same numbers, of which residuals were summed up: about slopes along which auxiliaries range over `reached`,
    /// put back along them afterwards, where it counts twice.
    pub(crate) fn about(self, reached: f64) -> Self {
        Self { range: self.range + 2.0 * reached, ..self }
    }

    /// N·Σ(x − x̄)(y − ȳ).
    pub(crate) fn products(&self, other: &Self) -> Exact {
        let raw = Exact::sum(self.numbers.iter().zip(&other.numbers).map(|(x, y)| x * y));
        &(&self.count * &raw) - &(&self.sum * &other.sum)
    }

    /// How far a mean in `S` may be from the true one, absolutely.
    pub(crate) fn mean_tolerance<S: Scalar>(&self) -> f64 {
        let n = self.numbers.len() as f64;
        (OF_MEANS * epsilon::<S>() + OF_MEANS_MERGED * self.merges() * f64::EPSILON) * self.range
            + f64::EPSILON * self.most
            + (n + 4.0) * 5e-324
    }

    /// Merges at most: of eight parts, each of four blocks of one draw, blocks of 64 and a shorter one.
    fn merges(&self) -> f64 {
        let n = self.numbers.len();
        (n - 1).min(8 * 5 + n / 64) as f64
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

    /// Panics unless `ours` is Σ(x − x̄)(y − ȳ), summed up in `S`; infinite or NaN only where squares leave the range.
    pub(crate) fn products_are<S: Scalar>(&self, other: &Self, ours: f64, what: &str) {
        let n = self.numbers.len() as f64;
        let size = self.range * other.range;
        let largest = self.range.max(other.range);
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
        let allowed = (OF_SQUARES * epsilon::<S>() + OF_SQUARES_MERGED * self.merges() * f64::EPSILON) * n * size
            + n * Lanes::widen(<S as FloatCore>::min_positive_value())
            + n * n * 5e-324 * (self.range + other.range); // means that are denormal
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
