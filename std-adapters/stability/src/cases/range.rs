//! B: dynamic range.

use super::both;
use crate::answer::ErrorBar;
use crate::case::Precision::{Double, Single};
use crate::case::{Ask, Case, Precision};
use crate::draws::Draws;
use crate::method::Method;
use ratiocv_core::{Draw, Flags};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = both(in_each_precision);
    // f and h of two draws, H, F.
    for (id, about, scale_f, scale_h) in [
        ("B1", "squares overflow", 1e20_f32, 1e20_f32),
        ("B2", "squares underflow", 1e-25, 1e-25),
        ("B3", "scales sixty orders apart: β = 10⁶⁰, α = 1", 1e30, 1e-30),
    ] {
        proportional(&mut cases, Single, (id, about), f64::from(scale_f), f64::from(scale_h));
    }
    proportional(&mut cases, Double, ("B1", "squares overflow"), 1e200, 1e200);
    proportional(&mut cases, Double, ("B2", "squares underflow"), 1e-200, 1e-200);
    let three = [(1e30, 1e-30), (3e30, 3e-30)];
    let about = "α = 1 before β = 10⁶⁰";
    cases.push(Case::of_pairs("B3", about, Double, (Method::Alpha, &three, 1e-30), 1.0).digits(14.0));
    let channels = [f64::from(1e-38_f32), 1.0, f64::from(1e38_f32)];
    for f in channels {
        let draws = Draws::new(100, move |_| Draw::new(f, 1.0));
        let ask = Ask::One { method: Method::Ratio, draws, then: None, integral: 1.0 };
        let about = "tiny, ordinary and enormous channels";
        cases.push(Case::new("B7", about, Single, ask, f).exact().error(ErrorBar::Near(0.0)));
    }
    cases
}

/// f = s·h of scales `f` and `h`, few draws and many, through value, fitted and chosen estimators: right or flagged.
fn proportional(
    cases: &mut Vec<Case>,
    precision: Precision,
    (id, about): (&'static str, &'static str),
    f: f64,
    h: f64,
) {
    let either = Flags::OVERFLOW | Flags::UNDERFLOW;
    // Four draws, since two leave nothing to fit.
    for count in [4, 200] {
        for method in [Method::Ratio, Method::RegressionRatio, Method::Difference, Method::Choose] {
            let draws = Draws::new(count, move |i| {
                let times = if i % 2 == 0 { 1.0 } else { 3.0 };
                Draw::new(times * f, times * h)
            });
            // A ratio reads no square: its value has no excuse.
            let reads_squares = method != Method::Ratio;
            let case = Case::new(id, about, precision, Ask::One { method, draws, then: None, integral: h }, f);
            let case = case.digits(precision.of(6.0, 14.0)).error(ErrorBar::AtMost(1e-5 * f));
            cases.push(if reads_squares { case.or(either) } else { honest(case, either) });
        }
    }
}

/// The value must be right; its error bar may be unknown, with a flag.
fn honest(case: Case, flags: Flags) -> Case {
    case.error(ErrorBar::Any).may(flags)
}

fn in_each_precision(precision: Precision) -> Vec<Case> {
    let largest = precision.of(f64::from(f32::MAX), f64::MAX);
    let far = precision.of(f64::from(1e19_f32), 1e155);
    let beyond = precision.of(f64::from(1e38_f32), 1e300);
    let merged = |id, about, method, first: &[f64], then: &[f64], right| {
        let ask = Ask::One { method, draws: Draws::of_f(first), then: Some(Draws::of_f(then)), integral: 1.0 };
        Case::new(id, about, precision, ask, right).exact()
    };
    let mut cases = Vec::new();
    for f in [largest, far] {
        cases.push(merged("B4", "one draw merged with nothing", Method::Variance(0.0), &[f], &[], 0.0));
        cases.push(merged("B4", "one draw merged with nothing", Method::Ratio, &[f], &[], f));
    }
    let cancelling = Draws::of_f([largest, -largest]);
    let ask = Ask::One { method: Method::Plain, draws: cancelling, then: None, integral: 1.0 };
    let b5 = Case::new("B5", "the largest number and its negative", precision, ask, 0.0);
    // The first draws of f32 are kept in f64, where the squares fit: Σf² = 2·MAX², over 1·2.
    cases.push(match precision {
        Single => b5.exact().error(ErrorBar::Near(largest)),
        Double => b5.exact().or(Flags::OVERFLOW | Flags::NONFINITE).error(ErrorBar::Unknown),
    });
    let about = "parts whose squared distance overflows";
    let b6 = merged("B6", about, Method::Plain, &[beyond], &[-beyond], 0.0);
    cases.push(if precision == Double { b6.must(Flags::OVERFLOW).error(ErrorBar::Unknown) } else { b6 });
    for (method, right) in [(Method::Ratio, 1e-6), (Method::Difference, 1e-6), (Method::RegressionRatio, 1e-6)] {
        let draws = Draws::new(100, move |i| {
            let h = 0.5 + (i * 7 % 16) as f64 / 16.0;
            Draw::new(1e-6 * h, h)
        });
        let ask = Ask::One { method, draws, then: None, integral: 1.0 };
        let about = "a channel of 10⁻⁶ beside ordinary ones";
        cases.push(Case::new("B8", about, precision, ask, right).digits(precision.of(6.0, 14.0)));
    }
    let dark = Ask::One {
        method: Method::Difference,
        draws: Draws::new(64, |i| Draw::new(0.0, 1.0 + (i % 3) as f64)),
        then: None,
        integral: 2.0,
    };
    let b9 = Case::new("B9", "a channel that is 0 beside others", precision, dark, 0.0);
    cases.push(b9.exact().must(Flags::NO_SUPPORT).error(ErrorBar::Unknown));
    // f's mean and h's are ordinary to divide; the products of their deviations are not.
    let large = precision.of(f64::from(3e37_f32), 3e307);
    let pairs =
        [(large, 4.0), (2.0 * large, 8.0), (3.0 * large, 12.0), (large, 4.0), (3.0 * large, 12.0), (2.0 * large, 8.0)];
    let b10 =
        Case::of_pairs("B10", "only products of deviations overflow", precision, (Method::Ratio, &pairs, 4.0), large);
    cases.push(if precision == Double {
        b10.digits(15.0).may(Flags::OVERFLOW).error(ErrorBar::Unknown)
    } else {
        b10.digits(6.5).may(Flags::OVERFLOW)
    });
    cases
}
