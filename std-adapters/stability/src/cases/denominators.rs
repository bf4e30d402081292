//! A: denominators that vanish, change sign, or leave the exponent range.

use super::both;
use crate::answer::ErrorBar;
use crate::case::Precision::{Double, Single};
use crate::case::{Ask, Case, Precision};
use crate::draws::Draws;
use crate::method::Method;
use crate::noise::noise;
use ratiocv_core::{Draw, Flags};

/// Every estimator of one auxiliary that divides by a mean.
const RATIOS: [Method; 6] =
    [Method::Ratio, Method::Quenouille, Method::Beale, Method::Tin, Method::Mickey, Method::Choose];

pub(super) fn cases() -> Vec<Case> {
    let mut cases = both(in_each_precision);
    let pairs = Case::of_pairs;
    let (least, tiny) = (f64::from(f32::from_bits(1)), f64::from(1e-30_f32));
    let about = "f = 1, h = H the least number";
    cases.push(pairs("A5", about, Single, (Method::Ratio, &[(1.0, least)], least), 1.0).exact());
    let least = f64::from_bits(1);
    cases.push(pairs("A5", about, Double, (Method::Ratio, &[(1.0, least)], least), 1.0).exact());
    let about = "f = h = H, whose square underflows";
    cases.push(pairs("A6", about, Single, (Method::Ratio, &[(tiny, tiny)], tiny), tiny).exact());
    cases.push(pairs("A6", about, Double, (Method::Ratio, &[(1e-200, 1e-200)], 1e-200), 1e-200).exact());
    let about = "H/h overflows, f/h·H does not";
    cases.push(pairs("A7", about, Single, (Method::Ratio, &[(1e-30, 1e-10)], f64::from(1e38_f32)), 1e18));
    cases.push(pairs("A7", about, Double, (Method::Ratio, &[(1e-250, 1e-60)], 1e300), 1e110));
    let small = libm::exp2(-25.0);
    for (about, order) in [
        ("a sum that cancels to its last bit", [1.0, small, -1.0]),
        ("the same in another order", [1.0, -1.0, small]),
        ("the same in another order", [small, -1.0, 1.0]),
    ] {
        let draws = order.map(|h| (1.0, h));
        let case = pairs("A8", about, Single, (Method::Ratio, &draws, 1.0), 100_663_296.0);
        cases.push(case.must(Flags::DENOM_ILL));
    }
    // Below the rounding of its terms in f64 no digit is known, and a flag says so.
    let h = [1.0, libm::exp2(-54.0), -1.0].map(|h| (1.0, h));
    let case =
        pairs("A8", "a sum below the rounding of its terms", Double, (Method::Ratio, &h, 1.0), 3.0 * libm::exp2(54.0));
    cases.push(case.or(Flags::DENOM_ILL).may(Flags::DENOM_ZERO));
    let ill = [1.0, -1.0 + libm::exp2(-23.0)].map(|h| (1.0, h));
    let about = "h = 1 and 2⁻²³ − 1: κ = 2²⁴ − 1";
    for (method, right) in
        [(Method::Ratio, 8_388_608.0), (Method::Condition, 16_777_215.0), (Method::RatioUnlessIll, 1.0)]
    {
        let flags = if method == Method::Condition { Flags::NONE } else { Flags::DENOM_ILL };
        cases.push(pairs("A9", about, Single, (method, &ill, 0.5), right).exact().must(flags));
    }
    cases
}

fn in_each_precision(precision: Precision) -> Vec<Case> {
    let pairs = |id, about, method, draws: &[(f64, f64)], integral, right| {
        Case::of_pairs(id, about, precision, (method, draws, integral), right)
    };
    let zero = Flags::DENOM_ZERO;
    let a1 = [(1.0, 1.0), (2.0, -1.0)];
    let mut cases =
        vec![pairs("A1", "Σh = 0", Method::Ratio, &a1, 1.0, 1.5).exact().must(zero).error(ErrorBar::Near(0.5))];
    for (id, about, nil) in [("A2", "h misses the support of f", 0.0), ("A4", "the same with h = −0", -0.0)] {
        let draws = [(1.0, nil), (2.0, nil), (3.0, nil)];
        cases.extend(RATIOS[..5].iter().map(|method| pairs(id, about, *method, &draws, 1.0, 2.0).exact().must(zero)));
        cases.extend(
            [Method::HartleyRoss, Method::MeanOfRatios]
                .map(|method| pairs(id, about, method, &draws, 1.0, 2.0).exact().must(Flags::UNBOUNDED_RATIO)),
        );
    }
    let black = [(0.0, 0.0); 3];
    for method in [Method::Ratio, Method::Quenouille, Method::Beale, Method::Tin, Method::Mickey, Method::HartleyRoss] {
        let case = pairs("A3", "the black pixel", method, &black, 1.0, 0.0).exact();
        cases.push(case.must(Flags::NO_SUPPORT).error(ErrorBar::Unknown));
    }
    let large = precision.of(f64::from(1e38_f32), 1e308);
    let about = "Σh overflows";
    cases.push(pairs("A10", about, Method::Ratio, &[(2.0, large); 4], large, 2.0).exact());
    cases.push(pairs("A10", "Σh overflows within a block", Method::Ratio, &[(2.0, large); 200], large, 2.0).exact());
    let draws = [(1.0, 1.0), (4.0, 2.0)];
    for (id, integral) in
        [("A11", 0.0), ("A11", -0.0), ("A12", f64::NAN), ("A12", f64::INFINITY), ("A12", f64::NEG_INFINITY)]
    {
        for method in [Method::Ratio, Method::Beale, Method::HartleyRoss, Method::Difference] {
            let about = if integral == 0.0 { "H = 0" } else { "H is no number" };
            cases.push(pairs(id, about, method, &draws, integral, 2.5).exact().must(Flags::BAD_INTEGRAL));
        }
    }
    let negative = [(1.0, -1.0), (2.0, -2.0), (3.0, -3.0)];
    let a13 = pairs("A13", "h and H below 0", Method::Ratio, &negative, -2.0, 2.0).exact().error(ErrorBar::Near(0.0));
    cases.push(a13);
    let many: Vec<_> = (0..300).map(|i| f64::from(i % 3 + 1)).map(|x| (x, -x)).collect();
    cases.push(pairs("A13", "the same, 300 draws", Method::Ratio, &many, -2.0, 2.0).exact().silent());
    let turned = [(1.0, -1.0), (2.0, -0.5), (6.0, 0.0)];
    let a14 = pairs("A14", "a root of a negative quotient", Method::Power(0.5), &turned, 1.0, 3.0);
    cases.push(a14.exact().must(Flags::DENOM_SIGN));
    // Every row is run beside innocent channels. By hand: s_fh = −1, s_hh = 2, so (0 − ½)/(0 + 1).
    let about = "Σh = 0 beside innocent channels, and an estimator that is defined there";
    cases.push(pairs("A15", about, Method::Beale, &a1, 1.0, -0.5).exact());
    let creeping = || Draws::new(1_000_000, |i| Draw::new(1.0, -1.0 + (2.0 + 1e-6) * noise(16, i)));
    let ask = Ask::One { method: Method::RatioUnlessIll, draws: creeping(), then: None, integral: 5e-7 };
    let about = "a denominator near 0 for ever; plain where it is ill";
    cases.push(Case::new("A16", about, precision, ask, 1.0).exact().must(Flags::DENOM_ILL));
    cases
}
