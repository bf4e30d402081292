//! Two and three auxiliaries: values by hand, optima against a search.

use ratiocv_core::moments::{Accumulate, Comoments, ComomentsState, Moments, Sums};
use ratiocv_core::{
    ChannelEstimate, CrossFitted, Difference, Draw, Estimator, Fit, Flags, Integrals, OptimalDefensive, Plain,
    RandomMixture, Reads, Regression, RegressionRatio,
};
use ratiocv_tests::assert_close;
use ratiocv_tests::samples::Noise;

const UNSHRUNK: Regression = Regression { shrink: false, dependent: ratiocv_core::Dependent::MinimumNorm };

/// f̄ = 10; h₁ = 1..5 = 3 + d, h₂ = 5 + d + q with q = 2, −1, −2, −1, 2 orthogonal to d; f = 10 + 3/2·d + q/2 + e,
/// e = −1, 2, 0, −2, 1 orthogonal to both: β̂ = (1, ½), Σd² = 10, Σq² = 14, Σe² = 10.
const DRAWS: [Draw<f64, 2>; 5] = [
    Draw { f: 7.0, h: [1.0, 5.0] },
    Draw { f: 10.0, h: [2.0, 3.0] },
    Draw { f: 9.0, h: [3.0, 3.0] },
    Draw { f: 9.0, h: [4.0, 5.0] },
    Draw { f: 15.0, h: [5.0, 9.0] },
];
/// H − h̄ = (1, 5/2), that is (1, 3/2) along d and q.
const INTEGRALS: Integrals<f64, 2> = Integrals::new([4.0, 7.5]);

fn moments<const K: usize>(draws: &[Draw<f64, K>]) -> Comoments<f64, K> {
    let mut moments = Comoments::default();
    draws.iter().for_each(|draw| moments.add(*draw));
    moments
}

fn run<E: Estimator<ComomentsState<f64, K>, K>, const K: usize>(
    estimator: E,
    draws: &[Draw<f64, K>],
    integrals: &Integrals<f64, K>,
) -> ChannelEstimate {
    estimator.estimate(&moments(draws), integrals).expect("enough draws").channel(0)
}

#[test]
fn difference_by_hand() {
    // 10 + 1·1 + ½·5/2; s² = 10/2, s²(1/5 + 1²/10 + (3/2)²/14).
    let leverage: f64 = 0.1 + 2.25 / 14.0;
    let unshrunk = run(Difference { regression: UNSHRUNK }, &DRAWS, &INTEGRALS);
    assert_close(unshrunk.value, 12.25, 1e-14, "value");
    assert_close(unshrunk.std_error, (5.0 * (0.2 + leverage)).sqrt(), 1e-14, "standard error");
    // 22.5 + 3.5 explained by two: 1 − 2·5/26 = 8/13 is kept. Residuals 10 + (5/13)²·26 with 2 degrees of freedom.
    let shrunk = run(Difference::default(), &DRAWS, &INTEGRALS);
    assert_close(shrunk.value, 10.0 + 18.0 / 13.0, 1e-14, "shrunk value");
    assert_close(shrunk.std_error, ((10.0 + 50.0 / 13.0) / 2.0 * (0.2 + leverage)).sqrt(), 1e-14, "shrunk error");
    // Given β: residuals of 10 + (3/2 − β₁ − β₂)²·10 + (½ − β₂)²·14 over 4·5.
    let given = run(Difference::default().fixed([2.0, -1.0]), &DRAWS, &INTEGRALS);
    assert_close(given.value, 10.0 + 2.0 - 2.5, 1e-14, "given β");
    assert_close(given.std_error, ((10.0 + 0.25 * 10.0 + 2.25 * 14.0) / 20.0_f64).sqrt(), 1e-14, "its error");
}

#[test]
fn multiple_regression_ratio_by_hand() {
    // α̂ = β̂h̄/f̄ = (3/10, 1/4): 10·(4/3)^0.3·(3/2)^0.25; the difference's error, and the distance from it.
    let ratio = RegressionRatio { regression: UNSHRUNK, ..RegressionRatio::default() };
    let ours = run(ratio, &DRAWS, &INTEGRALS);
    let value = 10.0 * (4.0_f64 / 3.0).powf(0.3) * 1.5_f64.powf(0.25);
    assert_close(ours.value, value, 1e-14, "fitted");
    let first_order = (5.0 * (0.2 + 0.1 + 2.25 / 14.0_f64)).sqrt();
    assert_close(ours.std_error, first_order.hypot(value - 12.25), 1e-14, "its error");
    // Given α, three auxiliaries: 10·√(4/3)·(5/7.5)·2²; c = αf̄/h̄ = (5/3, −2, 20/7), H − h̄ = (1, 5/2, 7).
    let three = DRAWS.map(|Draw { f, h: [a, b] }| Draw { f, h: [a, b, 10.0 - a] });
    let given = run(RegressionRatio::default().fixed([0.5, -1.0, 2.0]), &three, &Integrals::new([4.0, 7.5, 14.0]));
    let (value, linear) = (10.0 * (4.0_f64 / 3.0).sqrt() * (5.0 / 7.5) * 4.0, 10.0 + 5.0 / 3.0 - 5.0 + 20.0);
    assert_close(given.value, value, 1e-13, "given α");
    // Along d: 3/2 − 5/3 + 2 + 20/7; along q: ½ + 2.
    let along = 1.5 - 5.0 / 3.0 + 2.0 + 20.0 / 7.0;
    let first_order = ((10.0 + along * along * 10.0 + 6.25 * 14.0) / 20.0_f64).sqrt();
    assert_close(given.std_error, first_order.hypot(value - linear), 1e-13, "its error");
    assert_eq!(<RegressionRatio as Reads<1>>::ID, "regression_ratio");
    assert_eq!(<RegressionRatio as Reads<2>>::ID, "multiple_regression_ratio");
}

#[test]
fn random_mixture_by_hand() {
    // a = (3/4, 1/2): h̄′ = 3/4·3/4 + 1/2·2/3, Σa = 5/4; c = f̄/h̄′·a/H.
    let ours = run(<RandomMixture>::default().fixed([0.75, 0.5]), &DRAWS, &INTEGRALS);
    let ratio = 10.0 / (0.5625 + 1.0 / 3.0);
    assert_close(ours.value, 1.25 * ratio, 1e-14, "given weights");
    let c = [ratio * 0.75 / 4.0, ratio * 0.5 / 7.5];
    let (d, q) = (1.5 - c[0] - c[1], 0.5 - c[1]);
    assert_close(ours.std_error, ((10.0 + d * d * 10.0 + q * q * 14.0) / 20.0).sqrt(), 1e-14, "its error");
    let nothing = run(<RandomMixture>::default().fixed([1.0, -1.0]), &DRAWS, &INTEGRALS);
    assert!(nothing.value == 10.0 && nothing.flags.contains(Flags::DENOM_ZERO), "{nothing:?}");
}

#[test]
fn optimal_defensive_by_hand() {
    // β̂ shrunk (8/13, 4/13), F̂ = 148/13: a = (32, 30)/148, a_0 = 86/148. Inside: the difference, as a ratio.
    let learned = <OptimalDefensive>::default().learn(&moments(&DRAWS), &INTEGRALS);
    assert_close(learned.coefficients[0], 32.0 / 148.0, 1e-15, "a₁");
    assert_close(learned.coefficients[1], 30.0 / 148.0, 1e-15, "a₂");
    let (ours, right) =
        (run(<OptimalDefensive>::default(), &DRAWS, &INTEGRALS), run(Difference::default(), &DRAWS, &INTEGRALS));
    assert_close(ours.value, right.value, 1e-14, "value");
    assert_close(ours.std_error, right.std_error, 1e-14, "standard error");
}

/// `count` draws of K auxiliaries in [0, 2) that share some of their noise, and of f, which `f` makes of them.
fn noisy<const K: usize>(seed: u64, count: usize, f: impl Fn([f64; K], f64) -> f64) -> Vec<Draw<f64, K>> {
    let mut noise = Noise(seed);
    let draw = |_| {
        let shared = noise.next_unit();
        let h = core::array::from_fn(|_| shared + noise.next_unit());
        Draw { f: f(h, noise.next_unit()), h }
    };
    (0..count).map(draw).collect()
}

/// Σ((y/F − Σa_k x_k/H_k) − mean)², by its definition.
fn squares<const K: usize>(draws: &[Draw<f64, K>], of_f: f64, a: &[f64; K], integrals: &Integrals<f64, K>) -> f64 {
    let e = |draw: &Draw<f64, K>| draw.f / of_f - (0..K).map(|k| a[k] * draw.h[k] / integrals.0[k]).sum::<f64>();
    let mean = draws.iter().map(e).sum::<f64>() / draws.len() as f64;
    draws.iter().map(|draw| (e(draw) - mean).powi(2)).sum()
}

/// The regression estimate of F that the weights are made with.
fn first_estimate<const K: usize>(draws: &[Draw<f64, K>], integrals: &Integrals<f64, K>) -> f64 {
    run(Difference { regression: UNSHRUNK }, draws, integrals).value
}

#[test]
fn two_weights_have_a_closed_form() {
    let integrals = Integrals::new([1.0, 1.25]);
    for seed in 0..50 {
        let draws = noisy::<2>(seed, 40, |[a, b], e| a + 0.8 * b + 0.5 * e);
        let of_f = first_estimate(&draws, &integrals);
        // a₂ = Cov(u₂ − u₁, y/F − u₁)/Var(u₂ − u₁), by polarisation of sums of squares.
        let s = |y: f64, u1: f64, u2: f64| {
            let scaled: Vec<_> = draws.iter().map(|draw| Draw { f: y * draw.f, ..*draw }).collect();
            squares(&scaled, of_f, &[u1, u2], &integrals)
        };
        let (sum, difference) = (s(1.0, 2.0, -1.0), s(0.0, 1.0, -1.0));
        let right = (sum - s(1.0, 1.0, 0.0) - difference) / 2.0 / difference;
        let mixture = RandomMixture { regression: UNSHRUNK, ..<RandomMixture>::default() };
        let [_, a2] = mixture.learn(&moments(&draws), &integrals).coefficients;
        let clamped = right.clamp(0.0, 1.0);
        assert_close(a2, clamped, 1e-12, &format!("a₂, seed {seed}"));
    }
}

/// No weights on a grid of the simplex do better; with three auxiliaries some minima lie on its edge.
#[test]
fn mixtures_are_better_than_any_on_a_grid() {
    let mixture = RandomMixture { regression: UNSHRUNK, ..<RandomMixture>::default() };
    let integrals = Integrals::new([1.0, 1.1, 0.9]);
    let mut on_edge = 0;
    for seed in 0..60 {
        let slope = [seed as f64 / 20.0 - 1.0, 1.0, 0.4];
        let draws = noisy::<3>(seed, 24, |h, e| 1.0 + (0..3).map(|k| slope[k] * h[k]).sum::<f64>() + 0.4 * e);
        let of_f = first_estimate(&draws, &integrals);
        let a = mixture.learn(&moments(&draws), &integrals).coefficients;
        assert_close(a.iter().sum(), 1.0, 1e-14, "Σa");
        assert!(a.iter().all(|a| *a >= 0.0), "{a:?}");
        on_edge += usize::from(a.contains(&0.0));
        let least = squares(&draws, of_f, &a, &integrals);
        for i in 0..=50 {
            for j in 0..=50 - i {
                let grid = [f64::from(i) / 50.0, f64::from(j) / 50.0, f64::from(50 - i - j) / 50.0];
                let other = squares(&draws, of_f, &grid, &integrals);
                assert!(least <= other * (1.0 + 1e-12), "seed {seed}: {a:?} has {least}, {grid:?} {other}");
            }
        }
    }
    assert!((10..50).contains(&on_edge), "{on_edge} of 60 on an edge");
}

/// Where f is the mixture of equal weights there is nothing left to fit but rounding: the weights stay equal.
#[test]
fn an_exact_mixture_is_found() {
    let integrals = Integrals::new([1.0, 1.25]);
    for seed in 0..200 {
        for (a, b) in [(0.5, 0.5), (0.3, 0.7)] {
            let draws = noisy::<2>(seed, 12, |[x, y], _| 3.0 * (a * x + b * y / 1.25));
            let ours = run(<RandomMixture>::default(), &draws, &integrals);
            assert_close(ours.value, 3.0, 1e-13, &format!("seed {seed}, weights {a}, {b}"));
        }
    }
}

/// Weights without negative ones, against the best of all subsets.
#[test]
fn optimal_defensive_weights_are_the_best_of_all_subsets() {
    let optimal = OptimalDefensive { regression: UNSHRUNK, ..<OptimalDefensive>::default() };
    let difference = Difference { regression: UNSHRUNK };
    let integrals = Integrals::new([1.0, 1.25]);
    let mut sizes = [0; 3];
    for seed in 0..300 {
        let slope = [(seed % 17) as f64 / 20.0 - 0.4, (seed % 23) as f64 / 20.0 - 0.6];
        let mut draws = noisy::<2>(seed, 12, |h, e| 9.0 + slope[0] * h[0] + slope[1] * h[1] + 2.0 * e);
        if seed % 2 == 1 {
            // Auxiliaries that oppose each other: one that was left out may have to come back.
            draws.iter_mut().for_each(|draw| draw.h[1] = 2.0 - draw.h[1]);
        }
        let of_f = first_estimate(&draws, &integrals);
        // Each auxiliary alone, both, none: least squares, by one-auxiliary fits.
        let alone = |k: usize| {
            let of_one: Vec<_> = draws.iter().map(|draw| draw.auxiliary(k)).collect();
            let [beta] = difference.learn(&moments(&of_one), &Integrals::new([integrals.0[k]])).coefficients;
            beta * integrals.0[k] / of_f
        };
        let both = difference.learn(&moments(&draws), &integrals).coefficients;
        let both = [both[0] * integrals.0[0] / of_f, both[1] * integrals.0[1] / of_f];
        let best = [[0.0, 0.0], [alone(0), 0.0], [0.0, alone(1)], both]
            .into_iter()
            .filter(|a| a.iter().all(|a| *a >= 0.0))
            .min_by(|a, b| squares(&draws, of_f, a, &integrals).total_cmp(&squares(&draws, of_f, b, &integrals)))
            .expect("none at all is allowed");
        let ours = optimal.learn(&moments(&draws), &integrals).coefficients;
        let sum: f64 = best.iter().sum();
        assert!(sum <= 0.99, "the floor is another test's concern");
        for k in 0..2 {
            assert_close(ours[k], best[k], 1e-12, &format!("seed {seed}, a_{k}"));
        }
        sizes[best.iter().filter(|a| **a > 0.0).count()] += 1;
        // Not the optimum of any sign: flagged.
        let flags = run(optimal, &draws, &integrals).flags;
        assert_eq!(flags.contains(Flags::ALPHA), best != both, "seed {seed}: {flags}");
    }
    assert!(sizes.iter().all(|size| *size >= 30), "{sizes:?}");
}

/// The greatest weights are scaled down to 1 less the floor.
#[test]
fn the_proposal_keeps_its_floor() {
    let optimal = OptimalDefensive { regression: UNSHRUNK, floor: 0.25, ..<OptimalDefensive>::default() };
    let draws = noisy::<2>(5, 40, |[a, b], e| a + b + 0.01 * e);
    let a = optimal.learn(&moments(&draws), &Integrals::new([1.0, 1.0])).coefficients;
    assert_close(a[0] + a[1], 0.75, 1e-15, "Σa");
    let free =
        OptimalDefensive { floor: -9.0, ..optimal }.learn(&moments(&draws), &Integrals::new([1.0, 1.0])).coefficients;
    assert_close(a[0] / a[1], free[0] / free[1], 1e-14, "their ratio");
}

/// Where f is linear in h every fitted difference is exact, cross-fitted or not. Its error is what the first
/// draws, fewer than there are coefficients, leave when the slopes are found: up to √ε·s_f/√N, here 3e-9.
#[test]
fn what_is_linear_is_exact() {
    let draws = noisy::<2>(9, 40, |[a, b], _| 2.0 + 3.0 * a - b);
    let integrals = Integrals::new([1.0, 1.0]);
    for estimate in [
        run(Difference::default(), &draws, &integrals),
        run(<OptimalDefensive>::default().fixed([0.75, -0.25]), &draws, &integrals),
    ] {
        assert_close(estimate.value, 4.0, 1e-13, "value");
        assert!(estimate.std_error <= 3e-9, "{estimate:?}");
    }
    let estimator = CrossFitted(Difference::default());
    let mut folds = estimator.error_bar(&integrals);
    draws.iter().for_each(|draw| folds.add(*draw));
    let ours = estimator.estimate(&folds, &integrals).expect("40 draws").channel(0);
    assert_close(ours.value, 4.0, 1e-13, "cross-fitted");
    assert!(ours.std_error <= 3e-9, "{ours:?}");
    // Mickey on the mixture of two, cross-fitted: a = (3/4, −1/4) is not allowed; flagged, and near.
    let estimator = CrossFitted(OptimalDefensive::of(ratiocv_core::Mickey));
    let mut folds = estimator.error_bar(&integrals);
    draws.iter().for_each(|draw| folds.add(*draw));
    let ours = estimator.estimate(&folds, &integrals).expect("40 draws").channel(0);
    assert!(ours.flags.contains(Flags::ALPHA) && (ours.value - 4.0).abs() <= 4.0 * ours.std_error, "{ours:?}");
}

/// Value-tier moments serve given coefficients, without an error bar; a bad integral concerns those that read it.
#[test]
fn tiers_and_bad_integrals() {
    let mut sums = Sums::<f64, 2>::default();
    DRAWS.iter().for_each(|draw| sums.add(*draw));
    let value = Difference::default().fixed([1.0, 0.5]).estimate(&sums, &INTEGRALS).expect("draws").channel(0);
    assert_close(value.value, 12.25, 1e-14, "value tier");
    assert!(value.std_error.is_nan());
    assert_eq!(sums.count(), 5);
    for bad in [0.0, f64::NAN, f64::INFINITY] {
        let integrals = Integrals::new([4.0, bad]);
        for estimate in [
            run(Difference::default(), &DRAWS, &integrals),
            run(RegressionRatio::default(), &DRAWS, &integrals),
            run(<RandomMixture>::default(), &DRAWS, &integrals),
            run(<OptimalDefensive>::default(), &DRAWS, &integrals),
        ] {
            assert!(estimate.value == 10.0 && estimate.flags.contains(Flags::BAD_INTEGRAL), "{estimate:?}");
        }
        assert_eq!(run(Plain, &DRAWS, &integrals).flags, Flags::NONE);
    }
}
