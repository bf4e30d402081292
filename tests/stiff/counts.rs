//! D: counts, small N, merges.

use crate::cases::{Read, moments, run};
use ratiocv_core::moments::{Accumulate, Comoments, HasComoments, Merge, Moments, Sums, Variance};
use ratiocv_core::{Draw, Error, Estimator, Flags, HartleyRoss, Integrals, Plain, Quenouille, RatioOfMeans};
use ratiocv_tests::assert_close;
use ratiocv_tests::samples::Noise;

#[test]
fn d1_d2_f32_draws_are_counted_and_summed_beyond_f32() {
    let mut ones = Sums::<f32, 0>::default();
    ones.add_batch(&vec![Draw { f: 1.0, h: [] }; 1 << 20]);
    for _ in 0..5 {
        let half = ones;
        ones.merge(&half);
    }
    assert_eq!(ones.count(), 1 << 25);
    assert_eq!(Plain.estimate(&ones, &Integrals::NONE).unwrap().value, 1.0);
    let mut tenths = Sums::<f32, 0>::default();
    (0..10_000_000).for_each(|_| tenths.add(Draw { f: 0.1, h: [] }));
    let sum = Plain.estimate(&tenths, &Integrals::NONE).unwrap().value * 1e7;
    assert_close(sum, 1_000_000.015, 0.001, "10^7 tenths");
}

#[test]
fn d3_f32_variance_does_not_drift() {
    let mut uniform = Variance::<f32, 0>::default();
    let mut noise = Noise(3);
    let n = 1 << 24;
    // The same numbers, in f64, about an exact shift.
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..n {
        let x = noise.next_unit() as f32;
        uniform.add(Draw { f: x, h: [] });
        let d = f64::from(x) - 0.5;
        sum += d;
        squares += d * d;
    }
    let n = f64::from(n);
    let right = (squares - sum * sum / n) / (n - 1.0);
    let plain = Plain.estimate(&uniform, &Integrals::NONE).unwrap();
    assert_close(plain.std_error * plain.std_error * n, right, 1e-7 * right, "variance of 2^24 f32 uniforms");
}

/// An accumulator of `n` draws whose f has mean `mean` and Σ(f − f̄)² = `n` (or 0 for one draw).
fn doubled(start: [f64; 2], times: u32) -> Comoments<f64> {
    let mut all = moments(start.map(|f| (f, 1.0)));
    for _ in 1..times {
        let half = all;
        all.merge(&half);
    }
    all
}

#[test]
fn d4_merges_of_very_unequal_parts() {
    // 2^30 draws ±1 and one at 1e9; mean and squares of the union are known.
    let (many, one) = (doubled([-1.0, 1.0], 30), moments([(1e9, 1.0)]));
    let n = (1u64 << 30) as f64;
    let right = n + 1e18 * (n / (n + 1.0));
    for (mut first, second) in [(many, one), (one, many)] {
        first.merge(&second);
        let union = first.channel(0);
        assert_close(union.mean_of_f(), 1e9 / (n + 1.0), 4.0 * f64::EPSILON, "mean");
        assert_close(union.spread_of_f(), right, 4.0 * f64::EPSILON * right, "squares");
    }
}

#[test]
fn d5_d14_counts_beyond_2_to_the_32() {
    let mut half = doubled([0.0, 2.0], 33);
    assert_eq!(half.count(), 1 << 33);
    let mut other = doubled([1.0, 3.0], 33);
    other.merge(&half);
    half.merge(&doubled([1.0, 3.0], 33));
    let n = (1u64 << 34) as f64;
    for all in [half, other] {
        assert_eq!(all.count(), 1 << 34);
        assert_eq!(all.channel(0).mean_of_f(), 1.5);
        assert_close(all.channel(0).spread_of_f(), 1.25 * n, 1e-15 * n, "squares");
    }
}

#[test]
fn d6_d7_nothing_and_then_something() {
    let mut nothing = Comoments::<f64>::default();
    nothing.merge(&Comoments::default());
    let integrals = Integrals::ONE;
    assert!(matches!(RatioOfMeans.estimate(&nothing, &integrals), Err(Error::TooFewDraws { needed: 1, got: 0, .. })));
    assert!(RatioOfMeans.estimate_anyway(&nothing, &integrals).flags(0).contains(Flags::EMPTY));
    nothing.add(Draw::new(5.0, 1.0));
    assert_eq!(Plain.estimate(&nothing, &integrals).unwrap().value, 5.0);
}

#[test]
fn d8_one_draw() {
    let one = run(RatioOfMeans, &[(3.0, 2.0)], 4.0);
    assert_eq!((one.value, one.flags), (6.0, Flags::ONE_SAMPLE));
    assert!(one.std_error.is_nan());
    let one = run(HartleyRoss, &[(3.0, 2.0)], 4.0);
    assert_eq!((one.value, one.flags), (6.0, Flags::ONE_SAMPLE));
    let moments = moments([(3.0, 2.0)]);
    assert_eq!(
        Quenouille.check(
            &ratiocv_core::Sample {
                channel: 0,
                count: 1,
                epsilon: f64::EPSILON,
                moments: &ratiocv_tests::samples::filled(
                    ratiocv_core::moments::Groups::<f64, 2>::default(),
                    [(3.0, 2.0)]
                )
                .channel(0)
            },
            &[4.0]
        ),
        Err(Error::TooFewDraws { estimator: "quenouille", needed: 2, got: 1 })
    );
    assert!(RatioOfMeans.estimate(&moments, &Integrals::new([4.0])).is_ok());
}

#[test]
fn d10_unequal_halves_are_weighted_by_their_sizes() {
    // Halves of 2 (draws 0, 2) and of 1 (draw 1): 2R̂ − (2R̂₁ + R̂₂)/3.
    let draws = [(1.0, 2.0), (4.0, 1.0), (2.0, 3.0)];
    let (whole, odd, even) = (7.0 / 6.0, 3.0 / 5.0, 4.0);
    let right = 2.0 * whole - (2.0 * odd + even) / 3.0;
    assert_close(run(Quenouille, &draws, 1.0).value, right, 1e-15, "n_i/N weights");
}

#[test]
fn d11_channels_that_lose_draws_on_their_own_keep_counts_of_their_own() {
    // A shared count is what makes lanes cheap; where channels skip draws independently, an
    // accumulator per channel has a count per channel.
    let mut channels = [Comoments::<f64>::default(); 2];
    for i in 0..1_000_000 {
        channels[0].add(Draw::new(1.0 + f64::from(i % 3), 1.0));
        if i == 17 {
            channels[1].add(Draw::new(2.0, 1.0));
        }
    }
    let flags = channels.map(|channel| RatioOfMeans.estimate(&channel, &Integrals::ONE).unwrap().flags(0));
    assert_eq!(flags, [Flags::NONE, Flags::ONE_SAMPLE]);
}

#[test]
fn d12_singletons_merged_in_any_shape() {
    let mut noise = Noise(12);
    let draws: Vec<(f64, f64)> = (0..100_000).map(|_| (noise.next_unit(), 0.5 + noise.next_unit())).collect();
    let single = |d: &(f64, f64)| moments([*d]);
    let mut chain = single(&draws[0]);
    draws[1..].iter().for_each(|d| chain.merge(&single(d)));
    let tree = ratiocv_threads::merge_tree(draws.iter().map(single).collect()).expect("draws");
    let mut shuffled = draws.clone();
    for i in (1..shuffled.len()).rev() {
        shuffled.swap(i, (noise.next_unit() * (i + 1) as f64) as usize);
    }
    let random = ratiocv_threads::merge_tree(shuffled.iter().map(single).collect()).expect("draws");
    let blocks = moments(draws.iter().copied());
    let reference = blocks.channel(0);
    for other in [chain, tree, random] {
        let channel = other.channel(0);
        assert_close(channel.mean_of_f(), reference.mean_of_f(), 8.0 * f64::EPSILON, "mean");
        let (ours, right) = (channel.comoments(), reference.comoments());
        assert_close(ours.ff(), right.ff(), 1e-13 * right.ff(), "Σ(f − f̄)²");
        assert_close(ours.about(&[0.7]), right.about(&[0.7]), 1e-13 * right.about(&[0.7]), "Σ(e − ē)²");
    }
}
