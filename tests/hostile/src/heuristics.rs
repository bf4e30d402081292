//! Weights of any pdfs.

use crate::bytes::{Bytes, Reach};
use crate::truth::epsilon;
use ratiocv_core::weights::{OptimalWeights, PowerHeuristic, check_sum};
use ratiocv_core::{Flags, Lanes, PerLane, Scalar};

/// Weights of the balance and power heuristics sum to 1 and none is NaN or negative, for any pdfs and counts, but where
/// no technique reaches the point (all 0) or a count or pdf is not one (all NaN); the parts of f by any constants add
/// up to f.
pub fn heuristics(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    match bytes.byte() % 6 {
        0 => of::<f32, 1>(&mut bytes),
        1 => of::<f32, 2>(&mut bytes),
        2 => of::<f64, 2>(&mut bytes),
        3 => of::<f32, 3>(&mut bytes),
        4 => of::<f64, 4>(&mut bytes),
        _ => parts(&mut bytes),
    }
}

fn of<S: Scalar, const K: usize>(bytes: &mut Bytes<'_>) {
    let heuristic = match bytes.byte() % 4 {
        0 => PowerHeuristic::BALANCE,
        1 => PowerHeuristic::SQUARE,
        _ => {
            let exponent = bytes.number::<f64>(Reach::Any);
            let made = PowerHeuristic::new(exponent);
            assert_eq!(made.is_ok(), exponent > 0.0 && exponent.is_finite(), "exponent {exponent}");
            made.unwrap_or(PowerHeuristic::BALANCE)
        }
    };
    // Of one sign in most cases.
    let signed = bytes.byte() & 7 == 0;
    let number = |bytes: &mut Bytes<'_>| {
        let x = bytes.number::<S>(Reach::Any);
        if signed { x } else { x.abs() }
    };
    let counts: [f64; K] = core::array::from_fn(|_| number(bytes));
    let pdfs: [f64; K] = core::array::from_fn(|_| number(bytes));
    let weights = heuristic.weights(&counts, &pdfs.map(S::from_f64)).map(Lanes::widen);
    let about = format!("{heuristic:?} of counts {counts:?} and pdfs {pdfs:?}: {weights:?}");
    if !counts.iter().all(|n| *n >= 0.0 && n.is_finite()) || !pdfs.iter().all(|g| *g >= 0.0) {
        assert!(weights.iter().all(|w| w.is_nan()), "{about}");
        return;
    }
    let sum: f64 = weights.iter().sum();
    if counts.iter().zip(&pdfs).all(|(n, g)| *n == 0.0 || *g == 0.0) {
        assert!(weights.iter().all(|w| *w == 0.0), "nothing reaches the point: {about}");
        return;
    }
    assert!(weights.iter().all(|w| (0.0..=1.0).contains(w)), "{about}");
    assert!((sum - 1.0).abs() <= 2.0 * K as f64 * epsilon::<S>(), "Σw = {sum}: {about}");
    assert_eq!(check_sum(&weights.map(S::from_f64), S::ONE).get(0), Flags::NONE, "{about}");
    let is_delta = |k: usize| pdfs[k].is_infinite() && counts[k] > 0.0;
    for k in 0..K {
        assert!(counts[k] > 0.0 && pdfs[k] > 0.0 || weights[k] == 0.0, "technique {k} cannot have been used: {about}");
        assert!(is_delta(k) || weights[k] == 0.0 || !(0..K).any(is_delta), "a delta takes all: {about}");
        for j in 0..K {
            if counts[j] == counts[k] && pdfs[j] >= pdfs[k] {
                assert!(weights[j] >= weights[k], "the likelier one weighs less: {about}");
            }
            // By the definition, where nothing can leave the range.
            let plain = [counts[j], counts[k], pdfs[j], pdfs[k]].iter().all(|x| (1e-3..1e3).contains(x));
            if plain && heuristic == PowerHeuristic::SQUARE && weights[k] > 1e-30 {
                let right =
                    (counts[j] * pdfs[j]) * (counts[j] * pdfs[j]) / ((counts[k] * pdfs[k]) * (counts[k] * pdfs[k]));
                let off = (weights[j] / weights[k] / right - 1.0).abs();
                assert!(off <= 8.0 * epsilon::<S>(), "w_{j}/w_{k} should be {right}: {about}");
            }
        }
    }
}

fn parts(bytes: &mut Bytes<'_>) {
    let mut numbers = || core::array::from_fn(|_| bytes.number::<f64>(Reach::Moderate));
    let [counts, pdfs]: [[f64; 3]; 2] = [numbers(), numbers()].map(|all| all.map(f64::abs));
    let [slopes, constants, h]: [[f64; 3]; 3] = [numbers(), numbers(), numbers()];
    let [f, _, _]: [f64; 3] = numbers();
    let Ok(weights) = OptimalWeights::<f64, 3>::new(counts, slopes, constants) else {
        assert!(counts.iter().all(|n| *n == 0.0), "counts {counts:?}");
        return;
    };
    let parts = weights.parts(f, h, pdfs);
    if counts.iter().zip(&pdfs).all(|(n, g)| *n == 0.0 || *g == 0.0) {
        assert_eq!(parts, [0.0; 3], "nothing reaches the point");
        return;
    }
    let dot = |a: &[f64; 3], b: &[f64; 3]| -> f64 { a.iter().zip(b).map(|(a, b)| (a * b).abs()).sum() };
    let size = f.abs() + dot(&slopes, &h) + dot(&pdfs, &constants);
    let off = (parts.iter().sum::<f64>() - f).abs();
    assert!(off <= 32.0 * f64::EPSILON * size, "parts {parts:?} of {f}: off by {off:e}");
}
