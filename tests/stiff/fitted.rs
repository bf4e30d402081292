//! The rows that belong to estimators with coefficients: one auxiliary.

use crate::cases::{run, run_on};
use ratiocv_core::moments::{Accumulate, Comoments, Moments, Widened};
use ratiocv_core::{
    ChannelEstimate, Choose, CrossFitted, Dependent, Difference, Draw, Estimator, Fit, Flags, Integrals, Jackknife,
    Mickey, OptimalDefensive, Plain, RandomMixture, RatioOfMeans, Reads, Regression, RegressionRatio, Scalar, Spectrum,
};
use ratiocv_tests::assert_close;

const UNSHRUNK: Regression = Regression { shrink: false, dependent: Dependent::MinimumNorm };

fn free_ratio() -> RegressionRatio {
    RegressionRatio { regression: UNSHRUNK, ..RegressionRatio::default() }
}

/// ȳ(H/x̄)^α, α given, beside innocent channels with the same α.
fn power(alpha: f64, draws: &[(f64, f64)], integral: f64) -> ChannelEstimate {
    let draws: Vec<_> = draws.iter().map(|(f, h)| Draw::new(*f, *h)).collect();
    let estimator = RegressionRatio::default().fixed([alpha]);
    run_on(&estimator, |_| Comoments::<Spectrum<f64, 3>>::default(), &draws, [integral])
}

/// Every estimator of this file, on one case.
fn all(draws: &[(f64, f64)], integral: f64) -> Vec<(&'static str, ChannelEstimate)> {
    fn one<E>(estimator: E, draws: &[(f64, f64)], integral: f64) -> (&'static str, ChannelEstimate)
    where
        E: Reads + Estimator<<E::ErrorBar<Spectrum<f64, 3>> as Moments>::Channel>,
    {
        (E::ID, run(estimator, draws, integral))
    }
    vec![
        one(Difference::default(), draws, integral),
        one(RegressionRatio::default(), draws, integral),
        one(<RandomMixture>::default(), draws, integral),
        one(<OptimalDefensive>::default(), draws, integral),
        one(OptimalDefensive::of(Mickey), draws, integral),
        one(Choose::default(), draws, integral),
        one(Jackknife, draws, integral),
        one(CrossFitted(Difference::default()), draws, integral),
        one(CrossFitted(OptimalDefensive::of(Mickey)), draws, integral),
        one(CrossFitted(Choose::default()), draws, integral),
    ]
}

#[test]
fn a11_a12_a_bad_integral_concerns_its_channel_alone() {
    let draws = [(1.0, 1.0), (4.0, 2.0), (2.0, 1.5), (6.0, 2.5), (3.0, 0.5), (2.0, 3.0)];
    for integral in [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (id, case) in all(&draws, integral) {
            assert_close(case.value, 3.0, 1e-15, id);
            assert!(case.flags.contains(Flags::BAD_INTEGRAL), "{id}: {case:?}");
        }
    }
}

#[test]
fn a13_negative_auxiliaries_are_as_good() {
    let draws: Vec<_> = (0..30).map(|i| f64::from(i % 3 + 1)).map(|x| (x, -x)).collect();
    // h and H change their signs: nothing changes. f ∝ h and h̄ = H: 2, but for Mickey on 0.01 + 0.99h/H.
    let positive: Vec<_> = draws.iter().map(|(f, h)| (*f, -h)).collect();
    for ((id, case), (_, right)) in all(&draws, -2.0).into_iter().zip(all(&positive, 2.0)) {
        assert_eq!((case.value, case.flags), (right.value, right.flags), "{id}");
        assert!(id.contains("optimal_defensive_mickey") || (case.value - 2.0).abs() <= 1e-14, "{id}: {case:?}");
        assert!(!case.flags.fell_back() && !case.flags.contains(Flags::NEGATIVE), "{id}: {case:?}");
    }
    // H = −3: 3, but for the floor of the optimal defensive: f̄ = 2, h̄/H = 2/3: 2/(0.01 + 0.66).
    for (id, case) in all(&draws, -3.0).into_iter().filter(|(id, _)| !id.contains("mickey")) {
        let right = if id == "optimal_defensive_ratio" { 2.0 / 0.67 } else { 3.0 };
        assert_close(case.value, right, 1e-13, id);
    }
}

#[test]
fn a14_a_fractional_power_of_a_negative_quotient() {
    let a14 = power(0.5, &[(1.0, -1.0), (2.0, -0.5), (6.0, 0.0)], 1.0);
    assert_eq!((a14.value, a14.flags & Flags::DENOM_SIGN), (3.0, Flags::DENOM_SIGN));
    assert_close(a14.std_error, (7.0_f64 / 3.0).sqrt(), 1e-15, "the plain mean's");
}

/// f = s·h: α = 1 and β = s, whatever the scales; right, or flagged, in f32 blocks, and right in f64 blocks.
fn proportional_beyond_f32(draws: [(f32, f32); 2], integral: f32, value: f32) {
    let (integral, value) = (f64::from(integral), f64::from(value));
    // Four draws go straight to f64; more are summed in f32.
    for count in [4, 200] {
        let many: Vec<_> = (0..count).map(|i| draws[i % 2]).collect();
        let mut wide = Widened::<f32, Comoments<f64>>::default();
        many.iter().for_each(|(f, h)| wide.add(Draw::new(*f, *h)));
        let integrals = Integrals::new([integral]);
        for wide in [
            RegressionRatio::default().estimate(&wide, &integrals),
            Difference::default().estimate(&wide, &integrals),
            Choose::default().estimate(&wide, &integrals),
            <RandomMixture>::default().estimate(&wide, &integrals),
        ] {
            assert_close(wide.expect("draws").value, value, 1e-6 * value, "f64 blocks");
        }
        for narrow in [
            run(RegressionRatio::default(), &many, integral),
            run(Difference::default(), &many, integral),
            run(Choose::default(), &many, integral),
            run(<RandomMixture>::default(), &many, integral),
        ] {
            let flagged = narrow.flags.contains(Flags::OVERFLOW) || narrow.flags.contains(Flags::UNDERFLOW);
            assert!(flagged || (narrow.value - value).abs() <= 1e-6 * value, "{narrow:?} should be {value}");
        }
    }
}

#[test]
fn b1_b2_b3_alpha_is_one_whatever_the_scales() {
    proportional_beyond_f32([(1e20, 1e20), (3e20, 3e20)], 1e20, 1e20);
    proportional_beyond_f32([(1e-25, 1e-25), (3e-25, 3e-25)], 1e-25, 1e-25);
    // β = 10⁶⁰ is beyond f32, α = 1 is not.
    proportional_beyond_f32([(1e30, 1e-30), (3e30, 3e-30)], 1e-30, 1e30);
    let mut wide = Widened::<f32, Comoments<f64>>::default();
    [(1e30, 1e-30), (3e30, 3e-30)].iter().for_each(|(f, h)| wide.add(Draw::new(*f, *h)));
    let [alpha] = free_ratio().learn(&wide, &Integrals::new([1e-30])).coefficients;
    assert_close(alpha, 1.0, 1e-7, "α first");
    // In f64, squares beyond the range are flagged.
    for scale in [1e200, 1e-200] {
        let beyond = [(scale, scale), (3.0 * scale, 3.0 * scale), (2.0 * scale, 2.0 * scale)];
        for (id, case) in all(&beyond, scale).into_iter().take(4) {
            let flagged = case.flags.contains(Flags::OVERFLOW) || case.flags.contains(Flags::UNDERFLOW);
            assert!(flagged && case.value.is_finite() && case.std_error.is_nan(), "{id}: {case:?}");
        }
    }
}

#[test]
fn b8_a_weak_channel_is_fitted_as_if_it_were_alone() {
    fn alone<S: Scalar>(strong: f64) {
        let x = |i: usize| 0.5 + (i * 7 % 16) as f64 / 16.0;
        let mut both = Comoments::<Spectrum<S, 3>>::default();
        let mut solo = Comoments::<S>::default();
        for i in 0..100 {
            let (f, h) = (S::from_f64(1e-6 * (x(i) + x(3 * i + 1))), S::from_f64(x(i)));
            let other = S::from_f64(strong * x(i + 5));
            both.add(Draw::new(Spectrum([other, f, S::ONE]), Spectrum([h, h, other])));
            solo.add(Draw::new(f, h));
        }
        let (three, one) = (Integrals::new([Spectrum([1.0; 3])]), Integrals::ONE);
        let pairs = [
            (Difference::default().estimate(&both, &three), Difference::default().estimate(&solo, &one)),
            (RegressionRatio::default().estimate(&both, &three), RegressionRatio::default().estimate(&solo, &one)),
            (Choose::default().estimate(&both, &three), Choose::default().estimate(&solo, &one)),
        ];
        for (both, solo) in pairs {
            let (ours, right) = (both.expect("draws").channel(1), solo.expect("draws").channel(0));
            assert_eq!(ours.value.to_bits(), right.value.to_bits());
            assert_eq!(ours.std_error.to_bits(), right.std_error.to_bits());
        }
    }
    alone::<f32>(1e6);
    alone::<f64>(1e6);
    alone::<f64>(1e60);
}

#[test]
fn c9_a_constant_auxiliary_leaves_the_plain_mean() {
    let draws: Vec<_> = (0..40).map(|i| (f64::from(i * 7 % 11) / 3.0, 0.7)).collect();
    let plain = run(Plain, &draws, 0.7);
    for (id, case) in all(&draws, 0.7) {
        // Folds and groups add up means of parts.
        let apart = id.contains("mickey") || id.contains("cross") || id == "choose_unbiased" || id == "jackknife";
        assert_close(case.value, plain.value, if apart { 8e-15 } else { 0.0 }, id);
        assert_eq!(case.flags, Flags::NONE, "{id}");
    }
}

#[test]
fn c10_proportional_draws_are_exact() {
    let draws: Vec<_> = (0..40).map(|i| 0.25 + f64::from(i * 7 % 11)).map(|h| (2.0 * h, h)).collect();
    for (id, case) in all(&draws, 3.0).into_iter().filter(|(id, _)| !id.contains("optimal_defensive")) {
        assert_close(case.value, 6.0, 4e-14, id);
        assert!(case.std_error <= 2e-14, "{id}: {case:?}");
    }
}

#[test]
fn d9_two_draws_leave_no_degree_of_freedom() {
    let draws = [(1.0, 1.0), (3.0, 2.0)];
    for case in [
        run(Difference::default(), &draws, 1.7),
        run(Difference { regression: UNSHRUNK }, &draws, 1.7),
        run(RegressionRatio::default(), &draws, 1.7),
        run(free_ratio(), &draws, 1.7),
    ] {
        assert!(case.std_error.is_nan() && case.flags.contains(Flags::ALPHA), "{case:?}");
    }
}

#[test]
fn e6_alpha_from_noise_is_clamped() {
    // f̄ = 10⁻⁹ of ±1 that h = 1 ± 10⁻⁴ follows: free α would be 10¹³.
    let draws: Vec<_> =
        (0..100).map(|i| if i % 2 == 0 { (1.0, 1.0 + 1e-4) } else { (-1.0 + 2e-9, 1.0 - 1e-4) }).collect();
    for estimator in [free_ratio(), RegressionRatio::default()] {
        let case = run(estimator, &draws, 1.5);
        assert!(case.flags.contains(Flags::ALPHA), "{case:?}");
        assert_close(case.value, 1e-9 * 2.25, 1e-15, "α = 2");
    }
}

#[test]
fn e7_alpha_zero_never_asks_for_the_denominator() {
    let zero = power(0.0, &[(1.0, 1.0), (2.0, -1.0)], 1.0);
    assert_eq!((zero.value.to_bits(), zero.std_error), (1.5_f64.to_bits(), 0.5));
    let nan = power(0.0, &[(1.0, f64::NAN), (2.0, 1.0)], 1.0);
    assert_eq!((nan.value, nan.flags & Flags::NONFINITE), (1.5, Flags::NONFINITE));
}

#[test]
fn e8_alpha_one_is_the_ratio_to_the_bit() {
    let mut noise = ratiocv_tests::samples::Noise(8);
    for _ in 0..200 {
        let draws = [0; 5].map(|_| (noise.next_unit(), 0.1 + noise.next_unit()));
        let integral = 0.1 + noise.next_unit();
        let (ours, ratio) = (power(1.0, &draws, integral), run(RatioOfMeans, &draws, integral));
        assert_eq!(ours.value.to_bits(), ratio.value.to_bits());
        assert_eq!(ours.std_error.to_bits(), ratio.std_error.to_bits());
    }
}

/// The four draws that a slope is first fitted to may lie close together in h and fit a steep line by
/// chance; the residuals of what follows would be all rounding.
#[test]
fn few_draws_close_together_teach_no_slope_to_f32() {
    let golden = |x: f64| (x * 0.618_033_988_749_894_9).fract();
    let draw = |i: u32, channel: u32| {
        // Slopes of some 0.5/0.005.
        let near = if i < 4 { 0.02 } else { 1.0 };
        let h = 0.5 + near * golden(f64::from(i * 7919 + channel));
        let f = h * (1.0 + 0.5 * golden(f64::from(i * 104_729 + 31 * channel) + 0.5));
        (f as f32, h as f32)
    };
    for draws in [32, 64, 128, 1000, 4096] {
        let (mut singly, mut batch) = (0.0_f64, 0.0_f64);
        for channel in 0..500 {
            let all: Vec<_> = (0..draws).map(|i| draw(i, channel)).map(|(f, h)| Draw::new(f, h)).collect();
            let mut exact = Widened::<f32, Comoments<f64>>::default();
            let (mut one, mut many) = (Comoments::<f32>::default(), Comoments::<f32>::default());
            exact.add_batch(&all);
            many.add_batch(&all);
            for draw in &all {
                one.add(*draw);
            }
            let exact = RatioOfMeans.estimate(&exact, &Integrals::ONE).unwrap().std_error;
            let error = |moments: &Comoments<f32>| {
                (RatioOfMeans.estimate(moments, &Integrals::ONE).unwrap().std_error / exact - 1.0).abs()
            };
            (singly, batch) = (singly.max(error(&one)), batch.max(error(&many)));
        }
        println!("{draws} draws: {singly:e} singly, {batch:e} in a batch");
        // Of 500 fits to four draws one may be beyond doubt (F > 1000) by chance.
        assert!(singly <= 2e-4 && batch <= 2e-4, "{draws} draws: {singly:e} singly, {batch:e} in a batch");
    }
}
