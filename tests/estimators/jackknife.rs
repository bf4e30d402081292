use crate::ladder;
use ratiocv_core::{Flags, Jackknife};
use ratiocv_tests::assert_close;

/// Eight groups dealt round robin, in deviations from 1e9: R̂₍₋g₎H − 1e9 = (H − 1e9) + (f − h)·H/x̄, f and h the
/// deviations of the means of all other groups.
fn at_1e9(draws: &[(f64, f64)], integral: f64) -> (f64, f64) {
    let ratio = |kept: &[(f64, f64)]| {
        let (f, h) = ladder::mean_deviations(kept);
        (integral - 1e9) + (f - h) * (integral / (1e9 + h))
    };
    let (n, whole) = (draws.len() as f64, ratio(draws));
    let group = |g: usize| {
        let others: Vec<_> = draws.iter().enumerate().filter(|(i, _)| i % 8 != g).map(|(_, d)| *d).collect();
        (n / (n - others.len() as f64), ratio(&others))
    };
    let value = 8.0 * whole - (0..8).map(group).map(|(share, without)| (1.0 - 1.0 / share) * without).sum::<f64>();
    let square =
        |(share, without): (f64, f64)| (share * whole - (share - 1.0) * without - value).powi(2) / (share - 1.0) / 8.0;
    (1e9 + value, (0..8).map(group).map(square).sum::<f64>().sqrt())
}

ladder::ladder! {
    Jackknife,
    one draw 7.5,
    by hand {
        // Leave-one-out: R̂₍₋g₎ = 15/7, 14/5, 2, 7/6: 3·(4·2 − ¾·Σ) ± √(¾·9·Σ(R̂₍₋g₎ − mean)²).
        ladder::asymmetric(Jackknife, 1611.0 / 280.0, (715_401.0_f64 / 78_400.0).sqrt());
    },
    at 1e9 at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(Jackknife);
}

/// Groups of 2 (the first) and of 1: n_g/N and the variance of Busing, Meijer and van der Leeden.
#[test]
fn groups_of_two_sizes() {
    let draws: [(f64, f64); 9] = [2, 7, 1, 8, 3, 8, 1, 8, 2].map(|f: i32| (f64::from(f), 1.0 + f64::from(f * f % 7)));
    let (f, h) = draws.iter().fold((0.0, 0.0), |(f, h), d| (f + d.0, h + d.1));
    let whole = f / h;
    let without = |g: usize| {
        let own: Vec<_> = draws.iter().enumerate().filter(|(i, _)| i % 8 == g).map(|(_, d)| *d).collect();
        let (own_f, own_h) = own.iter().fold((0.0, 0.0), |(f, h), d| (f + d.0, h + d.1));
        (9.0 / own.len() as f64, (f - own_f) / (h - own_h))
    };
    let value = 8.0 * whole - (0..8).map(without).map(|(share, r)| (1.0 - 1.0 / share) * r).sum::<f64>();
    let variance: f64 = (0..8)
        .map(without)
        .map(|(share, r)| (share * whole - (share - 1.0) * r - value).powi(2) / (share - 1.0) / 8.0)
        .sum();
    let ours = ladder::run(Jackknife, &draws, 1.0);
    assert_close(ours.value, value, 1e-14, "value");
    assert_close(ours.std_error, variance.sqrt(), 1e-14, "standard error");
    // With one auxiliary the first group counts twice: weights of 1 throughout would give another value.
    assert_eq!(without(0).0, 4.5);
}

/// Found by fuzzing: the square of the error left the range, and the error was infinite, without a flag.
#[test]
fn an_error_out_of_range_is_unknown_and_flagged() {
    let ours = ladder::run(Jackknife, &[(1.0, 1.0), (-2.0, 3.0), (3.0, 2.0)], 1e300);
    assert!(ours.value.is_finite() && ours.std_error.is_nan(), "{ours:?}");
    assert!(ours.flags.contains(Flags::OVERFLOW), "{ours:?}");
}

/// Found by fuzzing: one group's pseudovalue is ∞ − ∞, nine times the whole less eight times all but that group.
#[test]
fn pseudovalues_out_of_range_are_flagged() {
    let draws: Vec<_> = (0..9).map(|i| (if i == 3 { 0.0 } else { 1.0 }, 1.0)).collect();
    let ours = ladder::run(Jackknife, &draws, 2.3e307);
    assert!(ours.value.is_finite() && ours.std_error.is_nan(), "{ours:?}");
    assert!(ours.flags.contains(Flags::OVERFLOW), "{ours:?}");
}
