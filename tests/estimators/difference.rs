use crate::fitted;
use crate::ladder::{self, ASYMMETRIC, CORRELATED, INTEGRAL, INTEGRAL_OF_CORRELATED, run};
use ratiocv_core::{Dependent, Difference, Flags, Regression};

const DIFFERENCE: Difference =
    Difference { regression: Regression { dependent: Dependent::MinimumNorm, shrink: true } };
const UNSHRUNK: Difference = Difference { regression: Regression { dependent: Dependent::MinimumNorm, shrink: false } };

ladder::ladder! {
    DIFFERENCE,
    one draw 5.0,
    by hand {
        // β̂ = 35/18: 6 + 35/18·3/2. Σ(e − ē)² = 2 + 9/18²; ×(1 + 4·(3/2)²/9) for the distance of x̄ from H
        // and ×3/2 for the degree of freedom: √(73/36/3/4·2·3/2).
        let (value, std_error) = (107.0 / 12.0, (73.0_f64 / 144.0).sqrt());
        ladder::by_hand(DIFFERENCE, &CORRELATED, INTEGRAL_OF_CORRELATED, value, std_error);
        ladder::defended(DIFFERENCE, &CORRELATED, INTEGRAL_OF_CORRELATED);
        // Unshrunk, β̂ = 2: s²(1/N + d²/S) = 1·(1/4 + 9/4/9).
        ladder::by_hand(UNSHRUNK, &CORRELATED, INTEGRAL_OF_CORRELATED, 9.0, 0.5_f64.sqrt());
        // β̂ = 1/2 explains 1/2 of 38, less than noise would: shrunk to 0. The freedom is spent all the same:
        // √(38/3/4·3·3/2). Unshrunk s² = 75/4: 75/4·(1/4 + 1/2).
        ladder::by_hand(DIFFERENCE, &ASYMMETRIC, INTEGRAL, 4.0, 14.25_f64.sqrt());
        ladder::by_hand(UNSHRUNK, &ASYMMETRIC, INTEGRAL, 4.5, 3.75);
    },
    at 1e9 fitted::difference_at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(DIFFERENCE);
}

#[test]
fn two_draws_leave_nothing_to_fit() {
    let two = run(DIFFERENCE, &[(1.0, 1.0), (3.0, 2.0)], 4.0);
    assert!(two.value == 2.0 && two.std_error.is_nan() && two.flags.contains(Flags::ALPHA), "{two:?}");
    let unshrunk = run(UNSHRUNK, &[(1.0, 1.0), (3.0, 2.0)], 4.0);
    assert!(unshrunk.value == 7.0 && unshrunk.std_error.is_nan() && unshrunk.flags.contains(Flags::ALPHA));
}

#[test]
fn a_mean_of_h_near_zero_does_no_harm() {
    // h̄ = 0 with a slope of 2: ȳ + β̂·H, and nothing to remark on.
    let draws: Vec<_> = (0..200).map(|i| f64::from(i % 5 - 2)).map(|h| (1.0 + 2.0 * h, h)).collect();
    let centred = run(DIFFERENCE, &draws, 0.01);
    assert!((centred.value - 1.02).abs() <= 1e-15 && centred.flags == Flags::NONE, "{centred:?}");
}
