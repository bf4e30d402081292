//! E: the estimators' own formulas, one auxiliary.

use super::both;
use crate::answer::ErrorBar;
use crate::case::{Case, Precision};
use crate::method::Method;
use ratiocv_core::Flags;

pub(super) fn cases() -> Vec<Case> {
    both(in_each_precision)
}

fn in_each_precision(precision: Precision) -> Vec<Case> {
    let one = |id, about, method, pairs: &[(f64, f64)], integral, right| {
        Case::of_pairs(id, about, precision, (method, pairs, integral), right)
    };
    let digits = precision.of(6.0, 14.0);
    let e1 = one("E1", "an unbiased estimate below 0", Method::HartleyRoss, &[(1.0, 0.1), (0.0, 1.9)], 1.0, -4.0);
    let mut cases = vec![e1.digits(digits).must(Flags::NEGATIVE)];
    // r̄ = 1 over (0, 0), (1, 1), (2, 1): 1 + 3/2·(1 − 2/3).
    let nothing = [(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)];
    cases.push(one("E2", "a draw with f = h = 0", Method::HartleyRoss, &nothing, 1.0, 1.5));
    let unbounded = [(1.0, 0.0), (1.0, 1.0), (4.0, 1.0)];
    for method in [Method::HartleyRoss, Method::MeanOfRatios] {
        cases.push(one("E3", "f ≠ 0 = h", method, &unbounded, 1.0, 2.0).exact().must(Flags::UNBOUNDED_RATIO));
    }
    let cancelling = [(1.0, 1.0), (-1.0, 3.0), (0.0, 2.0), (0.0, 2.0)];
    for (method, right) in [(Method::Beale, -0.04), (Method::Tin, -1.0 / 24.0)] {
        cases.push(one("E4", "f̄ = 0", method, &cancelling, 1.0, right));
        // Of h in units of `scale`: (f̄h̄ + s_fh/3)/(h̄² + s_hh/3) of f = 1, 2, 4 and h = 1, 3, 2: s_fh = ½, s_hh = 1.
        for scale in precision.of([1e-25_f64, 1e-12, 1e18], [1e-25, 1e-100, 1e100]) {
            let scale = precision.rounded(scale);
            let draws = [(1.0, scale), (2.0, 3.0 * scale), (4.0, 2.0 * scale)];
            let (beale, tin) =
                ((14.0 / 3.0 + 1.0 / 6.0) / (13.0 / 3.0), 7.0 / 6.0 * (1.0 + (0.5 / (14.0 / 3.0) - 0.25) / 3.0));
            let right = if method == Method::Beale { beale } else { tin };
            cases.push(one("E5", "h² leaves the range", method, &draws, scale, right).digits(digits));
        }
    }
    if precision == Precision::Double {
        let tiny = [(1.0, 1e-200), (2.0, 3e-200)];
        let e5 = one("E5", "h² underflows f64", Method::Beale, &tiny, 1e-200, 1.5);
        cases.push(e5.exact().must(Flags::UNDERFLOW).error(ErrorBar::Any).may(Flags::DENOM_ZERO | Flags::NONFINITE));
        // Free α would be 10¹³.
        let noise: Vec<_> =
            (0..100).map(|i| if i % 2 == 0 { (1.0, 1.0 + 1e-4) } else { (-1.0 + 2e-9, 1.0 - 1e-4) }).collect();
        for method in [Method::FreeRatio, Method::RegressionRatio] {
            let e6 = one("E6", "α from noise is 10¹³; clamped to 2", method, &noise, 1.5, 2.25e-9);
            cases.push(e6.digits(6.0).must(Flags::ALPHA));
        }
    }
    let a1 = [(1.0, 1.0), (2.0, -1.0)];
    let e7 = one("E7", "α = 0 while h̄ = 0", Method::Power(0.0), &a1, 1.0, 1.5).exact();
    cases.push(e7.error(ErrorBar::Near(0.5)).may(Flags::DENOM_ZERO));
    let nan = [(1.0, f64::NAN), (2.0, 1.0)];
    cases.push(one("E7", "α = 0 while h̄ is NaN", Method::Power(0.0), &nan, 1.0, 1.5).exact().must(Flags::NONFINITE));
    // ȳ = 3, h̄ = 2, H = 5: 7.5.
    let five = [(1.0, 1.0), (2.0, 4.0), (6.0, 1.0)];
    for method in [Method::Power(1.0), Method::Ratio] {
        let e8 = one("E8", "α = 1 is the ratio, to the bit", method, &five, 5.0, 7.5).exact();
        cases.push(e8.error(ErrorBar::Near(libm::sqrt(E8_VARIANCE))).digits(precision.of(6.5, 15.0)));
    }
    cases
}

/// Σ(f − 1.5h)²/(2·3) about its mean 0: (−½)² + (−4)² + 4.5² = 36.5.
const E8_VARIANCE: f64 = 36.5 / 6.0;
