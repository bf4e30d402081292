//! C: offsets, constants, cancellation.

use super::both;
use crate::answer::ErrorBar;
use crate::case::Precision::{Double, Single};
use crate::case::{Ask, Case, Precision};
use crate::draws::Draws;
use crate::method::Method;
use crate::noise::noise;
use ratiocv_core::{Draw, Flags};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = both(in_each_precision);
    let variance = |id, about, precision, less, f: Vec<f64>, right| {
        let ask = Ask::One { method: Method::Variance(less), draws: Draws::of_f(f), then: None, integral: 1.0 };
        Case::new(id, about, precision, ask, right)
    };
    // C1 and C2 proper are in StRD.
    let about = "10¹² … 10¹² + 6";
    cases.push(variance("C3", about, Double, 0.0, (0..7).map(|i| 1e12 + f64::from(i)).collect(), 4.0).exact());
    cases.push(variance("C4", "7·10¹² + 5 and + 7", Double, 0.0, vec![7e12 + 5.0, 7e12 + 7.0], 1.0).exact());
    let xs = [3.0, 4.0, 6.0, 7.0].map(|x| 1e8 + x).to_vec();
    cases.push(variance("C4", "10⁸ + 3, 4, 6, 7", Double, 0.0, xs, 2.5).exact());
    let constant = vec![100_000_000.815_068_51; 10_000];
    cases.push(variance("C6", "10⁴ times an awkward constant", Double, 1.0, constant, 0.0).exact());
    let mut close = vec![1.0; 7];
    close[6] = 1.000_000_000_000_01;
    cases.push(variance("C8", "six ones and 1 + 10⁻¹⁴", Double, 1.0, close, 1.426_288_690_243_347_2e-29).digits(12.0));
    cases.push(variance("C11", "three times 10⁹", Single, 1.0, vec![1e9; 3], 0.0).exact());
    for seed in 0..16 {
        let draws = Draws::new(64, move |i| {
            let h = (noise(700 + seed, i) as f32) + 0.5;
            Draw::new(f64::from(h / 3.0), f64::from(h))
        });
        let ask = Ask::One { method: Method::Residual, draws, then: None, integral: 1.0 };
        // At most (64 unit roundoffs)², and not below 0: the middle, to within itself.
        let about = "f = fl(h/3): Σ(f − R̂h)², in squared roundoffs";
        cases.push(Case::new("C7", about, Single, ask, 2048.0).digits(0.0));
    }
    cases
}

fn in_each_precision(precision: Precision) -> Vec<Case> {
    let one = |method, draws, integral| Ask::One { method, draws, then: None, integral };
    let mut cases = Vec::new();
    let tenth = precision.rounded(0.1);
    let constant = || Draws::new(1_000_000, move |_| Draw::new(tenth, 1.0));
    let about = "a million times 0.1";
    let mean = Case::new("C5", about, precision, one(Method::Plain, constant(), 1.0), tenth);
    cases.push(mean.exact().error(ErrorBar::Near(0.0)));
    cases.push(Case::new("C5", about, precision, one(Method::Variance(1.0), constant(), 1.0), 0.0).exact());
    // f̄ of multiples of ¼, exactly.
    let quarters = || Draws::new(128, |i| Draw::new((i % 8) as f64 / 4.0, 0.75));
    for method in [Method::Ratio, Method::Beale, Method::Tin, Method::Quenouille, Method::Difference, Method::Choose] {
        let c9 = Case::new("C9", "h constant and H", precision, one(method, quarters(), 0.75), 0.875);
        cases.push(c9.exact().silent());
    }
    let doubled = || {
        Draws::new(100, |i| {
            let h = 0.25 + (i * i % 13) as f64;
            Draw::new(2.0 * h, h)
        })
    };
    let about = "f = 2h";
    for method in [
        Method::Ratio,
        Method::Quenouille,
        Method::Beale,
        Method::Tin,
        Method::MeanOfRatios,
        Method::HartleyRoss,
        Method::Mickey,
    ] {
        let c10 = Case::new("C10", about, precision, one(method, doubled(), 6.0), 12.0);
        let c10 = c10.digits(15.0);
        // Beale's coefficient is a rounding off 2, and the error bar then the rounding floor, with its flag: 64 unit
        // roundoffs of s_f/√N = 0.86.
        cases.push(match method {
            Method::Beale => c10.error(ErrorBar::AtMost(64.0 * precision.of(6e-8, 1.2e-16) * 0.86)),
            _ => c10.error(ErrorBar::Near(0.0)).silent(),
        });
    }
    for method in [Method::Difference, Method::RegressionRatio] {
        let c10 = Case::new("C10", about, precision, one(method, doubled(), 6.0), 12.0);
        cases.push(c10.digits(precision.of(6.0, 13.5)).error(ErrorBar::AtMost(1e-5)).may(Flags::ROUNDING));
    }
    cases
}
