//! A: denominators that vanish, change sign, or leave the exponent range.

use crate::cases::{ratio, ratio32, run};
use ratiocv_core::moments::{Accumulate, Blocked, ComomentsBlock, ExtremesBlock, Joined, Moments, Sums};
use ratiocv_core::{
    Beale, Draw, Estimator, FallBackWhenIll, Flags, HartleyRoss, Integrals, MeanOfRatios, Mickey, Quenouille,
    RatioOfMeans, Tin,
};
use ratiocv_tests::assert_close;

#[test]
fn a1_a_mean_of_zero_is_undefined() {
    let a1 = ratio(&[(1.0, 1.0), (2.0, -1.0)], 1.0);
    assert_eq!((a1.value, a1.flags & Flags::DENOM_ZERO), (1.5, Flags::DENOM_ZERO));
    assert_eq!(a1.std_error, 0.5); // the plain mean's
}

#[test]
fn a2_an_auxiliary_that_misses_the_support() {
    for zero in [0.0, -0.0] {
        // A4: whatever the sign of the zeros.
        let draws = [(1.0, zero), (2.0, zero), (3.0, zero)];
        for case in [
            ratio(&draws, 1.0),
            run(Quenouille, &draws, 1.0),
            run(Beale, &draws, 1.0),
            run(Tin, &draws, 1.0),
            run(Mickey, &draws, 1.0),
        ] {
            assert_eq!((case.value, case.flags & Flags::DENOM_ZERO), (2.0, Flags::DENOM_ZERO));
        }
        for case in [run(HartleyRoss, &draws, 1.0), run(MeanOfRatios, &draws, 1.0)] {
            assert_eq!((case.value, case.flags & Flags::UNBOUNDED_RATIO), (2.0, Flags::UNBOUNDED_RATIO));
        }
    }
}

#[test]
fn a3_the_black_pixel() {
    let draws = [(0.0, 0.0); 3];
    for case in [ratio(&draws, 1.0), run(Beale, &draws, 1.0), run(HartleyRoss, &draws, 1.0), run(Mickey, &draws, 1.0)] {
        assert_eq!((case.value, case.flags), (0.0, Flags::NO_SUPPORT));
        assert!(case.std_error.is_nan());
    }
    // In the value tier too.
    let mut sums = Sums::<f64>::default();
    sums.add_batch(&[Draw::ZERO; 3]);
    let value = RatioOfMeans.estimate(&sums, &Integrals::ONE).unwrap();
    assert_eq!((value.value, value.flags(0)), (0.0, Flags::NO_SUPPORT));
}

/// Found by fuzzing: the mean of f is below the range, or f cancels where its squares are, and h is 0.
#[test]
fn a3_f_that_cannot_be_told_from_black() {
    let after_nine = |f: [f64; 2], h: f64| -> Vec<_> { [0.0; 9].into_iter().chain(f).map(|f| (f, h)).collect() };
    for draws in
        [after_nine([0.0, 1e-323], 0.0), after_nine([1e-200, -1e-200], 0.0), after_nine([1e-200, -1e-200], 1.0)]
    {
        let case = ratio(&draws, 1.0);
        assert_eq!((case.value, case.flags & Flags::NO_SUPPORT), (0.0, Flags::NO_SUPPORT), "{case:?}");
        assert!(case.std_error.is_nan() && !case.flags.fell_back(), "{case:?}");
    }
    // It can be where squares remain, or are known to have vanished.
    for told in [after_nine([1e-100, -1e-100], 0.0), after_nine([1e-200, 0.0], 0.0)[7..].to_vec()] {
        let told = ratio(&told, 1.0);
        assert!(told.flags.contains(Flags::DENOM_ZERO), "{told:?}");
        assert!(!told.flags.contains(Flags::NO_SUPPORT), "{told:?}");
    }
    // Without squares only auxiliaries tell.
    let sums = |h: f64| {
        let sums = ratiocv_tests::samples::filled(Sums::<f64>::default(), [(1.0, h), (-1.0, h)]);
        RatioOfMeans.estimate(&sums, &Integrals::ONE).unwrap()
    };
    assert_eq!((sums(0.0).value, sums(0.0).flags(0)), (0.0, Flags::NO_SUPPORT));
    assert_eq!((sums(1.0).value, sums(1.0).flags(0)), (0.0, Flags::NONE));
}

/// Squares that vanished are unknown, unless the deviations in a block cancel to the last bit.
#[test]
fn a3_deviations_that_vanish_and_cancel_count_as_none() {
    let squares = |last: f64| crate::cases::squares([1e-200, 1e-200, 1e-200, 1e-200, 1e-200, 2e-200, last]);
    assert!(squares(3e-200).is_nan());
    assert_eq!(squares(0.0), 0.0);
}

#[test]
fn a5_a6_a7_every_order_of_operations_fails_one_of_these() {
    let least = (f32::from_bits(1), f64::from_bits(1));
    assert_eq!(ratio32(&[(1.0, least.0)], f64::from(least.0)).value, 1.0);
    assert_eq!(ratio(&[(1.0, least.1)], least.1).value, 1.0);
    assert_eq!(ratio32(&[(1e-30, 1e-30)], f64::from(1e-30_f32)).value, f64::from(1e-30_f32));
    assert_eq!(ratio(&[(1e-200, 1e-200)], 1e-200).value, 1e-200);
    assert_close(ratio32(&[(1e-30, 1e-10)], 1e38).value, 1e18, 1e18 * 1e-7, "f32, whose inputs are rounded");
    assert_close(ratio(&[(1e-250, 1e-60)], 1e300).value, 1e110, 1e110 * 4e-16, "f64");
}

#[test]
fn a8_a_sum_that_cancels_to_its_last_bit() {
    let tiny = 0.5_f32.powi(25);
    let right = 100_663_296.0; // 3·2^25
    let orders = [
        [1.0, tiny, -1.0],
        [1.0, -1.0, tiny],
        [tiny, 1.0, -1.0],
        [-1.0, 1.0, tiny],
        [tiny, -1.0, 1.0],
        [-1.0, tiny, 1.0],
    ];
    for h in orders {
        let case = ratio32(&h.map(|h| (1.0, h)), 1.0);
        // 8κu of the f64 state, κ = 2^26.
        assert_close(case.value, right, 6e-8 * right, "f32, in any order");
        assert!(case.flags.contains(Flags::DENOM_ILL), "{}", case.flags);
    }
    // In f64 the sum is below the rounding of its terms: no digit is known, and the flags say so.
    for h in [[1.0, 0.5_f64.powi(54), -1.0], [0.5_f64.powi(54), 1.0, -1.0]] {
        let flags = ratio(&h.map(|h| (1.0, h)), 1.0).flags;
        assert!(flags.contains(Flags::DENOM_ILL) || flags.contains(Flags::DENOM_ZERO), "{flags}");
    }
}

/// Co-moments with tails: the diagnostic tier.
type Diagnostic<V> = Blocked<V, Joined<ComomentsBlock<V>, (), (), ExtremesBlock<V>>>;

#[test]
fn a9_an_ill_conditioned_sum() {
    let h = [1.0, -1.0 + 0.5_f32.powi(23)];
    let case = ratio32(&h.map(|h| (1.0, h)), 0.5);
    assert_eq!(case.value, 8_388_608.0);
    assert!(case.flags.contains(Flags::DENOM_ILL));
    assert_eq!(run(FallBackWhenIll(RatioOfMeans), &h.map(|h| (1.0, h)), 0.5).value, 1.0);
    // κ = Σ|h|/|Σh| is known to the diagnostic tier.
    let mut moments = Diagnostic::<f32>::default();
    moments.add_batch(&h.map(|h| Draw::new(1.0, h)));
    let channel = moments.channel(0);
    let tails = ratiocv_core::moments::HasMeans::<1>::tails(&channel).expect("the diagnostic tier keeps tails");
    let kappa = tails.abs_h / (2.0 * ratiocv_core::moments::HasMeans::<1>::means(&channel, 2).h[0]).abs();
    assert_eq!(kappa, 16_777_215.0);
    assert!(RatioOfMeans.estimate(&moments, &Integrals::new([0.5])).unwrap().flags(0).contains(Flags::DENOM_ILL));
}

#[test]
fn a10_sums_of_large_numbers_do_not_overflow() {
    assert_eq!(ratio32(&[(2.0, 1e38); 4], f64::from(1e38_f32)).value, 2.0);
    assert_eq!(ratio(&[(2.0, 1e308); 4], 1e308).value, 2.0);
    assert!(run(Mickey, &[(2.0_f32, 1e38_f32); 100], f64::from(1e38_f32)).flags.fell_back());
    let batch = ratiocv_tests::samples::filled(Sums::<f32>::default(), [(2.0, 1e38); 200]);
    assert_eq!(RatioOfMeans.estimate(&batch, &Integrals::new([f64::from(1e38_f32)])).unwrap().value, 2.0);
}

#[test]
fn a11_a12_a_bad_integral_concerns_its_channel_alone() {
    for integral in [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let draws = [(1.0, 1.0), (4.0, 2.0)];
        for case in [ratio(&draws, integral), run(Beale, &draws, integral), run(HartleyRoss, &draws, integral)] {
            assert_eq!((case.value, case.flags & Flags::BAD_INTEGRAL), (2.5, Flags::BAD_INTEGRAL));
        }
    }
}

#[test]
fn a13_negative_auxiliaries_are_as_good() {
    let case = ratio(&[(1.0, -1.0), (2.0, -2.0), (3.0, -3.0)], -2.0);
    assert_eq!((case.value, case.std_error), (2.0, 0.0));
    assert!(!case.flags.fell_back() && !case.flags.contains(Flags::NEGATIVE), "{}", case.flags);
    // 300 draws: nothing at all to remark.
    let many: Vec<_> = (0..300).map(|i| f64::from(i % 3 + 1)).map(|x| (x, -x)).collect();
    assert_eq!(ratio(&many, -2.0).flags, Flags::NONE);
}

#[test]
fn a15_isolation_when_one_of_four_channels_vanishes() {
    use ratiocv_core::Spectrum;
    let run = |h2: [f64; 2]| {
        let draws = [0, 1].map(|i: usize| {
            let x = 1.0 + i as f64;
            Draw::new(Spectrum([x, 2.0 * x, x, 0.3]), Spectrum([0.9, 1.1 * x, h2[i], 0.7]))
        });
        let mut moments = ratiocv_core::moments::Comoments::default();
        moments.add_batch(&draws);
        RatioOfMeans.estimate(&moments, &Integrals::ONE).unwrap()
    };
    let (vanishing, innocent) = (run([1.0, -1.0]), run([1.0, 1.5]));
    assert_eq!(vanishing.value[2], 1.5);
    for channel in [0, 1, 3] {
        assert_eq!(vanishing.value[channel].to_bits(), innocent.value[channel].to_bits());
        assert_eq!(vanishing.std_error[channel].to_bits(), innocent.std_error[channel].to_bits());
    }
}

#[test]
fn a16_a_denominator_that_creeps_to_zero() {
    let mut noise = ratiocv_tests::samples::Noise(16);
    let draws = (0..1_000_000).map(|_| (1.0, -1.0 + (2.0 + 1e-6) * noise.next_unit()));
    let moments = crate::cases::moments(draws);
    let integral = Integrals::new([5e-7]);
    assert!(RatioOfMeans.estimate(&moments, &integral).unwrap().flags(0).contains(Flags::DENOM_ILL));
    let fallen = FallBackWhenIll(RatioOfMeans).estimate(&moments, &integral).unwrap();
    assert_eq!(fallen.value, 1.0);
}
