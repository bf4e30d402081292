//! The constants: their equations, what the pilot makes of bad or few points, and singular systems.

use crate::law::{Law, two_peaks};
use ratiocv_core::moments::Merge;
use ratiocv_core::weights::{OptimalWeights, Pilot, PowerHeuristic};
use ratiocv_core::{Error, Flags, Spectrum};
use ratiocv_tests::assert_close;
use ratiocv_tests::samples::Noise;

/// Parts that agree but for rounding, each of size 1 or less.
#[track_caller]
fn assert_same<const K: usize>(ours: &[[f64; K]], right: &[[f64; K]]) {
    assert_eq!(ours.len(), right.len());
    for (ours, right) in ours.as_flattened().iter().zip(right.as_flattened()) {
        assert_close(*ours, *right, 1e-14, "a part");
    }
}

#[test]
fn slopes_are_the_ratios_of_the_parts_and_constants_their_residuals() {
    for seed in 0..10 {
        let law = Law::<3>::random(seed, 9);
        let weights = law.pilot().optimal();
        assert_eq!(weights.flags(0), Flags::NONE);
        let parts = law.parts(&weights);
        let residuals = law.residuals(&parts);
        let scale = law.f_integral().abs();
        for (k, ours) in weights.slopes().into_iter().enumerate() {
            let slope = law.integral(|i| parts[i][k]) / law.h_integral(k);
            assert_close(ours, slope, 1e-12 * scale, "a = F_k/H_k");
        }
        // Stationary: d_k/(ν_k g_k) − c_k is one function, the same for all techniques.
        let multiplier = |i: usize, k: usize| residuals[i][k] / law.share(k) / law.g[i][k] - weights.constants()[k];
        for i in 1..law.f.len() {
            for k in 1..3 {
                assert_close(multiplier(i, k), multiplier(i, 0), 1e-10 * scale, "the multiplier");
            }
        }
        // A common constant changes nothing.
        let shifted = weights.constants().map(|c| c + 0.7);
        let shifted = law.parts(&OptimalWeights::new(law.counts, weights.slopes(), shifted).unwrap());
        assert_same(&shifted, &parts);
    }
}

#[test]
fn one_technique_takes_all() {
    let law = Law::<1> { counts: [7.0], f: vec![1.0, 5.0], h: vec![[0.5], [1.0]], g: vec![[0.25], [0.75]] };
    let weights = law.pilot().optimal();
    assert_close(weights.slopes()[0], 4.0, 1e-14, "F/H");
    for (parts, f) in law.parts(&weights).iter().zip(&law.f) {
        assert_close(parts[0], *f, 1e-14, "u = f");
    }
    assert_eq!(weights.draw(0, 5.0, [1.0], [0.75]).h, [1.0 / 0.75]);
}

#[test]
fn constants_of_zero_are_the_balance_heuristic() {
    let law = Law::<3>::random(4, 9);
    let parts = law.parts(&OptimalWeights::new(law.counts, [0.0; 3], [0.0; 3]).unwrap());
    let balance = law.heuristic(PowerHeuristic::BALANCE, law.counts, &law.g);
    assert_same(&parts, &balance);
    // So is what an empty pilot says, or one that only saw points that no technique reaches.
    let mut empty = Pilot::<f64, 3>::new(law.counts).unwrap();
    empty.add(1.0, [1.0; 3], [0.0; 3]);
    let weights = empty.optimal();
    assert_same(&law.parts(&weights), &balance);
    assert_eq!(weights.flags(0), Flags::RANK);
    assert_eq!(weights.parts(3.0, [1.0; 3], [0.0; 3]), [0.0; 3]);
}

#[test]
fn auxiliaries_and_techniques_that_coincide_are_no_obstacle() {
    for seed in 0..20 {
        let law = Law::<2>::random(seed, 8);
        let best = law.variance(&law.parts(&law.pilot().optimal()));
        // h₃ a multiple of h₂ and g₃ = g₂: splitting a technique cannot help nor harm.
        let third = |pair: &[f64; 2], scale: f64| [pair[0], pair[1], scale * pair[1]];
        let split = Law::<3> {
            counts: [law.counts[0], 0.25 * law.counts[1], 0.75 * law.counts[1]],
            f: law.f.clone(),
            h: law.h.iter().map(|h| third(h, 0.3)).collect(),
            g: law.g.iter().map(|g| third(g, 1.0)).collect(),
        };
        let weights = split.pilot().optimal();
        let parts = split.parts(&weights);
        split.assert_complete(&parts);
        assert_eq!(weights.flags(0), Flags::RANK, "seed {seed}");
        assert_close(split.variance(&parts), best, 1e-9 * best, "split technique");
        // The same auxiliary for both.
        let mut same = law.clone();
        same.h.iter_mut().for_each(|h| h[1] = h[0]);
        let weights = same.pilot().optimal();
        let parts = same.parts(&weights);
        same.assert_complete(&parts);
        let balance = same.heuristic(PowerHeuristic::BALANCE, same.counts, &same.g);
        assert!(same.variance(&parts) <= same.variance(&balance), "seed {seed}");
    }
}

#[test]
fn dependence_is_seen_through_the_rounding_of_long_sums() {
    for seed in 0..10 {
        let mut noise = Noise(seed);
        let mut pilot = Pilot::<f64, 3>::new([1.0, 2.0, 0.5]).unwrap();
        let (alpha, scale) = (noise.next_unit(), 10.0_f64.powi(seed as i32 * 4 - 20));
        for _ in 0..100_000 {
            let [a, b, c, d, f] = [0; 5].map(|_| noise.next_unit());
            pilot.add(f, [scale * a, b, alpha * scale * a + (1.0 - alpha) * b], [c, d, 1.0]);
        }
        assert_eq!(pilot.optimal().flags(0), Flags::RANK, "seed {seed}");
        // And noise is not taken for dependence.
        let mut pilot = Pilot::<f64, 3>::new([1.0, 2.0, 0.5]).unwrap();
        for _ in 0..100 {
            let [a, b, c, d, f] = [0; 5].map(|_| noise.next_unit());
            pilot.add(f, [scale * a, b, scale * a * (1.0 + 1e-4 * c)], [c, d, 1.0]);
        }
        assert_eq!(pilot.optimal().flags(0), Flags::NONE, "seed {seed}");
    }
}

#[test]
fn a_technique_without_draws_gets_nothing() {
    let mut law = Law::<3>::random(6, 9);
    law.counts[1] = 0.0;
    let weights = law.pilot().optimal();
    let parts = law.parts(&weights);
    assert!(parts.iter().all(|parts| parts[1] == 0.0) && weights.flags(0) == Flags::NONE);
    let pick = |x: &[f64; 3]| [x[0], x[2]];
    let two = Law::<2> {
        counts: pick(&law.counts),
        f: law.f.clone(),
        h: law.h.iter().map(pick).collect(),
        g: law.g.iter().map(pick).collect(),
    };
    for (ours, right) in parts.iter().zip(two.parts(&two.pilot().optimal())) {
        assert_close(ours[0], right[0], 1e-12, "u₁");
        assert_close(ours[2], right[1], 1e-12, "u₃");
    }
}

#[test]
fn a_pilot_of_draws_learns_nearly_the_optimum() {
    let mut law = two_peaks();
    for (i, f) in law.f.iter_mut().enumerate() {
        *f += 0.002 * (1.0 + (i as f64).sin());
    }
    law.counts = [1.0, 3.0];
    let best = law.variance(&law.parts(&law.pilot().optimal()));
    let mut noise = Noise(9);
    let draw = |k: usize, noise: &mut Noise| {
        let (mut u, mut i) = (noise.next_unit(), 0);
        while u >= law.g[i][k] && i + 1 < law.g.len() {
            (u, i) = (u - law.g[i][k], i + 1);
        }
        i
    };
    let mut halves = [Pilot::<f64, 2>::new(law.counts).unwrap(); 2];
    let mut whole = halves[0];
    for n in 0..4000 {
        for k in [0, 1, 1, 1] {
            let i = draw(k, &mut noise);
            whole.add(law.f[i], law.h[i], law.g[i]);
            halves[n / 2000].add(law.f[i], law.h[i], law.g[i]);
        }
    }
    let learned = law.variance(&law.parts(&whole.optimal()));
    println!("N·variance: optimum {best:.4e}, after 16 000 pilot draws {learned:.4e}");
    assert!(learned <= 1.05 * best, "{learned:e} against {best:e}");
    // Pilots merge, and merging nothing changes no bit.
    let [mut first, second] = halves;
    first.merge(&second);
    for (ours, right) in first.optimal().slopes().into_iter().zip(whole.optimal().slopes()) {
        assert_close(ours, right, 1e-9, "merged");
    }
    let mut nothing = Pilot::new(law.counts).unwrap();
    nothing.merge(&whole);
    whole.merge(&Pilot::new(law.counts).unwrap());
    assert_eq!(nothing.optimal().slopes(), whole.optimal().slopes());
    assert_eq!(nothing.optimal().constants(), whole.optimal().constants());
}

#[test]
fn one_channel_does_not_touch_another() {
    let law = Law::<2>::random(8, 8);
    let run = |bad: f64, value: f64| {
        let mut pilot = Pilot::<Spectrum<f64, 3>, 2>::new(law.counts).unwrap();
        for i in 0..8 {
            let (f, h) = (law.f[i], law.h[i]);
            let f = Spectrum([f, if i == 3 { value } else { f }, 2.0 * f]);
            let h = h.map(|h| Spectrum([h, h * if i == 3 { bad } else { 1.0 }, h * h]));
            pilot.add_cell(1.0, f, h, law.g[i]);
        }
        let weights = pilot.optimal();
        (weights.parts(Spectrum([1.0; 3]), [Spectrum([1.0; 3]); 2], [0.3, 0.4]), weights)
    };
    let (good, _) = run(1.0, 1.0);
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        for (parts, weights) in [run(bad, 1.0), run(1.0, bad)] {
            for k in 0..2 {
                assert_eq!(parts[k][0].to_bits(), good[k][0].to_bits());
                assert_eq!(parts[k][2].to_bits(), good[k][2].to_bits());
            }
            assert_eq!((weights.flags(0), weights.flags(2)), (Flags::NONE, Flags::NONE));
            if weights.flags(1) != Flags::ALPHA {
                // 10³⁰⁰ once, in f alone, is a number.
                assert!(bad == 1e300 && parts[0][1].is_finite(), "{bad} {}", weights.flags(1));
                continue;
            }
            let balance = PowerHeuristic::BALANCE.weights(&law.counts, &[0.3, 0.4]);
            assert_same(&[[parts[0][1], parts[1][1]]], &[balance]);
        }
    }
}

#[test]
fn bad_counts_and_pdfs_are_not_silent() {
    for counts in [[0.0, 0.0], [-1.0, 2.0], [f64::NAN, 1.0], [f64::INFINITY, 1.0], [f64::MAX, f64::MAX]] {
        assert_eq!(Pilot::<f64, 2>::new(counts).unwrap_err(), Error::Counts);
        let error = OptimalWeights::<f64, 2>::new(counts, [0.0; 2], [0.0; 2]).unwrap_err();
        assert!(error.to_string().contains("number of draws"), "{error}");
    }
    let weights = OptimalWeights::<f64, 2>::new([1.0, 1.0], [1.0, 2.0], [0.5, 0.0]).unwrap();
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        assert!(weights.parts(1.0, [1.0, 1.0], [bad, 1.0]).iter().all(|part| part.is_nan()), "{bad}");
        let mut pilot = Pilot::<f64, 2>::new([1.0, 1.0]).unwrap();
        pilot.add(1.0, [1.0, 1.0], [bad, 1.0]);
        assert_eq!(pilot.optimal().flags(0), Flags::ALPHA, "{bad}");
    }
    assert!(!weights.draw(0, 1.0, [0.0, 1.0], [0.0, 1.0]).f.is_finite());
}
