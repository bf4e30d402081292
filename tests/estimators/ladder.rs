//! The ladder of samples, and what must hold on it for every estimator.

use ratiocv_core::moments::{Accumulate, Merge, Moments};
use ratiocv_core::{ChannelEstimate, Draw, Error, Estimator, Flags, Integrals, Reads};
use ratiocv_tests::assert_close;

/// An estimator that can be run on its own error-bar moments, raw and defensive.
pub(crate) trait Runs: Reads + Estimator<<Self::ErrorBar<f64> as Moments>::Channel> + Copy {}

impl<E: Reads + Estimator<<E::ErrorBar<f64> as Moments>::Channel> + Copy> Runs for E {}

/// f = 1, 2, 4, 9 and h = 1, 3, 2, 2, with H = 3: f̄ = 4, h̄ = 2, s_xx = 2/3, s_xy = 1/3, s_yy = 38/3.
pub(crate) const ASYMMETRIC: [(f64, f64); 4] = [(1.0, 1.0), (2.0, 3.0), (4.0, 2.0), (9.0, 2.0)];
/// The known integral for [`ASYMMETRIC`].
pub(crate) const INTEGRAL: f64 = 3.0;

/// f = 3, 4, 6, 11 and h = 1, 2, 2, 5, with H = 4: f̄ = 6, h̄ = 5/2, s_xx = 3, s_xy = 6, s_yy = 38/3, so that
/// β̂ = 2, of which shrinkage leaves 35/18: 1 − s²/(β̂²·Σ(h − h̄)²) = 1 − 1/36.
pub(crate) const CORRELATED: [(f64, f64); 4] = [(3.0, 1.0), (4.0, 2.0), (6.0, 2.0), (11.0, 5.0)];
/// The known integral for [`CORRELATED`].
pub(crate) const INTEGRAL_OF_CORRELATED: f64 = 4.0;

/// Draws that an auxiliary explains in part, so that coefficients that are fitted to them are not 0.
fn explained_in_part(count: u32) -> impl Iterator<Item = (f64, f64)> {
    (0..count).map(|i| (i * 7 % 31, i * 11 % 23)).map(|(a, b)| (f64::from(a) + 0.5 * f64::from(b), f64::from(b)))
}

/// The estimate from draws, whatever their number.
pub(crate) fn run<E: Runs>(estimator: E, draws: &[(f64, f64)], integral: f64) -> ChannelEstimate {
    let integrals = Integrals::new([integral]);
    estimator.estimate_anyway(&filled(estimator, draws, integral), &integrals).channel(0)
}

fn filled<E: Runs>(estimator: E, draws: &[(f64, f64)], integral: f64) -> E::ErrorBar<f64> {
    let mut moments = estimator.error_bar(&Integrals::new([integral]));
    for (f, h) in draws {
        moments.add(Draw::new(*f, *h));
    }
    moments
}

/// No draw: an error, and NaN with EMPTY from `estimate_anyway`.
pub(crate) fn empty<E: Runs>(estimator: E) {
    let integrals = Integrals::new([INTEGRAL]);
    let error = estimator.estimate(&estimator.error_bar::<f64>(&integrals), &integrals).unwrap_err();
    assert_eq!(error, Error::TooFewDraws { estimator: E::ID, needed: E::MIN_DRAWS, got: 0 });
    assert!(error.to_string().contains(&format!("{} needs at least {} draws", E::ID, E::MIN_DRAWS)));
    let nothing = run(estimator, &[], INTEGRAL);
    assert!(nothing.value.is_nan() && nothing.std_error.is_nan() && nothing.flags.contains(Flags::EMPTY));
}

/// One draw (5, 2): `value`, no error bar; an error only for estimators that need two.
pub(crate) fn one_draw<E: Runs>(estimator: E, value: f64) {
    let integrals = Integrals::new([INTEGRAL]);
    let one = run(estimator, &[(5.0, 2.0)], INTEGRAL);
    assert_close(one.value, value, 1e-15 * value, "one draw");
    assert!(one.std_error.is_nan() && one.flags.contains(Flags::ONE_SAMPLE));
    let strict = estimator.estimate(&filled(estimator, &[(5.0, 2.0)], INTEGRAL), &integrals);
    assert_eq!(strict.is_err(), E::MIN_DRAWS > 1);
}

/// How far from 1 the rounding of an estimator is: the jackknife takes differences of sums of eight times
/// their size and makes error bars of means; mixtures divide by H before they add up.
fn rounding<E: Runs>() -> f64 {
    match E::ID {
        "jackknife" => 16.0,
        "optimal_defensive_ratio" => 4.0,
        _ => 1.0,
    }
}

/// Constants: the exact answer, error 0; to the bit where h = H.
pub(crate) fn constant<E: Runs>(estimator: E) {
    // Folds of one draw have no error bar.
    let counts = if E::ID.starts_with("cross_fitted") || E::ID == "choose_unbiased" {
        [4, 5, 64, 65, 1000]
    } else {
        [2, 3, 64, 65, 1000]
    };
    for count in counts {
        let same = run(estimator, &vec![(0.1, 0.7); count], 0.7);
        // Group sums of a constant are rounded; everything else is exact.
        assert_close(same.value, 0.1, 2e-16 * rounding::<E>(), "h = H");
        assert_close(same.std_error, 0.0, 1e-17 * rounding::<E>(), "error of a constant");
        assert!(!same.flags.fell_back() && !same.flags.contains(Flags::AUX_MISMATCH), "{}", same.flags);
    }
}

/// f ∝ h: the exact answer whatever h does, error 0, for every estimator that reads h.
pub(crate) fn proportional<E: Runs>(estimator: E) {
    let draws: Vec<_> = (0..200).map(|i| f64::from(i * i % 37) / 16.0 + 0.25).map(|h| (2.0 * h, h)).collect();
    let exact = run(estimator, &draws, INTEGRAL);
    assert_close(exact.value, 2.0 * INTEGRAL, 1e-14, "f = 2h");
    assert_close(exact.std_error, 0.0, 1e-15 * rounding::<E>(), "error of f = 2h");
}

/// [`ASYMMETRIC`]: `value` ± `std_error`, worked out by hand; and on the defensive auxiliary the
/// estimate is that of the raw estimator on draws of h′.
pub(crate) fn asymmetric<E: Runs>(estimator: E, value: f64, std_error: f64)
where
    ratiocv_core::Defensive<E>: Runs,
{
    by_hand(estimator, &ASYMMETRIC, INTEGRAL, value, std_error);
    defended(estimator, &ASYMMETRIC, INTEGRAL);
}

/// `value` ± `std_error`, worked out by hand.
pub(crate) fn by_hand<E: Runs>(estimator: E, draws: &[(f64, f64)], integral: f64, value: f64, std_error: f64) {
    let ours = run(estimator, draws, integral);
    assert_close(ours.value, value, 4e-15 * value, "value");
    assert_close(ours.std_error, std_error, 1e-6, "standard error");
}

/// On the defensive auxiliary the estimate is that of the raw estimator on draws of h′.
pub(crate) fn defended<E: Runs>(estimator: E, draws: &[(f64, f64)], integral: f64)
where
    ratiocv_core::Defensive<E>: Runs,
{
    let weight = 0.125;
    let mixed: Vec<_> = draws.iter().map(|(f, h)| (*f, weight * integral + (1.0 - weight) * h)).collect();
    let (defensive, right) =
        (run(estimator.defensive(weight).unwrap(), draws, integral), run(estimator, &mixed, integral));
    assert_close(defensive.value, right.value, 4e-15 * right.value, "defensive value");
    assert_close(defensive.std_error, right.std_error, 4e-15 * right.value, "defensive error");
    assert_eq!(defensive.flags, right.flags);
}

/// The value tier gives the value of the error-bar tier, however it is split, and no error bar.
pub(crate) fn value_tier<E: Runs + Estimator<<E::Value<f64> as Moments>::Channel>>(estimator: E) {
    let draws: Vec<_> = explained_in_part(150).map(|(f, h)| (f + 1.0, h + 2.0)).collect();
    let right = run(estimator, &draws, INTEGRAL);
    let integrals = Integrals::new([INTEGRAL]);
    for at in [0, 1, 17, 75, 150] {
        let part = |draws: &[(f64, f64)]| {
            let mut moments = Reads::value(&estimator, &integrals);
            draws.iter().for_each(|(f, h)| moments.add(Draw::new(*f, *h)));
            moments
        };
        let mut moments = part(&draws[..at]);
        moments.merge(&part(&draws[at..]));
        let ours = Estimator::<<E::Value<f64> as Moments>::Channel>::estimate(&estimator, &moments, &integrals);
        let ours = ours.expect("enough draws");
        assert_close(ours.value, right.value, 1e-14 * right.value.abs(), &format!("value tier, split at {at}"));
        // Where the value takes all that the error bar takes there is but one tier.
        let one_tier = size_of::<E::Value<f64>>() == size_of::<E::ErrorBar<f64>>();
        assert_eq!(ours.std_error.is_nan(), !one_tier, "{}", ours.std_error);
    }
}

/// f and h 1e9 up: the answer keeps all its digits, and the error bar as many as the draws allow.
pub(crate) fn offset<E: Runs>(estimator: E, draws_alike: impl Fn(&[(f64, f64)], f64) -> (f64, f64)) {
    let up: Vec<_> = explained_in_part(300).map(|(f, h)| (1e9 + f, 1e9 + h)).collect();
    let ours = run(estimator, &up, 1e9 + 10.0);
    let (value, std_error) = draws_alike(&up, 1e9 + 10.0);
    assert_close(ours.value, value, 1e-6 * rounding::<E>(), "value at 1e9");
    assert_close(ours.std_error, std_error, 1e-6 * rounding::<E>() * std_error, "error at 1e9");
}

/// Any split, merged: the same estimate to 1e-14.
pub(crate) fn split_everywhere<E: Runs>(estimator: E) {
    let draws: Vec<_> = explained_in_part(150).map(|(f, h)| (f + 1.0, h + 2.0)).collect();
    let whole = run(estimator, &draws, INTEGRAL);
    for at in 0..=draws.len() {
        let (earlier, later) = draws.split_at(at);
        let mut merged = filled(estimator, earlier, INTEGRAL);
        merged.merge(&filled(estimator, later, INTEGRAL));
        let merged = estimator.estimate_anyway(&merged, &Integrals::new([INTEGRAL])).channel(0);
        assert_close(merged.value, whole.value, 1e-14 * whole.value.abs(), &format!("value, split at {at}"));
        assert_close(merged.std_error, whole.std_error, 1e-13 * whole.std_error, &format!("error, split at {at}"));
        assert_eq!(merged.flags, whole.flags);
    }
}

/// NaN and infinities are flagged, and where f is sound the plain mean is returned; zeros of either
/// sign, and subnormal numbers, are numbers.
pub(crate) fn hardly_numbers<E: Runs>(estimator: E) {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for position in [0, 2, 70] {
            let mut draws = vec![(1.0, 2.0); 100];
            draws[position].0 = bad;
            let f = run(estimator, &draws, 2.0);
            assert!(f.value.is_nan() && f.std_error.is_nan() && f.flags.contains(Flags::NONFINITE), "{f:?}");
            draws[position] = (1.0, bad);
            let h = run(estimator, &draws, 2.0);
            // Plain does not read h; all others say that it is bad, and fall back to the plain mean.
            assert!(h.value == 1.0 && (E::ID == "mc" || h.flags.contains(Flags::NONFINITE)), "{h:?}");
        }
    }
    let zero = run(estimator, &[(-0.0, 1.0), (-0.0, 2.0)], 1.5);
    assert!(zero.value.to_bits() == 0 && zero.flags.contains(Flags::NO_SUPPORT) && zero.std_error.is_nan());
    let least = f64::from_bits(1);
    let subnormal = run(estimator, &[(1.0, 4.0 * least), (1.0, 4.0 * least)], 4.0 * least);
    assert_eq!(subnormal.value, 1.0);
}

/// No value is NaN or infinite where the plain mean is a number.
pub(crate) fn near_zero_denominator<E: Runs>(estimator: E) {
    let least = f64::from_bits(1);
    for h in [[0.0, 0.0, 0.0], [1.0, -1.0, 0.0], [least, -least, least], [1.0, -0.5, -0.5], [1e-300, 0.0, 1e300]] {
        for f in [[1.0, 2.0, 3.0], [0.0, 0.0, 0.0], [1e300, -1e300, 1.0]] {
            let draws = [0, 1, 2].map(|i| (f[i], h[i]));
            let estimate = run(estimator, &draws, 1.0);
            assert!(estimate.value.is_finite(), "{draws:?}: {estimate:?}");
            assert!(estimate.std_error.is_nan() || estimate.std_error >= 0.0, "{draws:?}: {estimate:?}");
            let defended = run_defended(estimator, &draws);
            assert!(defended.is_finite(), "{draws:?}: defended {defended}");
        }
    }
    for integral in [0.0, f64::NAN, f64::INFINITY] {
        let bad = run(estimator, &ASYMMETRIC, integral);
        assert!(bad.value == 4.0 && (E::ID == "mc" || bad.flags.contains(Flags::BAD_INTEGRAL)), "{bad:?}");
    }
}

/// The value of the ratio that `E` is, on h′ by hand.
fn run_defended<E: Runs>(estimator: E, draws: &[(f64, f64)]) -> f64 {
    let mixed: Vec<_> = draws.iter().map(|(f, h)| (*f, 0.01 + 0.99 * h)).collect();
    run(estimator, &mixed, 1.0).value
}

/// Value and error of H·ȳ/x̄ from deviations from 1e9, which are exact. All almost unbiased ratios agree
/// with it to 1e-9 relative on the draws of [`offset`].
pub(crate) fn ratio_at_1e9(draws: &[(f64, f64)], integral: f64) -> (f64, f64) {
    let (f, h) = mean_deviations(draws);
    let c = (1e9 + f) / (1e9 + h);
    (c * integral, residual_error(draws, c))
}

/// The means of f and h, less 1e9.
pub(crate) fn mean_deviations(draws: &[(f64, f64)]) -> (f64, f64) {
    let n = draws.len() as f64;
    draws.iter().fold((0.0, 0.0), |(f, h), d| (f + (d.0 - 1e9) / n, h + (d.1 - 1e9) / n))
}

/// The standard error of the mean of f − c·h, by its definition.
pub(crate) fn residual_error(draws: &[(f64, f64)], c: f64) -> f64 {
    let (n, (f, h)) = (draws.len() as f64, mean_deviations(draws));
    let square = |d: &(f64, f64)| (d.0 - 1e9 - f - c * (d.1 - 1e9 - h)).powi(2);
    (draws.iter().map(square).sum::<f64>() / (n - 1.0) / n).sqrt()
}

/// The tests of one estimator, in the fixed order.
macro_rules! ladder {
    ($estimator:ident, one draw $one:expr, by hand $hand:block, at 1e9 $offset:expr) => {
        #[test]
        fn a_empty() {
            crate::ladder::empty($estimator);
        }
        #[test]
        fn b_one_draw() {
            crate::ladder::one_draw($estimator, $one);
        }
        #[test]
        fn c_constant() {
            crate::ladder::constant($estimator);
        }
        #[test]
        fn d_asymmetric_by_hand() {
            $hand
        }
        #[test]
        fn e_offset() {
            crate::ladder::offset($estimator, $offset);
        }
        #[test]
        fn f_split_at_every_index() {
            crate::ladder::split_everywhere($estimator);
            crate::ladder::value_tier($estimator);
        }
        #[test]
        fn g_hardly_numbers() {
            crate::ladder::hardly_numbers($estimator);
        }
        #[test]
        fn h_near_zero_denominator() {
            crate::ladder::near_zero_denominator($estimator);
        }
    };
}
pub(crate) use ladder;
