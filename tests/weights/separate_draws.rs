//! The estimator itself: a sum of independent ratios.

use crate::law::{Law, Parts, two_peaks};
use ratiocv_core::moments::{Accumulate, Comoments, Moments};
use ratiocv_core::{Draw, Estimate, Estimator, Flags, Integrals, RatioOfMeans};
use ratiocv_tests::assert_close;
use ratiocv_tests::enumerate::{Exact, over_groups};
use ratiocv_tests::golden::Point;

/// The law of the draws (u_k/g_k, h_k/g_k) from technique k.
fn technique<const K: usize>(law: &Law<K>, k: usize) -> Vec<Point> {
    let weights = law.pilot().optimal();
    let point = |i: usize| {
        let Draw { f, h } = weights.draw(k, law.f[i], law.h[i], law.g[i]);
        Point { y: f, x: h.to_vec(), p: law.g[i][k], w: vec![] }
    };
    (0..law.f.len()).filter(|i| law.g[*i][k] > 0.0).map(point).collect()
}

/// Bias and MSE of Σ_k H_k·mean(u_k/g_k)/mean(h_k/g_k) for n_k = `size`·counts, exactly.
fn exact<const K: usize>(law: &Law<K>, size: usize) -> (f64, f64) {
    let (mut bias, mut variance) = (0.0, 0.0);
    for k in 0..K {
        let (points, integral) = (technique(law, k), law.h_integral(k));
        let part = points.iter().map(|point| point.p * point.y).sum();
        let Exact { bias: own, mse, .. } = over_groups(&points, 1, size * law.counts[k] as usize, part, |groups| {
            let mut moments = Comoments::<f64>::default();
            for i in groups[0] {
                moments.add(Draw::new(points[*i].y, points[*i].x[0]));
            }
            RatioOfMeans.estimate(&moments, &Integrals::new([integral])).map_or(f64::NAN, |estimate| estimate.value)
        });
        (bias, variance) = (bias + own, variance + mse - own * own);
    }
    (bias, variance + bias * bias)
}

#[test]
fn the_sum_of_ratios_is_consistent_with_the_first_order_variance() {
    for seed in [2, 3] {
        let law = Law::<2>::random(seed, 4);
        let parts: Parts<2> = law.parts(&law.pilot().optimal());
        let first_order = law.variance(&parts);
        let sizes = [2, 4, 8];
        let [(b2, _), (b4, m4), (b8, m8)] = sizes.map(|size| exact(&law, size));
        println!(
            "seed {seed}: bias {b2:.2e} {b4:.2e} {b8:.2e}; N·MSE {:.4e} {:.4e}; first order {first_order:.4e}",
            12.0 * m4,
            24.0 * m8
        );
        // The bias falls like 1/N, and N·MSE approaches the first order like 1/N.
        assert!((b8 / b4 - 0.5).abs() <= 0.1, "seed {seed}");
        let (off4, off8) = (12.0 * m4 / first_order - 1.0, 24.0 * m8 / first_order - 1.0);
        assert!(off8.abs() <= 0.6 * off4.abs() && off8.abs() <= 0.15, "seed {seed}: {off4} {off8}");
    }
}

fn estimate(draws: &[(f64, f64)], integral: f64) -> Estimate<f64> {
    let mut moments = Comoments::<f64>::default();
    draws.iter().for_each(|(f, h)| moments.add(Draw::new(*f, *h)));
    RatioOfMeans.estimate_anyway(&moments, &Integrals::new([integral]))
}

#[test]
fn independent_estimates_add() {
    let (a, b) = (estimate(&[(1.0, 1.0), (2.0, 3.0)], 1.0), estimate(&[(2.0, 2.0), (2.0, 4.0)], 3.0));
    let sum = a.plus_independent(&b);
    assert_eq!(sum.value, a.value + b.value);
    assert_close(sum.std_error.powi(2), a.std_error.powi(2) + b.std_error.powi(2), 1e-15, "quadrature");
    assert_eq!(sum.flags(0), a.flags(0) | b.flags(0));
    let one = sum.plus_independent(&estimate(&[(1.0, 1.0)], 1.0));
    assert!(one.value == sum.value + 1.0 && one.std_error.is_nan() && one.flags(0).contains(Flags::ONE_SAMPLE));
    let none = sum.plus_independent(&estimate(&[], 1.0));
    assert!(none.value.is_nan() && none.flags(0).contains(Flags::EMPTY));
    assert_eq!(sum.flagged(|_| Flags::RANK).flags(0), sum.flags(0) | Flags::RANK);
    assert_eq!(sum.flagged(|_| Flags::RANK).value, sum.value);
}

#[test]
fn e13_a_technique_that_is_never_hit_spoils_no_sum() {
    let good = estimate(&[(1.0, 1.0), (2.0, 3.0)], 1.0);
    // Σh₂ = 0: with w₂f = 0 the term is 0; otherwise the plain mean, and a flag.
    let unhit = good.plus_independent(&estimate(&[(0.0, 0.0), (0.0, 0.0)], 1.0));
    assert!(unhit.value == good.value && unhit.flags(0).contains(Flags::NO_SUPPORT), "{unhit:?}");
    let lost = good.plus_independent(&estimate(&[(1.0, 0.0), (2.0, 0.0)], 1.0));
    assert!(lost.value == good.value + 1.5 && lost.flags(0).contains(Flags::DENOM_ZERO), "{lost:?}");
}

#[test]
fn error_bars_of_the_sum_are_those_of_the_first_order() {
    // The population as a sample: each technique's draws in proportion to its pdf.
    let mut law = two_peaks();
    for (i, f) in law.f.iter_mut().enumerate() {
        *f += 0.002 * (1.0 + (i as f64).sin());
    }
    let per_technique = 20_000.0;
    let estimates = [0, 1].map(|k| {
        let mut moments = Comoments::<f64>::default();
        for point in technique(&law, k) {
            for _ in 0..(point.p * per_technique).round() as usize {
                moments.add(Draw::new(point.y, point.x[0]));
            }
        }
        let count = moments.count() as f64;
        assert!((count / per_technique - 1.0).abs() <= 1e-3, "{count}");
        RatioOfMeans.estimate(&moments, &Integrals::new([law.h_integral(k)])).unwrap()
    });
    let sum = estimates[0].plus_independent(&estimates[1]);
    let right = (law.variance(&law.parts(&law.pilot().optimal())) / (2.0 * per_technique)).sqrt();
    assert_close(sum.std_error, right, 0.01 * right, "error bar");
    assert_close(sum.value, law.f_integral(), 5.0 * right, "value");
}
