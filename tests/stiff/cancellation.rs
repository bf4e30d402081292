//! C: offsets, constants, cancellation.

use crate::cases::{Read, moments, ratio, run, squares};
use ratiocv_core::moments::{Accumulate, HasComoments, Merge, Moments, Variance};
use ratiocv_core::{
    Beale, Draw, Estimator, Flags, HartleyRoss, Integrals, MeanOfRatios, Plain, Quenouille, RatioOfMeans, Tin,
};
use ratiocv_tests::assert_close;
use ratiocv_tests::samples::Noise;

/// NumAcc2, 3, 4 of NIST's StRD: b + .2, then 500 times b + .1, b + .3; parsed, so rounded once.
fn num_acc(base: &str) -> Vec<f64> {
    let number = |tenth: &str| format!("{base}.{tenth}").parse::<f64>().expect("a number");
    let (first, low, high) = (number("2"), number("1"), number("3"));
    core::iter::once(first).chain((0..1000).map(|i| if i % 2 == 0 { low } else { high })).collect()
}

/// Correct decimal digits.
fn digits(ours: f64, right: f64) -> f64 {
    -((ours - right).abs() / right).log10()
}

#[test]
fn c1_num_acc_keeps_its_digits_however_it_is_merged() {
    // The exact variance of the *rounded* numbers.
    let acc4 = 0.010_000_000_111_758_709;
    for (base, right) in [("1", None), ("1000000", None), ("10000000", Some(acc4))] {
        let numbers = num_acc(base);
        // Deviations from the base are exact, so that the definition is too, to 1e-16.
        let offset = numbers[0];
        let deviations: Vec<f64> = numbers.iter().map(|x| x - offset).collect();
        let mean = deviations.iter().sum::<f64>() / 1001.0;
        let exact = deviations.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / 1000.0;
        if let Some(right) = right {
            assert!(digits(exact, right) > 15.0);
        }
        let whole = squares(numbers.iter().copied()) / 1000.0;
        assert!(digits(whole, exact) >= 13.5, "{base}: {whole} for {exact}");
        for parts in [2, 7, 100, 1001] {
            let mut merged = moments::<f64>([]);
            for part in numbers.chunks(1001usize.div_ceil(parts)) {
                merged.merge(&moments(part.iter().map(|x| (*x, 1.0))));
            }
            let merged = merged.channel(0).spread_of_f() / 1000.0;
            assert!(digits(merged, exact) >= 13.5, "{base} in {parts} parts: {merged} for {exact}");
        }
    }
}

#[test]
fn c2_c11_f32_constants_have_no_variance() {
    // NumAcc4 rounds to the constant 1e7 in f32.
    assert_eq!(squares(num_acc("10000000").iter().map(|x| *x as f32)), 0.0);
    assert_eq!(squares([1e9_f32; 3]), 0.0);
}

#[test]
fn c3_c4_small_spreads_on_large_numbers() {
    assert_eq!(squares((0..7).map(|i| 1e12 + f64::from(i))) / 7.0, 4.0);
    assert_eq!(squares([7e12 + 5.0, 7e12 + 7.0]) / 2.0, 1.0);
    assert_eq!(squares([3.0, 4.0, 6.0, 7.0].map(|x| 1e8 + x)) / 4.0, 2.5);
}

#[test]
fn c5_a_constant_is_exact_for_any_lanes_blocks_and_tree() {
    fn check<V: ratiocv_core::Lanes>() {
        use ratiocv_core::Scalar;
        let tenth = V::Scalar::from_f64(0.1);
        let draw = Draw::new(V::splat(tenth), V::ONE);
        let mut whole = Variance::<V>::default();
        whole.add_batch(&core::iter::repeat_n(draw, 100_000).collect::<Vec<_>>());
        let mut tree: Vec<_> = (0..1000)
            .map(|i| {
                let mut part = Variance::<V>::default();
                (0..100 + i % 3).for_each(|_| part.add(draw));
                part
            })
            .collect();
        while tree.len() > 1 {
            let later = tree.split_off(tree.len() / 2);
            tree.iter_mut().zip(&later).for_each(|(a, b)| a.merge(b));
        }
        for moments in [whole, tree[0]] {
            let plain = Plain.estimate(&moments, &Integrals::ONE).unwrap();
            for channel in 0..V::LANES {
                let channel = plain.channel(channel);
                assert_eq!(channel.value.to_bits(), ratiocv_core::Lanes::widen(tenth).to_bits());
                assert_eq!(channel.std_error, 0.0);
            }
        }
    }
    check::<f64>();
    check::<f32>();
    check::<ratiocv_core::Spectrum<f32, 3>>();
    check::<ratiocv_core::Spectrum<f64, 17>>();
    // A million draws, once.
    let mut million = Variance::<f64, 0>::default();
    (0..1_000_000).for_each(|_| million.add(Draw { f: 0.1, h: [] }));
    let plain = Plain.estimate(&million, &Integrals::NONE).unwrap();
    assert_eq!((plain.value, plain.std_error), (0.1, 0.0));
}

#[test]
fn c6_an_awkward_constant() {
    assert_eq!(squares([100_000_000.815_068_51_f64; 10_000]), 0.0);
}

#[test]
fn c7_residuals_at_the_level_of_rounding() {
    let mut noise = Noise(7);
    let (mut roundoffs, mut negative) = (Vec::new(), 0);
    for _ in 0..10_000 {
        let draws: Vec<(f32, f32)> = (0..64).map(|_| noise.next_unit() as f32 + 0.5).map(|h| (h / 3.0, h)).collect();
        // The definition, in f64.
        let n = 64.0;
        let (f, h) = draws.iter().fold((0.0, 0.0), |m, d| (m.0 + f64::from(d.0) / n, m.1 + f64::from(d.1) / n));
        let right: f64 = draws.iter().map(|d| ((f64::from(d.0) - f) - f / h * (f64::from(d.1) - h)).powi(2)).sum();
        negative += u32::from(expanded(&draws) < 0.0);
        let moments = moments(draws);
        let spread = moments.channel(0).comoments();
        let ours = spread.about(&[f / h]);
        roundoffs.push((ours / spread.ff()).sqrt() * 2.0_f64.powi(24));
        // Never negative, and no more than 32 units of the last place of f32 of the spread of f.
        let floor = (32.0 * f64::from(f32::EPSILON)).powi(2) * spread.ff();
        assert!(ours >= 0.0 && ours <= floor, "{ours:e} for {right:e}");
        // What is reported is that floor, with a flag.
        let estimate = RatioOfMeans.estimate(&moments, &Integrals::ONE).unwrap();
        assert!(estimate.flags(0).contains(Flags::ROUNDING));
        assert_close(estimate.std_error, (floor / n / (n - 1.0)).sqrt(), 1e-6 * estimate.std_error, "floor");
        assert!(estimate.std_error * estimate.std_error >= right / n / (n - 1.0), "the floor hides an error");
    }
    roundoffs.sort_by(f64::total_cmp);
    let [median, high, worst] = [5_000, 9_900, 9_999].map(|rank| roundoffs[rank]);
    println!("unit roundoffs of the spread of f: median {median:.1}, 99 % {high:.1}, worst {worst:.1}");
    println!("the expanded formula is below zero in {negative} of 10000 trials");
    // What the comments say of both (estimator/remarks.rs, moments/comoments.rs).
    assert!(median <= 3.0 && high <= 25.0 && worst <= 40.0, "{median}, {high}, {worst}");
    assert!(negative > 2_500, "{negative}");
}

/// s_ff − 2c·s_fh + c²·s_hh for c = f̄/h̄, in `f32`, of sums about the means.
fn expanded(draws: &[(f32, f32)]) -> f32 {
    let (f, h) = draws.iter().fold((0.0, 0.0), |sum, draw| (sum.0 + draw.0, sum.1 + draw.1));
    let (f, h) = (f / draws.len() as f32, h / draws.len() as f32);
    let sum = |product: fn(f32, f32) -> f32| draws.iter().map(|draw| product(draw.0 - f, draw.1 - h)).sum::<f32>();
    let (ff, fh, hh) = (sum(|f, _| f * f), sum(|f, h| f * h), sum(|_, h| h * h));
    let c = f / h;
    ff - 2.0 * c * fh + c * c * hh
}

#[test]
fn c8_one_ulp_apart() {
    let mut xs = [1.0; 7];
    xs[6] = 1.000_000_000_000_01;
    let variance = squares(xs) / 7.0;
    let (sample, right) = (squares(xs) / 6.0, 1.426_288_690_243_347_2e-29);
    assert!(
        (sample / right - 1.0).abs() <= 1e-12 || (variance / right - 1.0).abs() <= 1e-12,
        "{sample:e} or {variance:e} for {right:e}"
    );
}

#[test]
fn c9_a_constant_auxiliary_changes_nothing() {
    let draws: Vec<_> = (0..100).map(|i| (f64::from(i % 7) / 3.0, 0.3)).collect();
    let plain = run(Plain, &draws, 0.3);
    for case in [ratio(&draws, 0.3), run(Beale, &draws, 0.3), run(Tin, &draws, 0.3), run(Quenouille, &draws, 0.3)] {
        assert_close(case.value, plain.value, 2.0 * f64::EPSILON, "f̄");
        assert_eq!(case.flags, Flags::NONE);
    }
    assert_eq!(ratio(&draws, 0.3).value.to_bits(), plain.value.to_bits());
    assert_eq!(ratio(&draws, 0.3).std_error.to_bits(), plain.std_error.to_bits());
}

#[test]
fn c10_proportional_draws_have_no_error() {
    let draws: Vec<_> = (0..100).map(|i| 0.1 + f64::from(i * i % 13)).map(|h| (2.0 * h, h)).collect();
    let h = 6.0;
    for case in [
        ratio(&draws, h),
        run(Quenouille, &draws, h),
        run(Beale, &draws, h),
        run(Tin, &draws, h),
        run(MeanOfRatios, &draws, h),
        run(HartleyRoss, &draws, h),
        run(ratiocv_core::Mickey, &draws, h),
    ] {
        assert_close(case.value, 2.0 * h, 4.0 * f64::EPSILON * h, "2H");
        assert_eq!(case.std_error, 0.0);
        assert_eq!(case.flags, Flags::NONE);
    }
    assert_eq!(RatioOfMeans.estimate(&moments(draws), &Integrals::new([h])).unwrap().value, 2.0 * h);
}
