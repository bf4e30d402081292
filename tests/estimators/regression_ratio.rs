use crate::fitted;
use crate::ladder::{self, CORRELATED, INTEGRAL_OF_CORRELATED, run};
use ratiocv_core::moments::Comoments;
use ratiocv_core::{Dependent, Estimator, Flags, Integrals, Regression, RegressionRatio};
use ratiocv_tests::samples::filled;

const REGRESSION_RATIO: RegressionRatio = RegressionRatio {
    regression: Regression { dependent: Dependent::MinimumNorm, shrink: true },
    clamp: (-1.0, 2.0),
    undetermined: 0.0,
};

fn unshrunk() -> RegressionRatio {
    RegressionRatio { regression: Regression { shrink: false, ..Regression::default() }, ..REGRESSION_RATIO }
}

ladder::ladder! {
    REGRESSION_RATIO,
    one draw 5.0,
    by hand {
        assert_eq!(REGRESSION_RATIO, RegressionRatio::default());
        // α̂ = 35/18·(5/2)/6: 6·1.6^α̂. Its coefficient α̂ȳ/x̄ is the difference's, and so is its error, but
        // for the distance from the difference 107/12.
        let (value, linear) = (6.0 * 1.6_f64.powf(175.0 / 216.0), 107.0 / 12.0);
        let std_error = (73.0_f64 / 144.0).sqrt().hypot(value - linear);
        ladder::by_hand(REGRESSION_RATIO, &CORRELATED, INTEGRAL_OF_CORRELATED, value, std_error);
        ladder::defended(REGRESSION_RATIO, &CORRELATED, INTEGRAL_OF_CORRELATED);
        let value = 6.0 * 1.6_f64.powf(5.0 / 6.0);
        let std_error = 0.5_f64.sqrt().hypot(value - 9.0);
        ladder::by_hand(unshrunk(), &CORRELATED, INTEGRAL_OF_CORRELATED, value, std_error);
    },
    at 1e9 fitted::difference_at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(REGRESSION_RATIO);
}

#[test]
fn exponents_are_clamped() {
    // β̂ = 2, x̄ = 5/2, ȳ = 6 − 5 = 1: α̂ = 5, clamped to 2: 1·1.6². Its error is that of c = 2·1/2.5.
    let steep = CORRELATED.map(|(f, h)| (f - 5.0, h));
    let clamped = run(unshrunk(), &steep, 4.0);
    assert!((clamped.value - 2.56).abs() <= 1e-15 && clamped.flags.contains(Flags::ALPHA), "{clamped:?}");
    // Σ(e − ē)² = 2 + 9(2 − 0.8)² over 3·4, ×2·3/2; and 2.56 for 1 + 0.8·3/2.
    assert!((clamped.std_error - (14.96_f64 / 12.0 * 3.0).sqrt().hypot(0.36)).abs() <= 1e-14);
    // Falling f: −5 becomes −1, the product estimator.
    let falling = CORRELATED.map(|(f, h)| (7.0 - f, h));
    let clamped = run(unshrunk(), &falling, 4.0);
    assert!((clamped.value - 0.625).abs() <= 1e-15 && clamped.flags.contains(Flags::ALPHA), "{clamped:?}");
    let wide = RegressionRatio { clamp: (f64::NEG_INFINITY, f64::INFINITY), ..unshrunk() };
    let free = run(wide, &steep, 4.0);
    assert!((free.value - 1.6_f64.powi(5)).abs() <= 1e-13 && !free.flags.contains(Flags::ALPHA), "{free:?}");
}

#[test]
fn an_auxiliary_that_is_constant_in_the_draws_gets_the_exponent_for_that() {
    let draws = [(1.0, 2.0), (3.0, 2.0), (5.0, 2.0)];
    assert_eq!(run(REGRESSION_RATIO, &draws, 4.0).value, 3.0);
    let ratio = RegressionRatio { undetermined: 1.0, ..REGRESSION_RATIO };
    assert_eq!(run(ratio, &draws, 4.0).value, 6.0);
}

/// Found by fuzzing: the distance of a power from the difference left the range, and so did the error.
#[test]
fn an_error_out_of_range_is_unknown() {
    let product = |draws: &[(f64, f64)]| {
        let moments = filled(Comoments::<f64>::default(), draws.iter().copied());
        RegressionRatio::default().fixed([-1.0]).estimate_anyway(&moments, &Integrals::new([1e308])).channel(0)
    };
    let one = product(&[(1e7, 1e-10)]);
    assert!(one.value.is_finite() && one.std_error.is_nan(), "{one:?}");
    let three = product(&[(1e7, 1e-10), (2e7, 3e-10), (1e7, 2e-10)]);
    assert!(three.std_error.is_nan() && three.flags.contains(Flags::OVERFLOW), "{three:?}");
}
