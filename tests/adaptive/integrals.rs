//! Estimates with draws from a grid.

use crate::support::generator;
use ratiocv_core::moments::{Accumulate, Moments};
use ratiocv_core::{Draw, Estimate, Estimator, Grid, Mickey, Plain, RatioOfMeans, Reads, Spectrum};
use ratiocv_tests::assert_close;

type Pair = Spectrum<f64, 2>;

/// (x²y, 30xy²(1 − x)(1 − y)/…): neither a product of steps nor alike. Integrals 1/6 and 5/12.
fn polynomials(x: &[f64; 2]) -> Pair {
    let [x, y] = *x;
    Spectrum([x * x * y, 30.0 * x * (1.0 - x) * y * y * (1.0 - y)])
}

const EXACT: [f64; 2] = [1.0 / 6.0, 5.0 / 12.0];

/// One grid for each seed, and an estimate with 1000 draws from it.
fn runs<const C: usize, E>(estimator: E, seeds: core::ops::Range<u64>) -> Vec<Estimate<Pair>>
where
    E: Reads<1> + Estimator<<E::ErrorBar<Pair> as Moments>::Channel, 1>,
{
    seeds
        .map(|seed| {
            let mut rng = generator(seed);
            let mut grid = Grid::<2, 16, C>::uniform();
            grid.adapt(&polynomials, 3, 1000, &mut rng);
            grid.problem(polynomials).integrate(&estimator, 1000, &mut rng).unwrap()
        })
        .collect()
}

/// z of the mean over runs, and the mean of (error/standard error)².
fn z_and_calibration(runs: &[Estimate<Pair>], channel: usize) -> (f64, f64) {
    let n = runs.len() as f64;
    let errors = || runs.iter().map(|run| run.value[channel] - EXACT[channel]);
    let (mean, square) = (errors().sum::<f64>() / n, errors().map(|e| e * e).sum::<f64>() / n);
    let calibration = errors().zip(runs).map(|(e, run)| (e / run.std_error[channel]).powi(2)).sum::<f64>() / n;
    (mean / (square / n).sqrt(), calibration)
}

/// Training draws discarded, the estimate given the grid is unbiased. 400 runs; |z| ≤ 4.5 fails by
/// chance in one of 37 000 tests at 2 channels × 3 cases (Šidák), at fixed seeds never. The square of
/// error over standard error has mean 1 and variance 2, so 400 of them 1 ± 0.071: five of these.
#[test]
fn plain_and_mickey_are_unbiased_with_honest_error_bars() {
    for (name, runs) in [
        ("plain, one component", runs::<1, _>(Plain, 0..400)),
        ("plain, two components", runs::<2, _>(Plain, 0..400)),
        ("mickey, two components", runs::<2, _>(Mickey, 0..400)),
    ] {
        for channel in 0..2 {
            let (z, calibration) = z_and_calibration(&runs, channel);
            assert!(z.abs() <= 4.5, "{name}, channel {channel}: z = {z}");
            assert_close(calibration, 1.0, 0.36, name);
            assert!(runs.iter().all(|run| run.flags(channel).is_empty()), "{name}");
        }
    }
}

#[test]
fn the_ratio_of_means_removes_most_of_a_mixtures_noise() {
    let mean_error = |runs: &[Estimate<Pair>], channel: usize| {
        runs.iter().map(|run| run.std_error[channel]).sum::<f64>() / runs.len() as f64
    };
    let (ratio, plain) = (runs::<2, _>(RatioOfMeans, 0..20), runs::<2, _>(Plain, 0..20));
    for channel in 0..2 {
        assert!(mean_error(&ratio, channel) <= 0.5 * mean_error(&plain, channel), "channel {channel}");
        let (z, calibration) = z_and_calibration(&ratio, channel);
        // 20 runs: five standard errors of the mean of 20 squares, 1 ± 0.32.
        assert!(z.abs() <= 4.5 && calibration <= 2.6, "{z} {calibration}");
    }
}

/// A standard normal density N has Σw³N′²/12N = (∫N^⅓)²·∫z²N^⅓/12B² = 8.17/B² over bins of equal
/// ∫N^⅓: a relative standard deviation of 2.23 % for 128 of them. (Bins of equal ∫N: 20 %.)
#[test]
fn edges_go_where_the_density_changes() {
    let f = |x: &[f64; 1]| libm::exp(-50.0 * (x[0] - 0.4) * (x[0] - 0.4));
    let mut rng = generator(1);
    let mut grid = Grid::<1, 128>::uniform();
    grid.adapt(&f, 6, 100_000, &mut rng);
    let estimate = grid.problem(f).integrate(&Plain, 100_000, &mut rng).unwrap();
    let deviation = estimate.std_error / estimate.value * 100_000.0_f64.sqrt();
    assert!((0.019..0.025).contains(&deviation), "{deviation}");
}

#[test]
fn the_auxiliaries_have_mean_one() {
    let mut rng = generator(1);
    let mut grid = Grid::<2, 16, 2>::uniform();
    grid.adapt(&polynomials, 3, 1000, &mut rng);
    let problem = grid.problem(polynomials);
    let draws: Vec<Draw<Pair>> = (0..20_000).map(|_| problem.draw(&mut rng)).collect();
    for channel in 0..2 {
        let mean = draws.iter().map(|draw| draw.h[0][channel]).sum::<f64>() / 20_000.0;
        // h/g ≤ 2, so its standard deviation is at most 1: five standard errors of the mean.
        assert_close(mean, 1.0, 5.0 / 20_000.0_f64.sqrt(), "mean of h/g");
        assert!(draws.iter().all(|draw| draw.h[0][channel] > 0.0 && draw.h[0][channel] <= 2.0));
        // Of two components the densities add up to twice the mixture's.
        assert!(draws.iter().all(|draw| (draw.h[0][0] + draw.h[0][1] - 2.0).abs() <= 1e-14));
    }
}

#[test]
fn one_component_is_plain_monte_carlo() {
    let (ratio, plain) = (runs::<1, _>(RatioOfMeans, 0..3), runs::<1, _>(Plain, 0..3));
    for (ratio, plain) in ratio.iter().zip(&plain) {
        for channel in 0..2 {
            assert_close(ratio.value[channel], plain.value[channel], 1e-15, "value");
            assert_close(ratio.std_error[channel], plain.std_error[channel], 1e-15, "error");
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_bits() {
    let bits = || runs::<2, _>(RatioOfMeans, 7..8)[0].value.0.map(f64::to_bits);
    assert_eq!(bits(), bits());
}

#[test]
fn draws_in_f32_are_the_rounded_ones() {
    let f = |x: &[f64; 2]| Spectrum(polynomials(x).0.map(|f| f as f32));
    let mut grid = Grid::<2, 16, 2>::uniform();
    grid.adapt(&f, 3, 1000, &mut generator(1));
    let mut moments = RatioOfMeans.error_bar(&ratiocv_core::Integrals::ONE);
    let problem = grid.problem(f);
    let mut rng = generator(2);
    for _ in 0..10_000 {
        moments.add(problem.draw(&mut rng));
    }
    let estimate: Estimate<Spectrum<f32, 2>> = RatioOfMeans.estimate(&moments, &ratiocv_core::Integrals::ONE).unwrap();
    for (channel, exact) in EXACT.into_iter().enumerate() {
        // |z| ≤ 5, at a fixed seed.
        assert_close(estimate.value[channel], exact, 5.0 * estimate.std_error[channel], "value");
    }
}

#[test]
fn pcg_is_not_needed() {
    // Any generator will do: a counter is a bad one, and the estimate of a constant is still exact.
    let grid = Grid::<3, 8, 2>::uniform();
    let mut words = crate::support::Words::new(|i| i.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let estimate =
        grid.problem(|_: &[f64; 3]| Spectrum([2.0, -3.0])).integrate(&RatioOfMeans, 100, &mut words).unwrap();
    assert_eq!(estimate.value, Spectrum([2.0, -3.0]));
}
