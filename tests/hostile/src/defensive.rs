//! Defensive ratios and regressions.

use crate::bytes::{Bytes, Reach, draws};
use crate::truth::Truth;
use ratiocv_core::moments::{Accumulate, Comoments, Merge};
use ratiocv_core::{
    ChannelEstimate, CrossFitted, Difference, Draw, Estimator, Fit, Flags, HartleyRoss, Integrals, MeanOfRatios,
    Mickey, OptimalDefensive, Plain, RandomMixture, RatioOfMeans, Reads, RegressionRatio, Scalar,
};

/// The defensive ratio is H·ȳ/(εH + (1−ε)x̄) but for rounding, and never unbounded where h and H are not negative; powers
/// of H/x̄ are the plain mean, the ratio and the product for 0, 1 and −1; fitted exponents and weights stay within
/// their limits; all are numbers wherever the plain mean is one.
pub fn defensive(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let kind = bytes.byte();
    let reach = [Reach::Moderate, Reach::Finite, Reach::Moderate, Reach::Any][usize::from(kind >> 1 & 3)];
    if kind & 1 == 0 { of::<f32>(&mut bytes, reach) } else { of::<f64>(&mut bytes, reach) }
}

fn of<S: Scalar>(bytes: &mut Bytes<'_>, reach: Reach) {
    let weight = [0.01, 0.5, 0.999, 1e-9][bytes.below(4)];
    let positive = bytes.byte() & 1 == 0;
    let mut integral = if bytes.byte() & 3 == 0 { 1.0 } else { bytes.number::<f64>(reach) };
    let mut points = bytes.points::<S, 2>(reach, 80);
    if positive {
        integral = integral.abs();
        points.iter_mut().for_each(|[_, h]| *h = h.abs());
    }
    let draws: Vec<Draw<S>> = draws(&points);
    let integrals = Integrals::new([integral]);
    let plain = Plain.estimate_anyway(&added(Comoments::<S>::default(), &draws), &integrals).channel(0);

    macro_rules! each {
        ($($estimator:expr),* $(,)?) => {$(
            let moments = added($estimator.error_bar::<S>(&integrals), &draws);
            let estimate = $estimator.estimate_anyway(&moments, &integrals).channel(0);
            is_sound(estimate, plain, &format!("{:?}, H = {integral:e}", $estimator));
        )*};
    }
    let ratio = RatioOfMeans.defensive(weight).expect("a weight");
    let ratios = MeanOfRatios.defensive(weight).expect("a weight");
    let hartley_ross = HartleyRoss.defensive(weight).expect("a weight");
    let mickey = Mickey.defensive(weight).expect("a weight");
    each!(ratio, ratios, hartley_ross, mickey, Difference::default(), RegressionRatio::default());
    each!(OptimalDefensive::<RatioOfMeans>::default(), RandomMixture::<RatioOfMeans>::default());
    // Its plain mean is put together from two folds, and a fold alone may overflow.
    let folds = CrossFitted(Difference::default());
    let folded = folds.estimate_anyway(&added(folds.error_bar::<S>(&integrals), &draws), &integrals).channel(0);
    is_sound(folded, ChannelEstimate { value: f64::NAN, ..plain }, "cross-fitted");

    let moments = added(Comoments::<S>::default(), &draws);
    let defended = ratio.estimate_anyway(&moments, &integrals).channel(0);
    if reach == Reach::Moderate {
        is_right::<S>(defended, &points, weight, integral);
        let unbounded = hartley_ross.estimate_anyway(&added(hartley_ross.error_bar(&integrals), &draws), &integrals);
        let sure = positive && integral > 0.0;
        assert!(!(sure && unbounded.flags(0).contains(Flags::UNBOUNDED_RATIO)), "it is defended: {unbounded:?}");
        assert!(!(sure && defended.flags.contains(Flags::DENOM_ZERO)), "it is defended: {defended:?}");
    }
    powers(&moments, &integrals, plain, weight);

    let alpha = RegressionRatio::default().learn(&moments, &integrals).coefficients[0];
    assert!((-1.0..=2.0).contains(&alpha), "α = {alpha}");
    let optimal = OptimalDefensive::<RatioOfMeans>::default();
    let weight = optimal.learn(&moments, &integrals).coefficients[0];
    assert!((0.0..=1.0 - optimal.floor + 4.0 * f64::EPSILON).contains(&weight), "a = {weight}");
}

fn added<D: Copy, M: Accumulate<D> + Merge>(mut moments: M, draws: &[D]) -> M {
    draws.iter().for_each(|draw| moments.add(*draw));
    moments
}

fn is_sound(ours: ChannelEstimate, plain: ChannelEstimate, what: &str) {
    let ChannelEstimate { value, std_error, flags } = ours;
    let about = || format!("{what}: {ours:?}; plain {plain:?}");
    assert!(!plain.value.is_finite() || value.is_finite(), "the plain mean is a number: {}", about());
    assert!(value.is_finite() || value.is_nan() && flags.contains(Flags::NONFINITE), "{}", about());
    assert!(std_error.is_nan() || (0.0..f64::INFINITY).contains(&std_error), "{}", about());
    if flags.fell_back() && plain.value.is_finite() {
        assert_eq!(value.to_bits(), plain.value.to_bits(), "it fell back, but not to the plain mean: {}", about());
    }
}

/// The defensive ratio from exact means.
fn is_right<S: Scalar>(ours: ChannelEstimate, points: &[[f64; 2]], weight: f64, integral: f64) {
    let numbers = |entry: usize| -> Vec<f64> { points.iter().map(|point| point[entry]).collect() };
    let (f, h) = (Truth::new(&numbers(0)), Truth::new(&numbers(1)));
    let (mean_f, mean_h) = (f.sum.over(&f.count), h.sum.over(&h.count));
    let denominator = weight * integral + (1.0 - weight) * mean_h;
    let size = (weight * integral).abs() + mean_h.abs();
    let lost = (h.mean_tolerance::<S>() + 8.0 * f64::EPSILON * size) / denominator.abs();
    if integral == 0.0 || lost.is_nan() || lost >= 0.1 {
        return;
    }
    let right = mean_f / denominator * integral;
    let allowed = f.mean_tolerance::<S>() / denominator.abs() * integral.abs() + 2.0 * lost * right.abs();
    let off = (ours.value - right).abs();
    assert!(off <= allowed + 16.0 * f64::EPSILON * right.abs(), "{ours:?} should be {right:e} ± {allowed:e}");
}

/// Given exponents.
fn powers<S: Scalar>(moments: &Comoments<S>, integrals: &Integrals<S>, plain: ChannelEstimate, any: f64) {
    let power = |alpha: f64| RegressionRatio::default().fixed([alpha]).estimate_anyway(moments, integrals).channel(0);
    let ratio = RatioOfMeans.estimate_anyway(moments, integrals).channel(0);
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
    assert!(same(power(0.0).value, plain.value), "α = 0: {:?}, plain {plain:?}", power(0.0));
    assert!(same(power(1.0).value, ratio.value), "α = 1: {:?}, ratio {ratio:?}", power(1.0));
    for alpha in [-1.0, 0.5, 2.0, any] {
        is_sound(power(alpha), plain, &format!("α = {alpha}"));
    }
    if !ratio.flags.fell_back() && plain.value != 0.0 && (1e-9..1e9).contains(&plain.value.abs()) {
        let quotient = ratio.value / plain.value;
        if quotient < -1e-9 {
            assert!(power(0.5).flags.contains(Flags::DENOM_SIGN), "a root of {quotient}");
        } else if (1e-9..1e9).contains(&quotient) {
            let off = (power(0.5).value * power(0.5).value / (ratio.value * plain.value) - 1.0).abs();
            assert!(off <= 1e-12, "α = ½: {:?} for {ratio:?}", power(0.5));
            let off = (power(-1.0).value * ratio.value / (plain.value * plain.value) - 1.0).abs();
            assert!(off <= 1e-12, "α = −1: {:?} for {ratio:?}", power(-1.0));
        }
    }
}
