//! D: counts, few draws, merges.

use super::both;
use crate::answer::ErrorBar;
use crate::case::Precision::{Double, Single};
use crate::case::{Ask, Case, Precision};
use crate::draws::Draws;
use crate::method::{Method, number};
use crate::noise::noise;
use crate::probe::Probes;
use ratiocv_core::moments::{Comoments, Slices};
use ratiocv_core::{ChannelEstimate, Draw, Error, Flags, Spectrum};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = both(in_each_precision);
    let merged = |id, about, precision, method, draws, then, right| {
        Case::new(id, about, precision, Ask::One { method, draws, then, integral: 1.0 }, right)
    };
    let ones = Draws::new(1 << 10, |_| Draw::new(1.0, 1.0)).doubled(15);
    let d1 = merged("D1", "2²⁵ ones: sums of f32 stick at 2²⁴", Single, Method::Plain, ones, None, 1.0);
    cases.push(d1.exact().naive(mean_of_ones));
    let tenths = Draws::new(10_000_000, |_| Draw::new(0.1, 1.0));
    let right = f64::from(0.1_f32);
    cases.push(merged("D2", "10⁷ times 0.1", Single, Method::Plain, tenths, None, right).exact());
    let uniform = Draws::new(1 << 24, |i| Draw::new(noise(3, i), 1.0));
    let case = merged("D3", "2²⁴ uniform numbers", Single, Method::Variance(1.0), uniform, None, variance_of_uniform());
    cases.push(case.digits(6.0).naive(welford_of_uniform));
    let refused = Ask::Probe(Probes::once("Slices", other_layouts));
    cases.push(Case::new("D13", "merges of other numbers of channels", Double, refused, 0.0).exact());
    cases
}

/// How many merges of moments of other numbers of channels were not refused, or changed something all the same.
fn other_layouts() -> ChannelEstimate {
    let mut wrong = 0;
    for (own, other) in [(3_usize, 4_usize), (4, 3), (1, 9), (8, 16)] {
        let mut pieces = [[Comoments::<Spectrum<f64, 4>>::default(); 4]; 2];
        let [first, second] = &mut pieces;
        let (Ok(mut ours), Ok(mut theirs)) =
            (Slices::new(&mut first[..own.div_ceil(4)], own), Slices::new(&mut second[..other.div_ceil(4)], other))
        else {
            return number(f64::NAN, Flags::NONE);
        };
        wrong += u32::from(ours.add(&[1.0; 16][..own], [&[2.0; 16][..own]]).is_err());
        wrong += u32::from(theirs.add(&[1.0; 16][..other], [&[2.0; 16][..other]]).is_err());
        wrong += u32::from(!matches!(ours.merge(&theirs), Err(Error::LengthMismatch { .. })) || ours.count() != 1);
    }
    number(f64::from(wrong), Flags::NONE)
}

/// Σ1/N with a sum in `f32`.
fn mean_of_ones() -> f64 {
    let sum = (0..1 << 25).fold(0.0_f32, |sum, _| core::hint::black_box(sum + 1.0));
    f64::from(sum) / f64::from(1 << 25)
}

/// The variance of D3's numbers, in `f64` about an exact shift.
fn variance_of_uniform() -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    for i in 0..1 << 24 {
        let d = f64::from(noise(3, i) as f32) - 0.5;
        sum += d;
        squares += d * d;
    }
    let n = f64::from(1 << 24);
    (squares - sum * sum / n) / (n - 1.0)
}

/// Welford (1962), in `f32`.
fn welford_of_uniform() -> f64 {
    let (mut n, mut mean, mut squares) = (0.0_f32, 0.0_f32, 0.0_f32);
    for i in 0..1 << 24 {
        let x = noise(3, i) as f32;
        n += 1.0;
        let off = x - mean;
        mean += off / n;
        squares += off * (x - mean);
    }
    f64::from(squares / (n - 1.0))
}

fn in_each_precision(precision: Precision) -> Vec<Case> {
    let one = |id, about, method, pairs: &[(f64, f64)], integral, right| {
        Case::of_pairs(id, about, precision, (method, pairs, integral), right)
    };
    let merged = |id, about, method, draws, then, right| {
        Case::new(id, about, precision, Ask::One { method, draws, then: Some(then), integral: 1.0 }, right)
    };
    let signs = || Draws::of_f([-1.0, 1.0]).doubled(29);
    let far = || Draws::of_f([1e9]);
    let n = f64::from(1 << 30);
    let about = "2³⁰ draws ±1 and one at 10⁹";
    let mut cases = vec![
        merged("D4", about, Method::Plain, signs(), far(), 1e9 / (n + 1.0)).digits(15.0),
        merged("D4", about, Method::Variance(0.0), signs(), far(), (n + 1e18 * (n / (n + 1.0))) / (n + 1.0))
            .digits(15.0),
    ];
    let half = |low: f64| Draws::of_f([low, low + 2.0]).doubled(32);
    let about = "two parts of 2³³ draws each";
    cases.push(merged("D5", about, Method::Plain, half(0.0), half(1.0), 1.5).exact());
    cases.push(merged("D5", about, Method::Variance(0.0), half(0.0), half(1.0), 1.25).digits(15.0));
    let nothing = || Draws::of_f([]);
    cases.push(merged("D6", "nothing, and then 5", Method::Plain, nothing(), Draws::of_f([5.0]), 5.0).exact());
    let empty = Case::new(
        "D7",
        "no draw",
        precision,
        Ask::One { method: Method::Ratio, draws: nothing(), then: None, integral: 1.0 },
        f64::NAN,
    );
    cases.push(empty.must(Flags::EMPTY).error(ErrorBar::Unknown));
    for method in [Method::Ratio, Method::HartleyRoss, Method::Beale, Method::Mickey, Method::Quenouille] {
        let d8 = one("D8", "one draw", method, &[(3.0, 2.0)], 4.0, 6.0);
        cases.push(d8.exact().must(Flags::ONE_SAMPLE).error(ErrorBar::Unknown));
    }
    for method in [Method::Difference, Method::RegressionRatio] {
        let d9 = one("D9", "two draws, nothing left to fit", method, &[(1.0, 1.0), (3.0, 2.0)], 1.75, 2.0);
        cases.push(d9.exact().must(Flags::ALPHA).error(ErrorBar::Unknown));
    }
    let d9 = one(
        "D9",
        "two draws, fitted without shrinkage",
        Method::FreeRatio,
        &[(1.0, 1.0), (3.0, 2.0)],
        1.75,
        2.520_288_049_380_835,
    );
    cases.push(d9.must(Flags::ALPHA).error(ErrorBar::Unknown));
    // Halves of 2 (draws 0, 2) and 1 (draw 1): 2·7/6 − (2·3/5 + 4)/3 = 0.6.
    let odd = [(1.0, 2.0), (4.0, 1.0), (2.0, 3.0)];
    cases.push(one("D10", "unequal halves weighted by their sizes", Method::Quenouille, &odd, 1.0, 0.6).digits(15.0));
    let lone = Draws::of_f([2.0]);
    let ask = Ask::One { method: Method::Ratio, draws: lone, then: None, integral: 1.0 };
    cases.push(
        Case::new("D11", "the only draw of its accumulator", precision, ask, 2.0).exact().must(Flags::ONE_SAMPLE),
    );
    let singles = |method, right| {
        let draws = Draws::new(1000, |i| Draw::new(1024.0 + (i * 389 % 1000) as f64, 1.0));
        Case::new(
            "D12",
            "singletons merged in a tree",
            precision,
            Ask::One { method, draws, then: None, integral: 1.0 },
            right,
        )
    };
    cases.push(singles(Method::Plain, 1523.5).digits(15.0));
    cases.push(singles(Method::Variance(0.0), 83_333.25).digits(precision.of(6.5, 14.0)));
    let whole = |part: f64| Draws::of_f([part, part]).doubled(31);
    cases.push(merged("D14", "2³² draws and as many again", Method::Plain, whole(1.0), whole(2.0), 1.5).exact());
    if precision == Double {
        let large = Draws::new(1000, |i| Draw::new(1e9 + (i * 389 % 1000) as f64, 1.0));
        let ask = Ask::One { method: Method::Variance(0.0), draws: large, then: None, integral: 1.0 };
        cases.push(Case::new("D12", "the same on 10⁹", precision, ask, 83_333.25).digits(14.0));
    }
    cases
}
