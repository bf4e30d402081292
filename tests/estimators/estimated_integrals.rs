//! Integrals that were estimated themselves (math: N·MSE/F² of a ratio grows by (N/N₂)·C20).

use crate::ladder::{ASYMMETRIC, CORRELATED};
use ratiocv_core::moments::ComomentsState;
use ratiocv_core::moments::{Comoments, HasComoments, Moments};
use ratiocv_core::{
    ChannelEstimate, Difference, EstimatedIntegrals, Estimator, Flags, Integrals, Plain, RatioOfMeans, Regression,
    RegressionRatio, Tin, Uncertain,
};
use ratiocv_tests::assert_close;
use ratiocv_tests::enumerate::{Exact, over_groups};
use ratiocv_tests::golden::{Law, seed};
use ratiocv_tests::population::population;
use ratiocv_tests::samples::filled;

const UNSHRUNK: Regression = Regression { shrink: false, dependent: ratiocv_core::Dependent::MinimumNorm };

fn run<E: Estimator<ComomentsState<f64>>>(estimator: E, draws: &[(f64, f64)], integral: f64) -> ChannelEstimate {
    let moments = filled(Comoments::<f64>::default(), draws.iter().copied());
    estimator.estimate(&moments, &Integrals::new([integral])).expect("draws").channel(0)
}

fn uncertain<E>(estimator: E, std_error: f64) -> EstimatedIntegrals<E, f64> {
    EstimatedIntegrals { estimator, std_errors: [std_error] }
}

/// The ratio is the same and its variance grows by R²·Var(Ĥ); plain does not read Ĥ.
#[test]
fn error_bars_grow_by_the_coefficients_share() {
    let ours = run(uncertain(RatioOfMeans, 0.25), &ASYMMETRIC, 3.0);
    assert_close(ours.value, 6.0, 1e-15, "the ratio");
    // R = 2: 38 − 4 + 8 over 12, and 4/16.
    assert_close(ours.std_error, (42.0 / 12.0 + 0.25_f64).sqrt(), 1e-14, "its error");
    let plain = run(uncertain(Plain, 0.25), &ASYMMETRIC, 3.0);
    assert_close(plain.std_error, (38.0_f64 / 12.0).sqrt(), 1e-14, "plain");
    let fixed = run(uncertain(Difference::default().fixed([-1.5]), 0.25), &ASYMMETRIC, 3.0);
    assert_close(fixed.std_error, ((38.0 + 3.0 + 4.5) / 12.0 + 2.25 / 16.0_f64).sqrt(), 1e-14, "given β");
    for std_error in [0.0, -0.0] {
        let (ours, right) = (run(uncertain(Tin, std_error), &ASYMMETRIC, 3.0), run(Tin, &ASYMMETRIC, 3.0));
        assert_eq!(
            (ours.value.to_bits(), ours.std_error.to_bits()),
            (right.value.to_bits(), right.std_error.to_bits())
        );
    }
}

/// Draws that follow h closely are kept as residuals about their slope: the same error bar, from moments
/// beside which the slope's share of Var(Ĥ) is most of it.
#[test]
fn error_bars_grow_alike_about_a_slope() {
    let draws: Vec<_> = (1..=100).map(|i| (f64::from(2 * i + i % 2) - 0.5, f64::from(i))).collect();
    let right = {
        let (f, h) = draws.iter().fold((0.0, 0.0), |(f, h), draw| (f + draw.0 / 100.0, h + draw.1 / 100.0));
        let ratio = f / h;
        let squares: f64 = draws.iter().map(|(f, h)| (f - ratio * h).powi(2)).sum();
        // Ĥ = h̄: the ratio is f̄, its error that of e = f − R̂h and of R̂Ĥ.
        (squares / 99.0 / 100.0 + (ratio * 0.25).powi(2)).sqrt()
    };
    let ours = run(uncertain(RatioOfMeans, 0.25), &draws, 50.5);
    assert_close(ours.std_error, right, 1e-12, "its error");
    let moments = filled(Comoments::<f64>::default(), draws.iter().copied());
    let slope = moments.channel(0).comoments().slope[0];
    assert!(slope > 1.9, "no slope was taken: {slope}");
}

/// β̂ = s_xy/(s_xx + N·Var(Ĥ)): for Var(Ĥ) = s_xx/N₂ that is 1/(1 + N/N₂) of what it was.
#[test]
fn fitted_coefficients_shrink() {
    // s_xx = 3, s_xy = 6, N = 4; N₂ = 12: β̂ = 2·3/4, Var(Ĥ) = 1/4. ȳ + β̂·3/2.
    let difference = Difference { regression: UNSHRUNK };
    let ours = run(uncertain(difference, 0.5), &CORRELATED, 4.0);
    assert_close(ours.value, 6.0 + 1.5 * 1.5, 1e-14, "β̂ = 3/2");
    // Σ(e − ē)² = 38 − 2·1.5·18 + 1.5²·12, ×(1 + 4·(3/2)²/12)·3/2.
    assert_close(ours.std_error, (11.0 / 12.0 * 1.75 * 1.5_f64).sqrt(), 1e-14, "its error");
    let ratio = RegressionRatio { regression: UNSHRUNK, ..RegressionRatio::default() };
    let ours = run(uncertain(ratio, 0.5), &CORRELATED, 4.0);
    assert_close(ours.value, 6.0 * 1.6_f64.powf(0.625), 1e-14, "α̂ = 3/2·(5/2)/6");
}

#[test]
fn a_mean_that_is_off_may_be_the_integrals_fault() {
    let draws: Vec<_> = (0..400).map(|i| f64::from(i % 5)).map(|h| (h + 1.0, h)).collect();
    assert!(run(RatioOfMeans, &draws, 3.0).flags.contains(Flags::AUX_MISMATCH));
    assert!(!run(uncertain(RatioOfMeans, 0.5), &draws, 3.0).flags.contains(Flags::AUX_MISMATCH));
}

/// Each channel has the error of its own integral, or all have one.
#[test]
fn a_lane_per_channel() {
    use ratiocv_core::moments::Accumulate;
    use ratiocv_core::{Draw, Spectrum};
    let mut moments = Comoments::<Spectrum<f64, 2>>::default();
    ASYMMETRIC.iter().for_each(|(f, h)| moments.add(Draw::new(Spectrum([*f, *f]), Spectrum([*h, *h]))));
    let integrals = Integrals::new([Spectrum([3.0, 3.0])]);
    let own = EstimatedIntegrals { estimator: RatioOfMeans, std_errors: [Spectrum([0.0, 0.25])] };
    let own = own.estimate(&moments, &integrals).expect("draws").std_error;
    assert_close(own[0], 3.5_f64.sqrt(), 1e-14, "the known one");
    assert_close(own[1], 3.75_f64.sqrt(), 1e-14, "the estimated one");
    let all = EstimatedIntegrals { estimator: RatioOfMeans, std_errors: [0.25] };
    assert_eq!(all.estimate(&moments, &integrals).expect("draws").std_error[0], own[1]);
}

/// Ĥ = H(1 ± √(C20/N₂)), each with probability ½, by exact enumeration.
fn noisy<E>(estimator: &E, law: &Law, n: usize, draws_of_h: f64) -> Exact
where
    E: for<'a> Estimator<Uncertain<'a, ComomentsState<f64>>> + Copy,
{
    let (h, c20) = (law.h.first(), population(&law.support, 0.0).c20);
    let std_error = h * (c20 / draws_of_h).sqrt();
    let halves = [-std_error, std_error].map(|off| {
        over_groups(&law.support, 1, n, law.f, |groups| {
            let draws: Vec<_> = groups[0].iter().map(|i| (law.support[*i].y, law.support[*i].x[0])).collect();
            run(uncertain(*estimator, std_error), &draws, h + off).value
        })
    });
    let mean = |of: fn(&Exact) -> f64| (of(&halves[0]) + of(&halves[1])) / 2.0;
    Exact { expectation: mean(|e| e.expectation), bias: mean(|e| e.bias), mse: mean(|e| e.mse) }
}

#[test]
fn the_error_grows_by_that_of_the_integrals() {
    for law in &seed().distributions {
        let known = population(&law.support, 0.0);
        let (n, draws_of_h) = (8.0, 24.0);
        let grown = |exact: Exact, before: Exact| n * (exact.mse - before.mse) / law.f / law.f;
        // A given β: exactly β²Var(Ĥ), and C11/(C20(1 + N/N₂)) is the best.
        let best = known.f_c11 / known.c20 / (1.0 + n / draws_of_h) / known.h;
        let mse = |beta: f64| noisy(&Difference::default().fixed([beta]), law, 8, draws_of_h).mse;
        let right = |beta: f64| {
            let c = beta * known.h;
            (known.ff_c02 - 2.0 * c * known.f_c11 + c * c * known.c20 * (1.0 + n / draws_of_h)) / n
        };
        for beta in [0.0, best, 0.9 * best, 1.1 * best] {
            assert_close(mse(beta), right(beta), 1e-12 * right(beta), &format!("{}, β = {beta}", law.name));
        }
        assert!(mse(best) <= mse(0.9 * best) && mse(best) <= mse(1.1 * best), "{}", law.name);
        // The ratio: (N/N₂)·C20·E[F̂²]/F², E[F̂²] with the known integral; C20/N₂·N to first order.
        let before = over_groups(&law.support, 1, 8, law.f, |groups| {
            let draws: Vec<_> = groups[0].iter().map(|i| (law.support[*i].y, law.support[*i].x[0])).collect();
            run(RatioOfMeans, &draws, known.h).value
        });
        let square = before.mse + 2.0 * law.f * before.bias + law.f * law.f;
        let right = n / draws_of_h * known.c20 * square / law.f / law.f;
        let ours = grown(noisy(&RatioOfMeans, law, 8, draws_of_h), before);
        assert_close(ours, right, 1e-11 * right, &format!("{}, the ratio", law.name));
    }
}
