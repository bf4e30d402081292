//! The sets of NIST's Statistical Reference Datasets (Rogers et al. 1998) that formulas make. Observed sets are not
//! free to be passed on.
//!
//! Judged against the exact answer of the *rounded* input.

use crate::case::Precision::Double;
use crate::case::{Ask, Case, Naive, Precision};
use crate::draws::Draws;
use crate::exact::mean_and_variance;
use crate::method::{Method, Several};
use ratiocv_core::Draw;

/// What the noise of Wampler3 to 5 is made of.
const NOISE: [f64; 21] = [
    759.0, -2048.0, 2048.0, -2048.0, 2523.0, -2048.0, 2048.0, -2048.0, 1838.0, -2048.0, 2048.0, -2048.0, 1838.0,
    -2048.0, 2048.0, -2048.0, 2523.0, -2048.0, 2048.0, -2048.0, 759.0,
];

/// b + .2, then 500 times b + .1 and b + .3: parsed, so rounded once.
fn num_acc(base: &str) -> Vec<f64> {
    let [first, low, high] = ["2", "1", "3"].map(|tenth| format!("{base}.{tenth}").parse().unwrap_or(f64::NAN));
    core::iter::once(first).chain((0..1000).map(|i| if i % 2 == 0 { low } else { high })).collect()
}

/// The first digits of π, by Rabinowitz's and Wagon's spigot (1995).
pub(super) fn digits_of_pi(count: usize) -> Vec<f64> {
    let length = (count + 10) * 10 / 3 + 1;
    let (mut remainders, mut digits) = (vec![2_u64; length], Vec::with_capacity(count + 10));
    let (mut nines, mut held) = (0, None);
    while digits.len() < count {
        let mut carry = 0;
        for i in (0..length).rev() {
            let x = 10 * remainders[i] + carry * (i as u64 + 1);
            let (divisor, limit) = if i == 0 { (10, 10) } else { (2 * i as u64 + 1, 2 * i as u64 + 1) };
            remainders[i] = x % limit;
            carry = x / divisor;
        }
        match carry {
            9 => nines += 1,
            digit => {
                let up = u64::from(digit == 10);
                digits.extend(held.map(|held: u64| (held + up) as f64));
                digits.extend(core::iter::repeat_n(if up == 1 { 0.0 } else { 9.0 }, nines));
                (held, nines) = (Some(digit % 10), 0);
            }
        }
    }
    digits.truncate(count);
    digits
}

/// Powers 1 to 5 of x.
fn powers(x: f64) -> [f64; 5] {
    core::array::from_fn(|j| (0..j).fold(x, |power, _| power * x))
}

/// y of one of Wampler's sets (1 to 5).
fn wampler(set: usize, i: usize) -> f64 {
    let powers = powers(i as f64);
    let smooth = 1.0 + powers.iter().sum::<f64>();
    match set {
        2 => (0..5).rev().fold(0.0, |sum, j| sum + powers[j] / [1e1, 1e2, 1e3, 1e4, 1e5][j]) + 1.0,
        3 => smooth + NOISE[i],
        4 => smooth + 100.0 * NOISE[i],
        5 => smooth + 10_000.0 * NOISE[i],
        _ => smooth,
    }
}

/// The condition number of the correlations of x, …, x⁵ over x = 0..20: what the solve must bear.
pub fn condition_of_wampler() -> f64 {
    let rows: Vec<_> = (0..21).map(|i| powers(f64::from(i))).collect();
    crate::exact::condition(&rows)
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (id, about, xs) in [
        ("StRD-NumAcc1", "10⁷ + 1, 3, 2", vec![10_000_001.0, 10_000_003.0, 10_000_002.0]),
        ("StRD-NumAcc2", "1.2, 1.1, 1.3, …", num_acc("1")),
        ("StRD-NumAcc3", "10⁶ + .2, .1, .3, …", num_acc("1000000")),
        ("StRD-NumAcc4", "10⁷ + .2, .1, .3, …", num_acc("10000000")),
        ("StRD-PiDigits", "the first 5000 digits of π", digits_of_pi(5000)),
        ("StRD-Wampler1", "y of 1 + x + … + x⁵, x = 0 … 20", (0..21).map(|i| wampler(1, i)).collect()),
    ] {
        for precision in Precision::BOTH {
            univariate(&mut cases, precision, id, about, &xs);
        }
    }
    through_the_origin(&mut cases);
    polynomials(&mut cases);
    cases
}

/// Mean and variance.
fn univariate(cases: &mut Vec<Case>, precision: Precision, id: &'static str, about: &'static str, xs: &[f64]) {
    let rounded: Vec<_> = xs.iter().map(|x| precision.rounded(*x)).collect();
    let (mean, variance) = mean_and_variance(&rounded, 1.0);
    for (method, right, digits) in
        [(Method::Plain, mean, precision.of(7.0, 15.0)), (Method::Variance(1.0), variance, precision.of(5.5, 13.5))]
    {
        let ask = Ask::One { method, draws: Draws::of_f(xs), then: None, integral: 1.0 };
        let case = Case::new(id, about, precision, ask, right).digits(digits);
        cases.push(if right == 0.0 { case.exact() } else { case });
    }
}

/// y = βx without an intercept: each draw with its mirror image has the means 0.
fn through_the_origin(cases: &mut Vec<Case>) {
    let no_int = |id, about, xs: &'static [f64], ys: fn(f64) -> f64, right| {
        let draws = Draws::new(2 * xs.len(), move |i| {
            let (x, sign) = (xs[i / 2], if i % 2 == 0 { 1.0 } else { -1.0 });
            Draw { f: sign * ys(x), h: [sign * x, 0.0] }
        });
        let ask = Ask::Two { method: Several::Beta(0), draws, integrals: [1.0, 1.0] };
        Case { naive: Naive::None, ..Case::new(id, about, Double, ask, right).digits(13.5) }
    };
    const NO_INT_1: &[f64] = &[60.0, 61.0, 62.0, 63.0, 64.0, 65.0, 66.0, 67.0, 68.0, 69.0, 70.0];
    // Σxy/Σx².
    cases.push(no_int(
        "StRD-NoInt1",
        "y = βx, x = 60 … 70, y = 130 … 140",
        NO_INT_1,
        |x| x + 70.0,
        96_635.0 / 46_585.0,
    ));
    let ys = |x| if x < 6.0 { x - 1.0 } else { 4.0 };
    cases.push(no_int("StRD-NoInt2", "y = βx, (4, 3), (5, 4), (6, 4)", &[4.0, 5.0, 6.0], ys, 56.0 / 77.0));
}

/// Coefficients of a polynomial: each to the digits that the normal equations of scaled columns allow, an error of
/// κ·u·s_y/s_k, κ the condition of the correlations, u the unit roundoff, s the standard deviations; 1 for s_k of
/// the intercept.
fn polynomials(cases: &mut Vec<Case>) {
    let deviation =
        |of: &dyn Fn(usize) -> f64| libm::sqrt(mean_and_variance(&(0..21).map(of).collect::<Vec<_>>(), 0.0).1);
    let kappa = condition_of_wampler();
    for (set, id, about) in [
        (1, "StRD-Wampler1", "y = 1 + x + … + x⁵: κ = 2.7·10⁶"),
        (2, "StRD-Wampler2", "y = 1 + x/10 + … + x⁵/10⁵: κ = 2.7·10⁶"),
        (3, "StRD-Wampler3", "the same as 1, with noise: κ = 2.7·10⁶"),
        (4, "StRD-Wampler4", "noise a hundred times larger: κ = 2.7·10⁶"),
        (5, "StRD-Wampler5", "noise ten thousand times larger: κ = 2.7·10⁶"),
    ] {
        // Of Wampler2 in units of 10⁻⁵, where it is whole.
        let of_y = deviation(&|i| if set == 2 { libm::round(1e5 * wampler(2, i)) } else { wampler(set, i) });
        let of_y = if set == 2 { of_y / 1e5 } else { of_y };
        for which in 0..6 {
            let right = if set == 2 && which < 5 { [1e-1, 1e-2, 1e-3, 1e-4, 1e-5][which] } else { 1.0 };
            let of_x = if which < 5 { deviation(&|i| powers(i as f64)[which]) } else { 1.0 };
            let error = kappa * f64::EPSILON / 2.0 * of_y / of_x / right;
            let draws = Draws::new(21, move |i| Draw { f: wampler(set, i), h: powers(i as f64) });
            let case = Case::new(id, about, Double, Ask::Five { which, draws }, right);
            cases.push(case.digits(-libm::log10(error)));
        }
    }
}
