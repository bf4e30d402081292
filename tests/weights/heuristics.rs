//! Balance and power heuristic, and the check of other weights.

use ratiocv_core::weights::{PowerHeuristic, check_sum};
use ratiocv_core::{Error, Flags, PerLane, Spectrum};
use ratiocv_tests::assert_close;

const BALANCE: PowerHeuristic = PowerHeuristic::BALANCE;
const SQUARE: PowerHeuristic = PowerHeuristic::SQUARE;

#[test]
fn weights_are_what_they_say_by_hand() {
    // n·g = 2, 3, 5 and squares 4, 9, 25; cubes 8, 27, 125.
    let (counts, pdfs) = ([1.0, 6.0, 2.0], [2.0, 0.5, 2.5]);
    for (heuristic, right) in [
        (BALANCE, [0.2, 0.3, 0.5]),
        (SQUARE, [4.0 / 38.0, 9.0 / 38.0, 25.0 / 38.0]),
        (PowerHeuristic::new(3.0).unwrap(), [0.05, 27.0 / 160.0, 125.0 / 160.0]),
    ] {
        for (ours, right) in heuristic.weights(&counts, &pdfs).into_iter().zip(right) {
            assert_close(ours, right, 4.0 * f64::EPSILON, "weight");
        }
    }
    assert_eq!(PowerHeuristic::new(1.0), Ok(BALANCE));
    assert_eq!(PowerHeuristic::new(2.0), Ok(SQUARE));
}

#[test]
fn they_are_the_ratio_form() {
    let (counts, pdfs) = ([3.0, 1.0, 7.0], [0.4, 2.5, 0.01]);
    for exponent in [0.5, 1.0, 1.7, 2.0, 4.0] {
        let ours = PowerHeuristic::new(exponent).unwrap().weights(&counts, &pdfs);
        for k in 0..3 {
            let ratio = |j: usize| (counts[j] * pdfs[j] / (counts[k] * pdfs[k])).powf(exponent);
            let others: f64 = (0..3).filter(|j| *j != k).map(ratio).sum();
            assert_close(ours[k], 1.0 / (1.0 + others), 1e-14, "1/(1 + Σ…)");
        }
    }
}

#[test]
fn e15_no_size_of_pdf_leaves_the_range() {
    for heuristic in [BALANCE, SQUARE, PowerHeuristic::new(7.5).unwrap()] {
        for pdf in [3e38_f32, 1e20, 1e-25, 1e30, 1e-30, 1e-45] {
            assert_eq!(heuristic.weights(&[1.0, 1.0], &[pdf; 2]), [0.5; 2], "{pdf:e}");
        }
        for pdf in [f64::MAX, 1e300, 1e-300, 5e-324] {
            assert_eq!(heuristic.weights(&[1.0, 1.0], &[pdf; 2]), [0.5; 2], "{pdf:e}");
            assert_eq!(heuristic.weights(&[1e6, 1e6], &[pdf; 2]), [0.5; 2], "{pdf:e}");
        }
        assert_eq!(heuristic.weights(&[1.0, 1.0], &[1e-300, 1e300]), [0.0, 1.0]);
        assert_eq!(heuristic.weights(&[1.0, 1.0], &[f64::INFINITY, 1e300]), [1.0, 0.0]);
        assert_eq!(heuristic.weights(&[5.0, 1.0, 1.0], &[1.0, f64::INFINITY, f64::INFINITY]), [0.0, 0.5, 0.5]);
    }
    assert_eq!(BALANCE.weights(&[1.0, 3.0], &[f64::INFINITY; 2]), [0.25, 0.75]);
    // The delta of a technique without draws is not there.
    assert_eq!(BALANCE.weights(&[0.0, 3.0], &[f64::INFINITY, 1.0]), [0.0, 1.0]);
}

/// Found by fuzzing: n_k·g_k, or its power, left the range though every weight is an ordinary number.
#[test]
fn no_size_of_counts_leaves_the_range() {
    for heuristic in [BALANCE, SQUARE, PowerHeuristic::new(1e13).unwrap()] {
        for count in [1e-300, 1e-170, 1e170, 1e300] {
            assert_eq!(heuristic.weights(&[count; 2], &[3.0_f64; 2]), [0.5; 2], "{count:e}");
            assert_eq!(heuristic.weights(&[count; 2], &[f64::INFINITY; 2]), [0.5; 2], "{count:e}");
            // A large count makes up for a small pdf.
            assert_eq!(heuristic.weights(&[1e-300, 1e300], &[1e300, 1e-300_f64]), [0.5; 2]);
        }
        // The delta of a technique without draws is not there, whatever the others are.
        assert_eq!(heuristic.weights(&[1e300, 0.0], &[f64::MAX, f64::INFINITY]), [1.0, 0.0]);
        assert!(heuristic.weights(&[f64::INFINITY, 1.0], &[1.0_f64; 2]).iter().all(|w| w.is_nan()));
    }
    // Squares of 1e-155 are denormal: three digits would be left.
    let [small, large, _] = SQUARE.weights(&[1.0, 1.0, 1e-308], &[0.875, 14.0, 1e154]);
    assert_close(large / small, 256.0, 1e-12, "ratio of weights");
    let [a, b] = SQUARE.weights(&[1e200, 2e200], &[1.0_f64; 2]);
    assert_close(a, 0.2, 1e-15, "weight");
    assert_close(b, 0.8, 1e-15, "weight");
}

/// In units of a pdf that hardly draws, what others are squared to is denormal: found by fuzzing.
#[test]
fn a_pdf_without_draws_costs_the_others_no_digit() {
    let (counts, pdfs) = ([0.5, 14.0, 1.0 / 6.0, 2.3e-308], [1.0 / 6.0, 1e7, 1.0 / 18.0, 1.34e154]);
    let weights = SQUARE.weights(&counts, &pdfs);
    assert_close(weights[1], 1.0, 4.0 * f64::EPSILON, "the greatest");
    for k in [0, 2] {
        let product = counts[k] * pdfs[k] / 1.4e8;
        assert_close(weights[k] / (product * product), 1.0, 8.0 * f64::EPSILON, "a small one");
    }
}

#[test]
fn e14_zero_pdfs_have_zero_weights() {
    for heuristic in [BALANCE, SQUARE] {
        assert_eq!(heuristic.weights(&[1.0, 2.0], &[0.0, 0.0]), [0.0, 0.0]);
        assert_eq!(heuristic.weights(&[1.0, 2.0], &[0.0, 1e-40]), [0.0, 1.0]);
        assert_eq!(heuristic.weights(&[0.0, 2.0], &[5.0, 1e-40]), [0.0, 1.0]);
        assert!(heuristic.weights::<f64, 0>(&[], &[]).is_empty());
    }
    // Then f must be 0, or energy is lost.
    let none = BALANCE.weights(&[1.0, 2.0], &[0.0, -0.0_f64]);
    assert_eq!(check_sum(&none, 0.0).get(0), Flags::NONE);
    assert_eq!(check_sum(&none, 1e-300).get(0), Flags::WEIGHTS);
}

#[test]
fn bad_pdfs_and_counts_are_not_silent_and_concern_their_channel() {
    for bad in [f64::NAN, -1.0] {
        let [a, b] = BALANCE.weights(&[1.0, 1.0], &[Spectrum([bad, 1.0]), Spectrum([1.0, 3.0])]);
        assert!(a[0].is_nan() && b[0].is_nan());
        assert_eq!((a[1], b[1]), (0.25, 0.75));
        assert!(BALANCE.weights(&[bad, 1.0], &[1.0_f64, 1.0]).iter().all(|w| w.is_nan()));
    }
    for bad in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let error = PowerHeuristic::new(bad).unwrap_err();
        assert!(matches!(error, Error::Exponent(_)) && error.to_string().contains("balance"), "{error}");
    }
}

#[test]
fn weights_of_any_pdfs_pass_the_check() {
    let mut noise = ratiocv_tests::samples::Noise(5);
    for _ in 0..1000 {
        let pdfs = [0; 5].map(|_| (200.0 * noise.next_unit() - 100.0).exp2() as f32);
        for heuristic in [BALANCE, SQUARE, PowerHeuristic::new(0.7).unwrap()] {
            let weights = heuristic.weights(&[1.0, 2.0, 3.0, 0.5, 1.0], &pdfs);
            assert_eq!(check_sum(&weights, 1.0).get(0), Flags::NONE, "{pdfs:?} {weights:?}");
        }
    }
}

#[test]
fn e16_weights_that_do_not_sum_to_one_are_flagged() {
    for (weights, flags) in [
        ([0.5, 0.4], Flags::WEIGHTS),
        ([0.5, 0.501], Flags::WEIGHTS),
        ([0.5, 0.5 + 16.0 * f64::EPSILON], Flags::WEIGHTS),
        ([0.5, 0.5 + 7.0 * f64::EPSILON], Flags::NONE), // 8·2 units of ε/2
        ([1e6, 1.0 - 1e6], Flags::NONE),
        ([-0.25, 1.25], Flags::NONE),
        ([-0.5, -0.5], Flags::WEIGHTS),
        ([f64::NAN, 0.5], Flags::WEIGHTS),
        ([f64::INFINITY, f64::NEG_INFINITY], Flags::WEIGHTS),
    ] {
        assert_eq!(check_sum::<f64, 2>(&weights, 2.0).get(0), flags, "{weights:?}");
        assert_eq!(check_sum::<f64, 2>(&weights, -0.0).get(0), Flags::NONE, "{weights:?}");
    }
    let flags = check_sum(&[Spectrum([0.3_f32, 0.3]), Spectrum([0.7, f32::NAN])], Spectrum([1.0, 1.0]));
    assert_eq!((flags.get(0), flags.get(1)), (Flags::NONE, Flags::WEIGHTS));
}
