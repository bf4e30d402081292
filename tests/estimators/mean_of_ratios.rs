use crate::ladder;
use ratiocv_core::{Flags, MeanOfRatios};

ladder::ladder! {
    MeanOfRatios,
    one draw 7.5,
    by hand {
        // r = 1, 2/3, 2, 9/2: 3·49/24; Σ(r − r̄)² = 9.020833, 3·√(9.020833/3/4).
        ladder::asymmetric(MeanOfRatios, 6.125, 2.601_081);
    },
    at 1e9 |draws, integral| {
        let n = draws.len() as f64;
        let r = |d: &(f64, f64)| d.0 / d.1 - 1.0;
        let mean = draws.iter().map(r).sum::<f64>() / n;
        let error = (draws.iter().map(|d| (r(d) - mean).powi(2)).sum::<f64>() / (n - 1.0) / n).sqrt();
        (integral * (1.0 + mean), integral * error)
    }
}

#[test]
fn proportional() {
    ladder::proportional(MeanOfRatios);
}

/// Found by fuzzing: squares of the ratios, or H², left the range, and no flag said why the error was unknown.
#[test]
fn an_unknown_error_is_flagged() {
    let tiny = ladder::run(MeanOfRatios, &[(1e-200, 1.0), (3e-200, 1.0), (2e-200, 2.0)], 1.0);
    assert!(tiny.std_error.is_nan() && tiny.flags.contains(Flags::UNDERFLOW), "{tiny:?}");
    let huge = ladder::run(MeanOfRatios, &[(1e200, 1.0), (3e200, 1.0), (2e200, 2.0)], 1.0);
    assert!(huge.std_error.is_nan() && huge.flags.contains(Flags::OVERFLOW), "{huge:?}");
    // The square of H is not formed.
    let exact = ladder::run(MeanOfRatios, &[(2.0, 1.0), (4.0, 2.0)], 1e200);
    assert_eq!((exact.value, exact.std_error), (2e200, 0.0));
}
