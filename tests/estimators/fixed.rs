//! Coefficients that are given, or learned from a pilot.

use crate::ladder::{ASYMMETRIC, CORRELATED, INTEGRAL};
use ratiocv_core::moments::{Accumulate, ComomentsState, Groups, Moments};
use ratiocv_core::moments::{Comoments, Sums};
use ratiocv_core::{
    ChannelEstimate, Choose, Difference, Draw, Error, Estimator, Fit, Fixed, Flags, Integrals, Jackknife, Mickey,
    OptimalDefensive, Plain, RandomMixture, RatioOfMeans, Regression, RegressionRatio, Spectrum,
};
use ratiocv_tests::assert_close;
use ratiocv_tests::samples::{Noise, filled};

fn run<E: Estimator<ComomentsState<f64>>>(estimator: E, draws: &[(f64, f64)], integral: f64) -> ChannelEstimate {
    let moments = filled(Comoments::<f64>::default(), draws.iter().copied());
    estimator.estimate(&moments, &Integrals::new([integral])).expect("draws").channel(0)
}

fn power(alpha: f64) -> Fixed<RegressionRatio, f64> {
    RegressionRatio::default().fixed([alpha])
}

/// ȳ = 4, x̄ = 2, H = 3; s_yy = 38/3, s_xy = 1/3, s_xx = 2/3; c = 2α.
#[test]
fn powers_by_hand() {
    let error = |alpha: f64| ((38.0 - 4.0 * alpha + 8.0 * alpha * alpha) / 12.0).sqrt();
    for (alpha, value) in
        [(0.5, 4.0 * 1.5_f64.sqrt()), (2.0, 9.0), (-1.0, 8.0 / 3.0), (-2.0, 16.0 / 9.0), (0.3, 4.0 * 1.5_f64.powf(0.3))]
    {
        let ours = run(power(alpha), &ASYMMETRIC, INTEGRAL);
        assert_close(ours.value, value, 2e-15 * value, &format!("α = {alpha}"));
        // And how far the power is from 4 + 2α·(3 − 2).
        let std_error = error(alpha).hypot(value - 4.0 - 2.0 * alpha);
        assert_close(ours.std_error, std_error, 1e-14, &format!("error, α = {alpha}"));
    }
}

#[test]
fn alpha_0_is_plain_and_1_the_ratio_to_the_bit() {
    let mut noise = Noise(71);
    for _ in 0..100 {
        let draws: Vec<_> = noise.draws::<f64>(9).into_iter().map(|draw| (draw.f, draw.h[0])).collect();
        let integral = 0.5 + noise.next_unit();
        let same = |a: ChannelEstimate, b: ChannelEstimate| {
            assert_eq!((a.value.to_bits(), a.std_error.to_bits()), (b.value.to_bits(), b.std_error.to_bits()));
        };
        same(run(power(0.0), &draws, integral), run(Plain, &draws, integral));
        same(run(power(1.0), &draws, integral), run(RatioOfMeans, &draws, integral));
        // −1 is the product: ȳ·x̄/H, rounded twice.
        let (f, h) = draws.iter().fold((0.0, 0.0), |(f, h), d| (f + d.0 / 9.0, h + d.1 / 9.0));
        assert_close(run(power(-1.0), &draws, integral).value, f * h / integral, 1e-14, "the product");
        same(run(Difference::default().fixed([0.0]), &draws, integral), run(Plain, &draws, integral));
    }
}

#[test]
fn undefined_powers_fall_back() {
    let centred = [(1.0, -1.0), (3.0, 1.0)];
    let zero = run(power(0.5), &centred, 1.0);
    assert!(zero.value == 2.0 && zero.flags.contains(Flags::DENOM_ZERO), "{zero:?}");
    // The product does not divide by x̄.
    let product = run(power(-1.0), &centred, 1.0);
    assert!(product.value == 0.0 && !product.flags.fell_back(), "{product:?}");
    let negative = [(1.0, -1.0), (3.0, -2.0)];
    let fractional = run(power(0.5), &negative, 1.0);
    assert!(fractional.value == 2.0 && fractional.flags.contains(Flags::DENOM_SIGN), "{fractional:?}");
    // A whole power of a negative quotient is a number: 2·(−2/3)².
    assert_close(run(power(2.0), &negative, 1.0).value, 8.0 / 9.0, 1e-15, "a whole power");
}

#[test]
fn differences_and_mixtures_by_hand() {
    // 4 + β(3 − 2); error √((38 − 2β + 2β²)/12).
    for beta in [1.0, -0.75, 2.5] {
        let ours = run(Difference::default().fixed([beta]), &ASYMMETRIC, INTEGRAL);
        assert_close(ours.value, 4.0 + beta, 1e-15, "difference");
        assert_close(ours.std_error, ((38.0 - 2.0 * beta + 2.0 * beta * beta) / 12.0_f64).sqrt(), 1e-14, "its error");
        let chosen = run(Fixed::<Choose, f64>::clone(&learned(beta)), &ASYMMETRIC, INTEGRAL);
        assert_close(chosen.value, 4.0 + beta, 1e-12, "what was chosen is a difference");
    }
    // a = 1/4: x̄′ = 3/4 + 1/4·2/3; c = 4/x̄′·a/3.
    let mean = 0.75 + 0.5 / 3.0;
    let ours = run(<OptimalDefensive>::default().fixed([0.25]), &ASYMMETRIC, INTEGRAL);
    assert_close(ours.value, 4.0 / mean, 4e-15, "optimal defensive ratio");
    let c = 4.0 / mean / 12.0;
    assert_close(ours.std_error, ((38.0 - 2.0 * c + 2.0 * c * c) / 12.0_f64).sqrt(), 1e-14, "its error");
    // Any multiple of the one auxiliary is the ratio of means.
    let ours = run(<RandomMixture>::default().fixed([-2.0]), &ASYMMETRIC, INTEGRAL);
    assert_close(ours.value, 6.0, 4e-15, "random mixture");
}

/// A choice of the difference with the slope `beta`, learned from draws on a line.
fn learned(beta: f64) -> Fixed<Choose, f64> {
    let line = (0..8).map(f64::from).map(|h| (10.0 + beta * h, h));
    Choose::default().learn(&filled(Comoments::<f64>::default(), line), &Integrals::new([3.5]))
}

/// Mickey and the jackknife on a given mixture, against draws of h′ made by hand.
#[test]
fn on_a_given_mixture() {
    let mixed = ASYMMETRIC.map(|(f, h)| (f, 0.75 + 0.25 * h / INTEGRAL));
    let groups = |draws: &[(f64, f64)]| filled(Groups::<f64, 2>::default(), draws.iter().copied());
    let (raw, by_hand) = (groups(&ASYMMETRIC), groups(&mixed));
    let integral = Integrals::new([INTEGRAL]);
    let ours = OptimalDefensive::of(Mickey).fixed([0.25]).estimate(&raw, &integral).unwrap().value;
    assert_close(ours, Mickey.estimate(&by_hand, &Integrals::ONE).unwrap().value, 4e-15, "Mickey");
    let ours = OptimalDefensive::of(Jackknife).fixed([0.25]).estimate(&raw, &integral).unwrap().channel(0);
    let right = Jackknife.estimate(&by_hand, &Integrals::ONE).unwrap().channel(0);
    assert_close(ours.value, right.value, 4e-15, "jackknife");
    assert_close(ours.std_error, right.std_error, 1e-14, "its error");
}

/// β̂ of a pilot, per channel: 2 on CORRELATED unshrunk, 35/18 shrunk; α̂ = β̂·(5/2)/6.
#[test]
fn a_pilot_teaches_each_channel_its_own() {
    let mut pilot = Comoments::<Spectrum<f64, 2>>::default();
    for (f, h) in CORRELATED {
        pilot.add(Draw::new(Spectrum([f, 1.0 - 2.0 * f]), Spectrum([h, h])));
    }
    let integrals = Integrals::new([Spectrum([4.0, 4.0])]);
    let unshrunk = Regression { shrink: false, ..Regression::default() };
    let [beta] = Difference { regression: unshrunk }.learn(&pilot, &integrals).coefficients;
    assert_close(beta[0], 2.0, 1e-15, "β̂");
    assert_close(beta[1], -4.0, 1e-15, "β̂ of the other channel");
    let learned = Difference::default().learn(&pilot, &integrals);
    assert_close(learned.coefficients[0][0], 35.0 / 18.0, 1e-15, "shrunk");
    assert_close(learned.coefficients[0][1], -35.0 / 9.0, 1e-14, "shrunk");
    let [alpha] = RegressionRatio::default().learn(&pilot, &integrals).coefficients;
    assert_close(alpha[0], 175.0 / 216.0, 1e-15, "α̂");
    // One draw of another pixel: 7 + 35/18·(4 − 1), −35/9 in the other channel.
    let mut pixel = Sums::<Spectrum<f64, 2>>::default();
    pixel.add(Draw::new(Spectrum([7.0, 9.0]), Spectrum([1.0, 3.0])));
    let estimate = learned.estimate(&pixel, &integrals).unwrap();
    assert_close(estimate.value[0], 7.0 + 35.0 / 6.0, 1e-14, "first channel");
    assert_close(estimate.value[1], 9.0 - 35.0 / 9.0, 1e-14, "second channel");
    assert!(estimate.flags(0).contains(Flags::ONE_SAMPLE) && estimate.std_error[0].is_nan());
}

#[test]
fn no_draws_are_too_few() {
    let nothing = Comoments::<f64>::default();
    let error = power(0.5).estimate(&nothing, &Integrals::ONE).unwrap_err();
    assert!(matches!(error, Error::TooFewDraws { needed: 1, got: 0, .. }), "{error}");
    let anyway = power(0.5).estimate_anyway(&nothing, &Integrals::ONE);
    assert!(anyway.value.is_nan() && anyway.flags(0).contains(Flags::EMPTY));
    assert_eq!(nothing.count(), 0);
}
