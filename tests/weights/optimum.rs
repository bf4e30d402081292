//! The optimum, against everything else, with all integrals by enumeration.

use crate::law::{Law, Parts, two_peaks};
use ratiocv_core::weights::{OptimalWeights, PowerHeuristic};
use ratiocv_tests::samples::Noise;

/// Parts that add up to 0 at each point, and vanish where a technique does not reach.
fn direction<const K: usize>(law: &Law<K>, noise: &mut Noise) -> Parts<K> {
    let at = |i: usize| {
        let raw = core::array::from_fn::<_, K, _>(|k| (noise.next_unit() - 0.5) * f64::from(law.g[i][k] > 0.0));
        let mean = raw.iter().sum::<f64>() / law.g[i].iter().filter(|g| **g > 0.0).count() as f64;
        core::array::from_fn(|k| if law.g[i][k] > 0.0 { raw[k] - mean } else { 0.0 })
    };
    (0..law.f.len()).map(at).collect()
}

fn sum<const K: usize>(a: &[[f64; K]], b: &[[f64; K]], scale: f64) -> Parts<K> {
    a.iter().zip(b).map(|(a, b)| core::array::from_fn(|k| a[k] + scale * b[k])).collect()
}

/// Variances of the optimum and of the balance heuristics on h and on g, after checking that nothing
/// is better than the optimum.
fn check<const K: usize>(law: &Law<K>, seed: u64) -> [f64; 3] {
    let weights = law.pilot().optimal();
    let parts = law.parts(&weights);
    law.assert_complete(&parts);
    let best = law.variance(&parts);
    // Rounding of the system, of sums over the law and of parts that are larger than f.
    let no_better = |parts: &[[f64; K]], what: &str| {
        let other = law.variance(parts);
        assert!(best <= other * (1.0 + 1e-10), "{what}, seed {seed}: {other:e} beats {best:e}");
        other
    };
    let on_g = no_better(&law.heuristic(PowerHeuristic::BALANCE, law.counts, &law.g), "balance on g");
    let on_h = no_better(&law.heuristic(PowerHeuristic::BALANCE, [1.0; K], &law.h), "balance on h");
    no_better(&law.heuristic(PowerHeuristic::SQUARE, law.counts, &law.g), "power on g");

    let (mut noise, scale) = (Noise(seed), law.f_integral().abs());
    let residuals = law.residuals(&parts);
    for _ in 0..200 {
        // Other weight functions: no slope in any direction, so a minimum, since the problem is convex.
        let other = direction(law, &mut noise);
        let slope = law.product(&residuals, &law.residuals(&other));
        let size = (law.product(&residuals, &residuals) * law.product(&other, &other)).sqrt().max(1e-3 * scale);
        assert!(slope.abs() <= 1e-11 * size, "seed {seed}: slope {slope:e} of {size:e}");
        no_better(&sum(&parts, &other, 0.01 * scale), "another function");
        // Other constants.
        let nudge = |x: f64, u: f64| x + scale * 0.02 * (u - 0.5);
        let slopes = weights.slopes().map(|a| nudge(a, noise.next_unit()));
        let constants = weights.constants().map(|c| nudge(c, noise.next_unit()));
        let other = law.parts(&OptimalWeights::new(law.counts, slopes, constants).unwrap());
        law.assert_complete(&other);
        no_better(&other, "other constants");
    }
    [best, on_h, on_g]
}

#[test]
fn nothing_is_better_than_the_optimum() {
    for seed in 0..25 {
        check(&Law::<2>::random(seed, 8), seed);
        check(&Law::<3>::random(seed, 12), seed);
    }
}

#[test]
fn the_gain_over_heuristics_can_be_large() {
    // With a floor under f that the auxiliaries do not have; without it the optimum is exact.
    let mut law = two_peaks();
    let exact = law.variance(&law.parts(&law.pilot().optimal()));
    assert!(exact <= 1e-20, "{exact:e}");
    for (i, f) in law.f.iter_mut().enumerate() {
        *f += 0.002 * (1.0 + (i as f64).sin());
    }
    let [best, on_h, on_g] = check(&law, 1);
    println!("N·variance: optimum {best:.3e}, balance on h {on_h:.3e}, on g {on_g:.3e}");
    assert!(best <= on_h / 20.0 && best <= on_g / 20.0);
}
