use crate::fitted;
use crate::ladder::{self, CORRELATED, INTEGRAL_OF_CORRELATED, run};
use ratiocv_core::{
    ChannelEstimate, Choose, CrossFitted, Dependent, Difference, Flags, Mickey, OptimalDefensive, Regression,
};

const SHRUNK: Regression = Regression { dependent: Dependent::MinimumNorm, shrink: true };
const UNSHRUNK: Regression = Regression { shrink: false, ..SHRUNK };

mod difference {
    use super::*;

    const CROSS_FITTED: CrossFitted<Difference> = CrossFitted(Difference { regression: SHRUNK });

    ladder::ladder! {
        CROSS_FITTED,
        one draw 5.0,
        by hand {
            // Folds (3, 1), (6, 2) and (4, 2), (11, 5), of slopes 3 and 7/3, each for the other:
            // 9/2 + 7/3·5/2 and 15/2 + 3/2. Var: (2/9)/2 and 2/2, each with the weight 1/4.
            let unshrunk = CrossFitted(Difference { regression: UNSHRUNK });
            let (value, std_error) = (29.0 / 3.0, (10.0_f64 / 36.0).sqrt());
            ladder::by_hand(unshrunk, &CORRELATED, INTEGRAL_OF_CORRELATED, value, std_error);
            // Two draws a fold leave nothing to shrink to but 0: ȳ, (9/4 + 49/4)/4.
            ladder::by_hand(CROSS_FITTED, &CORRELATED, INTEGRAL_OF_CORRELATED, 6.0, (29.0_f64 / 8.0).sqrt());
        },
        at 1e9 fitted::cross_fitted_at_1e9
    }

    #[test]
    fn proportional() {
        ladder::proportional(CROSS_FITTED);
    }
}

mod optimal_defensive_mickey {
    use super::*;

    const CROSS_FITTED: CrossFitted<OptimalDefensive<Mickey>> =
        CrossFitted(OptimalDefensive { estimator: Mickey, regression: SHRUNK, floor: 0.01 });

    ladder::ladder! {
        CROSS_FITTED,
        one draw 5.0,
        by hand {
            // Slopes 7/3 and 3 at F̂ = 13/3·… = 28/3·13/14 and 12: a = 14/13 and 1, both clamped to 0.99. In
            // rational arithmetic on x′ = 0.01 + 0.99h/4, each fold leaving one of its two draws out.
            let unshrunk = CrossFitted(OptimalDefensive { estimator: Mickey, regression: UNSHRUNK, floor: 0.01 });
            let (value, variance) = (212_799_189.0 / 20_764_388.0, 1_205_526_661.0 / 45_712_578_025.0_f64);
            ladder::by_hand(unshrunk, &CORRELATED, INTEGRAL_OF_CORRELATED, value, variance.sqrt());
            assert!(run(unshrunk, &CORRELATED, INTEGRAL_OF_CORRELATED).flags.contains(Flags::ALPHA));
        },
        at 1e9 fitted::cross_fitted_at_1e9
    }
}

mod choose {
    use super::*;

    const CROSS_FITTED: CrossFitted<Choose> = CrossFitted(Choose { regression: SHRUNK });

    ladder::ladder! {
        CROSS_FITTED,
        one draw 5.0,
        by hand {
            // Each fold is CORRELATED, f doubled in the odd one. It chooses the ratio there, c = 12/5 and 24/5
            // (see choose.rs), for the other: 6 + 24/5·3/2 = 66/5, 12 + 12/5·3/2 = 78/5. Σ(e − ē)² about c:
            // 38 − 36c + 9c² = 72.56 for f and 152 − 72c + 9c² = 31.04 for 2f, over 3·4, each with 1/4.
            let draws: Vec<_> = CORRELATED.into_iter().flat_map(|(f, h)| [(f, h), (2.0 * f, h)]).collect();
            ladder::by_hand(CROSS_FITTED, &draws, 4.0, 14.4, (103.6_f64 / 48.0).sqrt());
        },
        at 1e9 fitted::cross_fitted_at_1e9
    }

    #[test]
    fn proportional() {
        ladder::proportional(CROSS_FITTED);
    }
}

#[test]
fn below_four_draws_it_is_the_plain_mean_without_an_error() {
    for draws in [&CORRELATED[..2], &CORRELATED[..3]] {
        let ours = run(CrossFitted(Difference::default()), draws, 4.0);
        let mean = draws.iter().map(|d| d.0).sum::<f64>() / draws.len() as f64;
        assert!((ours.value - mean).abs() <= 1e-15 && ours.std_error.is_nan(), "{ours:?}");
        assert!(ours.flags.contains(Flags::ALPHA), "{ours:?}");
    }
}

/// Folds of 3 and 2 draws count by their sizes.
#[test]
fn odd_numbers_of_draws() {
    let draws = [(1.0, 1.0), (2.0, 1.0), (4.0, 2.0), (5.0, 3.0), (7.0, 6.0)];
    // Even: f = 1, 4, 7, h = 1, 2, 6 of slope 15/14; odd: f = 2, 5, h = 1, 3 of slope 3/2.
    let ours = run(CrossFitted(Difference { regression: UNSHRUNK }), &draws, 2.0);
    let (even, odd) = (4.0 + 1.5 * (2.0 - 3.0), 3.5 + 15.0 / 14.0 * 0.0);
    assert!((ours.value - (0.6 * even + 0.4 * odd)).abs() <= 1e-15, "{ours:?}");
    // About 3/2: 18 − 2·15·1.5 + 14·2.25 = 4.5, /2/3; about 15/14: 4.5 − 6·15/14 + 2·(15/14)², /1/2.
    let slope: f64 = 15.0 / 14.0;
    let variance = 0.36 * 4.5 / 6.0 + 0.16 * (4.5 - 6.0 * slope + 2.0 * slope * slope) / 2.0;
    assert!((ours.std_error - variance.sqrt()).abs() <= 1e-14, "{ours:?}");
}

/// A fold that saw nothing of f is 0 ± 0 beside one that did; both together are NO_SUPPORT.
#[test]
fn a_blind_fold() {
    let estimate = |odd: f64| -> ChannelEstimate {
        let f = |i: i32| if i % 2 == 0 { f64::from(i) } else { odd };
        let draws: Vec<_> = (0..8).map(|i| (f(i), 1.0 + f64::from(i))).collect();
        run(CrossFitted(Difference::default()), &draws, 4.0)
    };
    let half = estimate(0.0);
    assert!(half.std_error > 0.0 && !half.flags.contains(Flags::NO_SUPPORT), "{half:?}");
    let black = run(CrossFitted(Difference::default()), &[(0.0, 1.0); 8], 1.0);
    assert!(black.value == 0.0 && black.std_error.is_nan() && black.flags.contains(Flags::NO_SUPPORT), "{black:?}");
}
