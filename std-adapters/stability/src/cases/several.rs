//! E: two auxiliaries.

use super::both;
use crate::case::Precision::{Double, Single};
use crate::case::{Ask, Case, Precision};
use crate::draws::Draws;
use crate::method::Several;
use crate::noise::noise;
use ratiocv_core::{Draw, Flags};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = both(in_each_precision);
    for (about, epsilon, digits) in [
        ("h₂ = h₁ + 10⁻²z", 1e-2, 9.0),
        ("h₂ = h₁ + 10⁻⁴z", 1e-4, 5.5),
        ("h₂ = h₁ + 10⁻⁶z", 1e-6, 1.5),
        ("h₂ = h₁ + 10⁻⁷z", 1e-7, 6.0),
        ("h₂ = h₁ + 10⁻⁸z", 1e-8, 6.0),
        ("h₂ = h₁ + 10⁻¹²z", 1e-12, 6.0),
    ] {
        let near = || {
            Draws::new(100, move |i| {
                let (h, z) = (noise(10, 2 * i), noise(10, 2 * i + 1) - 0.5);
                Draw { f: h + (h + epsilon * z), h: [h, h + epsilon * z] }
            })
        };
        let rank = if epsilon < 1e-6 { Flags::RANK } else { Flags::NONE };
        let ask = |method| Ask::Two { method, draws: near(), integrals: [0.5, 0.5] };
        cases.push(Case::new("E10", about, Double, ask(Several::Difference), 1.0).digits(8.0).must(rank));
        for which in [0, 1] {
            let beta = Case::new("E10", about, Double, ask(Several::Beta(which)), 1.0);
            cases.push(beta.digits(digits).must(rank));
        }
    }
    // Draws of f32 know 2⁻²⁴ of each other.
    let single = || {
        Draws::new(100, |i| {
            let (h, z) = (noise(10, 2 * i) as f32, noise(10, 2 * i + 1) as f32 - 0.5);
            let other = h + 1e-5 * z;
            Draw { f: f64::from(h + other), h: [f64::from(h), f64::from(other)] }
        })
    };
    let ask = Ask::Two { method: Several::Difference, draws: single(), integrals: [0.5, 0.5] };
    cases.push(Case::new("E10", "h₂ = h₁ + 10⁻⁵z in f32", Single, ask, 1.0).digits(5.0));
    cases
}

fn in_each_precision(precision: Precision) -> Vec<Case> {
    let two = |id, about, method, draws, integrals, right| {
        Case::new(id, about, precision, Ask::Two { method, draws, integrals }, right)
    };
    // f = 1 + 2h, h multiples of ⅛ of mean ¾: exact in both precisions.
    let affine = |times: f64| {
        Draws::new(64, move |i| {
            let h = 0.25 + (i * 5 % 8) as f64 / 8.0;
            Draw { f: 1.0 + 2.0 * h, h: [h, times * h] }
        })
    };
    let digits = precision.of(5.5, 13.5);
    let mut cases = Vec::new();
    for (about, times) in [("the same auxiliary twice", 1.0), ("an auxiliary and its triple", 3.0)] {
        let case = two("E9", about, Several::Difference, affine(times), [1.0, times], 3.0);
        cases.push(case.digits(digits).must(Flags::RANK));
    }
    for which in [0, 1] {
        let case = two("E9", "minimum norm shares β", Several::Beta(which), affine(1.0), [1.0, 1.0], 1.0);
        cases.push(case.digits(digits).must(Flags::RANK));
    }
    // f̄ = 2.375, h̄ = 0.6875.
    let ratio = 2.375 / 0.6875;
    let about = "a mixture of the same auxiliary";
    cases.push(
        two("E9", about, Several::RandomMixture, affine(1.0), [1.0, 1.0], ratio).digits(digits).must(Flags::RANK),
    );
    let gone =
        two("E11", "weights 1 and −1 of the same", Several::Mixture([1.0, -1.0]), affine(1.0), [1.0, 1.0], 2.375);
    cases.push(gone.exact().must(Flags::DENOM_ZERO));
    let cancel = Draws::new(2, |i| {
        let x = 1.0 + i as f64;
        Draw { f: x, h: [x, -x] }
    });
    let case = two("E11", "draws of the mixture cancel", Several::Mixture([1.0, 1.0]), cancel, [1.0, 1.0], 1.5);
    cases.push(case.exact().must(Flags::DENOM_ZERO));
    // f does not know h, and F̂ = 0.
    let zero = || {
        Draws::new(40, |i| Draw {
            f: 1.0 - 2.0 * (i % 2) as f64,
            h: [1.0 + (i / 2 % 5) as f64, 1.0 + (i / 2 % 4) as f64],
        })
    };
    let case = two("E12", "mixture weights where F̂ = 0", Several::RandomMixture, zero(), [3.0, 2.5], 0.0);
    cases.push(case.exact().must(Flags::ALPHA));
    for which in [0, 1] {
        let case = two("E12", "equal weights there", Several::Weight(which), zero(), [3.0, 2.5], 0.5);
        cases.push(case.exact().must(Flags::ALPHA));
    }
    let defended = two("E12", "the optimal defensive there", Several::OptimalDefensive, zero(), [3.0, 2.5], 0.0);
    cases.push(defended.digits(precision.of(5.0, 12.0)));
    cases
}
