//! The linear sets of the NIST StRD that can be generated, through the fitted difference: f = y, h_k = x^k.

use ratiocv_core::moments::{Accumulate, Comoments};
use ratiocv_core::{Difference, Draw, Estimator, Fit, Integrals, Regression};

const DIFFERENCE: Difference =
    Difference { regression: Regression { shrink: false, dependent: ratiocv_core::Dependent::MinimumNorm } };

/// d of Wampler3, 4 and 5, symmetric.
const NOISE: [f64; 21] = [
    759.0, -2048.0, 2048.0, -2048.0, 2523.0, -2048.0, 2048.0, -2048.0, 1838.0, -2048.0, 2048.0, -2048.0, 1838.0,
    -2048.0, 2048.0, -2048.0, 2523.0, -2048.0, 2048.0, -2048.0, 759.0,
];

/// β̂, and the value at x = 1, where every h_k is 1.
fn fit<const K: usize>(points: impl Iterator<Item = (f64, f64)>) -> ([f64; K], f64) {
    let mut moments = Comoments::<f64, K>::default();
    for (x, y) in points {
        moments.add(Draw { f: y, h: powers(x) });
    }
    let at_one = Integrals::new([1.0; K]);
    let value = DIFFERENCE.estimate(&moments, &at_one).expect("draws").value;
    (DIFFERENCE.learn(&moments, &at_one).coefficients, value)
}

/// −log10 of the worst relative error.
fn digits(ours: &[f64], right: &[f64]) -> f64 {
    let worst = ours
        .iter()
        .zip(right)
        .map(|(a, b)| (a - b).abs() / b.abs())
        .fold(f64::EPSILON / 2.0, |w, e| if e <= w { w } else { e });
    -worst.log10()
}

#[test]
fn lines() {
    // NoInt1 is y = 70 + x; NoInt2 has the slope ½ with a constant, 5/3 at 1.
    let (beta, value) = fit::<1>((60..71).map(|x| (f64::from(x), f64::from(x + 70))));
    assert_eq!((beta, value), ([1.0], 71.0));
    let (beta, value) = fit::<1>([(4.0, 3.0), (5.0, 4.0), (6.0, 4.0)].into_iter());
    let digits = digits(&[beta[0], value], &[0.5, 11.0 / 3.0 - 2.0]);
    assert!(digits >= 15.0, "{beta:?}, {value}, {digits} digits");
}

/// Wampler1 to 5: coefficients 1, or 10^−j, and noise in 3 to 5 that is orthogonal to all powers. What is lost is
/// lost to the noise: in Wampler5 it is 10⁷ times the coefficients. A value in the midst of the draws, such as an
/// estimate is, keeps far more digits than one at x = 1, and than the coefficients.
#[test]
fn wampler() {
    let power_sum = |x: f64, c: f64| (0..=5).map(|j| c.powi(j) * x.powi(j)).sum::<f64>();
    // Digits of the coefficients, of the value at 1 and of that at 10: measured, less one.
    for (name, c, noise, right_digits) in [
        ("Wampler1", 1.0, 0.0, [6.5, 8.0, 12.5]),
        ("Wampler2", 0.1, 0.0, [8.1, 10.5, 12.2]),
        ("Wampler3", 1.0, 1.0, [3.1, 4.6, 9.5]),
        ("Wampler4", 1.0, 100.0, [1.2, 2.7, 7.8]),
        ("Wampler5", 1.0, 1e4, [-0.4, 1.2, 5.8]),
    ] {
        let mut moments = Comoments::<f64, 5>::default();
        for (i, d) in NOISE.iter().enumerate() {
            let x = i as f64;
            moments.add(Draw { f: power_sum(x, c) + noise * d, h: powers(x) });
        }
        let estimate = |x: f64| DIFFERENCE.estimate(&moments, &Integrals::new(powers(x))).expect("draws").value;
        let beta = DIFFERENCE.learn(&moments, &Integrals::new([1.0; 5])).coefficients;
        let right: [f64; 5] = core::array::from_fn(|k| c.powi(k as i32 + 1));
        let ours = [
            digits(&beta, &right),
            digits(&[estimate(1.0)], &[power_sum(1.0, c)]),
            digits(&[estimate(10.0)], &[power_sum(10.0, c)]),
        ];
        println!("{name}: digits of the coefficients, of the value at 1, of that at 10: {ours:.1?}");
        for (ours, right) in ours.iter().zip(right_digits) {
            assert!(*ours >= right, "{name}: {ours} digits, {right} expected");
        }
        // The residual standard deviation is certified: 2360.145… times the factor of the noise.
        let means: [f64; 5] =
            core::array::from_fn(|k| (0..21).map(|x| f64::from(x).powi(k as i32 + 1)).sum::<f64>() / 21.0);
        let error = DIFFERENCE.estimate(&moments, &Integrals::new(means)).expect("draws").std_error * 21.0_f64.sqrt();
        if noise > 0.0 {
            let digits = digits(&[error], &[noise * 2_360.145_023_792_68]);
            println!("{name}: {digits:.1} digits of the residual standard deviation");
            assert!(digits >= 5.0, "{name}: {error}");
        }
    }
}

/// x, x², …
fn powers<const K: usize>(x: f64) -> [f64; K] {
    core::array::from_fn(|k| x.powi(k as i32 + 1))
}
