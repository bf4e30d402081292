//! That an answer is judged in all its parts, and that the exact answers are exact.

use ratiocv_core::{ChannelEstimate, Flags};
use ratiocv_stability::exact::{condition, mean_and_variance};
use ratiocv_stability::{ErrorBar, Precision, Right, digits_of};

fn estimate(value: f64, std_error: f64, flags: Flags) -> ChannelEstimate {
    ChannelEstimate { value, std_error, flags }
}

#[test]
fn digits_are_those_of_the_relative_error() {
    assert!((digits_of(1000.1, 1000.0) - 4.0).abs() < 1e-9);
    assert_eq!((digits_of(2.0, 2.0), digits_of(f64::NAN, f64::NAN)), (17.0, 17.0));
    assert_eq!(digits_of(f64::NAN, 1.0), f64::NEG_INFINITY);
    assert_eq!(digits_of(f64::INFINITY, 1.0), f64::NEG_INFINITY);
    assert_eq!(digits_of(1.0, f64::NAN), f64::NEG_INFINITY);
    assert_eq!((digits_of(1e-3, 0.0), digits_of(-0.0, 0.0), digits_of(0.0, 0.0)), (3.0, 16.0, 17.0));
}

#[test]
fn every_part_of_an_answer_is_judged() {
    let near = ErrorBar::Near(0.5);
    let right = Right { std_error: near, must: Flags::DENOM_ZERO, ..Right::new(2.0, Precision::Double) };
    let judged = |value, error, flags| right.judge(estimate(value, error, flags));
    assert_eq!(judged(2.0, 0.5, Flags::DENOM_ZERO), Ok(()));
    assert_eq!(judged(2.0, 0.5, Flags::DENOM_ZERO | Flags::LOW_ESS), Ok(()));
    assert!(judged(2.1, 0.5, Flags::DENOM_ZERO).is_err());
    assert!(judged(f64::NAN, 0.5, Flags::DENOM_ZERO).is_err());
    assert!(judged(2.0, f64::NAN, Flags::DENOM_ZERO).is_err());
    assert!(judged(2.0, 0.6, Flags::DENOM_ZERO).is_err());
    assert!(judged(2.0, 0.5, Flags::NONE).is_err());
    assert!(judged(2.0, 0.5, Flags::DENOM_ZERO | Flags::OVERFLOW).is_err());
    let unknown = Right { std_error: ErrorBar::Unknown, ..Right::new(2.0, Precision::Double) };
    assert!(unknown.judge(estimate(2.0, 0.0, Flags::NONE)).is_err());
    assert_eq!(unknown.judge(estimate(2.0, f64::NAN, Flags::NONE)), Ok(()));
}

#[test]
fn a_flag_may_excuse() {
    let bar = ErrorBar::AtMost(0.0);
    let right = Right { excuse: Flags::OVERFLOW, std_error: bar, ..Right::new(2.0, Precision::Single) };
    assert_eq!(right.judge(estimate(7.0, f64::NAN, Flags::OVERFLOW)), Ok(()));
    assert!(right.judge(estimate(7.0, f64::NAN, Flags::NONE)).is_err());
    assert!(right.judge(estimate(2.0, 0.1, Flags::NONE)).is_err());
    assert_eq!(right.judge(estimate(2.0, 0.0, Flags::NONE)), Ok(()));
}

#[test]
fn exact_answers_of_small_sets_by_hand() {
    assert_eq!(mean_and_variance(&[1.0, 2.0, 4.0], 1.0), (7.0 / 3.0, 7.0 / 3.0));
    assert_eq!(mean_and_variance(&[0.5, 0.25], 0.0), (0.375, 0.015_625));
}

#[test]
fn the_condition_of_two_columns_is_known() {
    // Correlation ½: eigenvalues 1 ± ½.
    assert!((condition(&[[1.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]) - 3.0).abs() <= 1e-14);
    assert!((condition(&[[1.0, 5.0], [2.0, -5.0], [3.0, -5.0], [4.0, 5.0]]) - 1.0).abs() <= 1e-14);
}
