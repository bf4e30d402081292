//! B, E: dynamic range, and the rows of the estimators' own formulas.

use crate::cases::{ratio, ratio32, run, run_on};
use ratiocv_core::moments::{
    Accumulate, Blocked, Comoments, ComomentsBlock, HasComoments, Joined, Moments, RatioOf, UnivariateBlock, Widened,
};
use ratiocv_core::{
    Beale, CrossFitted, Draw, Estimator, Flags, HartleyRoss, Integrals, MeanOfRatios, Plain, RatioOfMeans,
    RegressionRatio, Tin,
};
use ratiocv_tests::assert_close;

/// A case in f32 blocks must be right or flagged; in f64 blocks it must be right.
fn f32_or_flagged(draws: [(f32, f32); 2], integral: f64, value: f64) {
    let narrow = ratio32(&draws, integral);
    assert_close(narrow.value, value, 1e-7 * value, "value in f32 blocks");
    let honest = narrow.flags.contains(Flags::OVERFLOW) || narrow.flags.contains(Flags::UNDERFLOW);
    let floor = narrow.flags.contains(Flags::ROUNDING) && narrow.std_error <= 1e-5 * value;
    assert!(narrow.std_error == 0.0 || floor || (narrow.std_error.is_nan() && honest), "{narrow:?}");
    // The same in a block of its own, beyond the four draws that go straight to f64.
    let mut blocks = Comoments::<f32>::default();
    let mut wide = Widened::<f32, Comoments<f64>>::default();
    for i in 0..200 {
        let draw = Draw::new(draws[i % 2].0, draws[i % 2].1);
        blocks.add(draw);
        wide.add(draw);
    }
    let narrow = RatioOfMeans.estimate(&blocks, &Integrals::new([integral])).unwrap().channel(0);
    assert_close(narrow.value, value, 1e-7 * value, "value in f32 blocks");
    let honest = narrow.flags.contains(Flags::OVERFLOW) || narrow.flags.contains(Flags::UNDERFLOW);
    assert!(honest && narrow.std_error.is_nan(), "{narrow:?}");
    let wide = RatioOfMeans.estimate(&wide, &Integrals::new([integral])).unwrap().channel(0);
    assert_close(wide.value, value, 1e-7 * value, "value in f64 blocks");
    assert!(wide.std_error <= 1e-7 * value, "{wide:?}");
}

#[test]
fn b1_b2_squares_beyond_f32() {
    f32_or_flagged([(1e20, 1e20), (3e20, 3e20)], f64::from(1e20_f32), f64::from(1e20_f32));
    f32_or_flagged([(1e-25, 1e-25), (3e-25, 3e-25)], f64::from(1e-25_f32), f64::from(1e-25_f32));
}

#[test]
fn b3_scales_sixty_orders_apart() {
    f32_or_flagged([(1e30, 1e-30), (3e30, 3e-30)], f64::from(1e-30_f32), f64::from(1e30_f32));
}

#[test]
fn b4_merges_with_nothing_are_the_identity() {
    use ratiocv_core::moments::Merge;
    for f in [f64::MAX, 1e155] {
        let (mut one, mut nothing) = (crate::cases::moments([(f, 1.0)]), Comoments::<f64>::default());
        one.merge(&Comoments::default());
        nothing.merge(&one);
        for moments in [one, nothing] {
            assert_eq!(moments.channel(0).comoments().ff(), 0.0);
            assert_eq!(RatioOfMeans.estimate(&moments, &Integrals::ONE).unwrap().value, f);
        }
    }
}

#[test]
fn b5_b6_overflow_is_flagged_and_never_negative() {
    let far = ratio(&[(1e300, 1.0), (-1e300, 1.0)], 1.0);
    assert_eq!(far.value, 0.0);
    assert!(far.flags.contains(Flags::OVERFLOW) && far.std_error.is_nan());
    let farthest = ratio(&[(f64::MAX, 1.0), (-f64::MAX, 1.0)], 1.0);
    assert!(farthest.flags.contains(Flags::NONFINITE) && farthest.std_error.is_nan(), "{farthest:?}");
}

#[test]
fn b7_channels_of_different_size_do_not_meet() {
    use ratiocv_core::Spectrum;
    let f = [1e-38_f32, 1.0, 1e38];
    let mut moments = Comoments::default();
    moments.add_batch(&[Draw::new(Spectrum(f), Spectrum([1.0; 3])); 100]);
    let estimate = RatioOfMeans.estimate(&moments, &Integrals::ONE).unwrap();
    assert_eq!(estimate.value, Spectrum(f.map(f64::from)));
    assert_eq!(estimate.std_error, Spectrum([0.0; 3]));
}

#[test]
fn e1_an_unbiased_estimate_may_be_negative() {
    let e1 = run(HartleyRoss, &[(1.0, 0.1), (0.0, 1.9)], 1.0);
    assert_close(e1.value, -4.0, 1e-14, "Hartley–Ross");
    assert!(e1.flags.contains(Flags::NEGATIVE));
}

#[test]
fn e2_e3_zeros_of_the_auxiliary() {
    // f = h = 0: r counts as 0. Over draws (0, 0), (1, 1), (2, 1): r̄ = 1, by hand 1 + 3/2·(1 − 2/3).
    let e2 = run(HartleyRoss, &[(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)], 1.0);
    assert_close(e2.value, 1.5, 1e-15, "Hartley–Ross with an empty draw");
    let e3 = run(HartleyRoss, &[(1.0, 0.0), (1.0, 1.0), (4.0, 1.0)], 1.0);
    assert_eq!((e3.value, e3.flags & Flags::UNBOUNDED_RATIO), (2.0, Flags::UNBOUNDED_RATIO));
}

#[test]
fn e4_beale_and_tin_when_f_cancels() {
    let draws = [(1.0, 1.0), (-1.0, 3.0), (0.0, 2.0), (0.0, 2.0)];
    assert_close(run(Beale, &draws, 1.0).value, -0.04, 1e-16, "Beale");
    assert_close(run(Tin, &draws, 1.0).value, -1.0 / 24.0, 1e-16, "Tin");
}

#[test]
fn e5_beale_and_tin_do_not_square_small_auxiliaries() {
    for scale in [1e-25, 1e-100, 1e100] {
        let draws = [(1.0, scale), (2.0, 3.0 * scale), (4.0, 2.0 * scale)];
        let unit = [(1.0, 1.0), (2.0, 3.0), (4.0, 2.0)];
        for (ours, right) in [
            (run(Beale, &draws, scale).value, run(Beale, &unit, 1.0).value),
            (run(Tin, &draws, scale).value, run(Tin, &unit, 1.0).value),
        ] {
            assert_close(ours, right, 1e-14, "scale free");
        }
    }
    // Where h² itself underflows in f64, the flags say that the plain mean was taken.
    let flagged = run(Beale, &[(1.0, 1e-200), (2.0, 3e-200)], 1e-200);
    assert!(flagged.value == 1.5 && flagged.flags.contains(Flags::UNDERFLOW) && flagged.flags.fell_back());
    let tiny = run(Beale, &[(1.0_f32, 1e-25_f32), (2.0, 3e-25), (4.0, 2e-25)], f64::from(1e-25_f32));
    assert_close(tiny.value, run(Beale, &[(1.0, 1.0), (2.0, 3.0), (4.0, 2.0)], 1.0).value, 1e-6, "f32");
}

/// Found by fuzzing: with c = ȳ/x̄ of 1e160 the square of c·h is infinite, and no flag said why the error was unknown.
#[test]
fn an_error_whose_square_leaves_the_range_is_unknown_and_flagged() {
    let far = ratio(&[(1e150, 1.0), (1e150, -1.0 + 1e-10)], 1.0);
    assert!(far.value > 1e160 && far.std_error.is_nan(), "{far:?}");
    assert!(far.flags.contains(Flags::OVERFLOW), "{far:?}");
}

/// Found by fuzzing: errors of two folds were added up as squares, which left the range.
#[test]
fn errors_of_folds_are_as_large_as_any() {
    let draws: Vec<_> = (0..40).map(|i| (f64::from(i * i % 7), 1.0 + f64::from(i % 5))).collect();
    let error = |integral: f64| run(CrossFitted(RegressionRatio::default()), &draws, integral).std_error;
    assert!(error(1e120) > 1e118);
    assert_close(error(1e200) / error(1e120), 1e80, 1e68, "an error of 1e199 beside one of 1e119");
}

/// Found by fuzzing: where squares of an auxiliary are infinite the spread of a black channel is unknown, and the
/// ratios, all 0, had an error of 0.
#[test]
fn a_black_channel_has_no_error_bar_in_a_mean_of_ratios() {
    type Both<V> = Blocked<V, Joined<ComomentsBlock<V>, UnivariateBlock<RatioOf<V>, 1>>>;
    for h in [1e200, 1e300, f64::MAX / 4.0, 1e-300] {
        let draws = [(0.0, h), (0.0, -h), (0.0, 2.0)].map(|(f, h)| Draw::new(f, h));
        let black = run_on(&MeanOfRatios, |_| Both::default(), &draws, [1.0]);
        assert!(black.value == 0.0 && black.std_error.is_nan(), "{black:?}");
        assert!(black.flags.contains(Flags::NO_SUPPORT), "{black:?}");
    }
}

/// h = ±u about 0, u the least number: its squares vanish and its sum cancels, but its products with f do not. They were
/// once taken for a slope of 10⁴⁵, and the spread of f for twenty times what it is; now it is unknown, and flagged.
#[test]
fn squares_that_vanish_are_seen_by_their_products() {
    let u = f32::from_bits(1);
    let mut moments = Comoments::<f32>::default();
    for i in 0..55 {
        let [f, h] = [[0.0, 0.0], [0.0, 0.0], [u, u], [2.0, -u], [1.25, 0.0]][i % 5];
        moments.add(Draw::new(f, h));
    }
    let spread = moments.closed().channel(0).comoments();
    assert!(spread.hh[0][0].is_nan() && spread.ff().is_nan(), "{spread:?}");
    let plain = Plain.estimate_anyway(&moments, &Integrals::ONE);
    assert_close(plain.value, 0.65, 1e-6, "the mean");
    for estimate in [plain, RatioOfMeans.estimate_anyway(&moments, &Integrals::ONE)] {
        assert!(estimate.std_error.is_nan() && estimate.flags(0).contains(Flags::UNDERFLOW), "{estimate:?}");
    }
}
