//! Ratios whose denominators are degenerate.

use crate::bytes::{Bytes, Reach, draws};
use crate::truth::{Truth, epsilon};
use num_traits::float::FloatCore;
use ratiocv_core::moments::{
    Accumulate, Blocked, ComomentsBlock, ExtremesBlock, GroupsBlock, HasMeans, Joined, Moments, RatioOf,
    UnivariateBlock,
};
use ratiocv_core::{
    Beale, ChannelEstimate, Draw, Estimator, Flags, HartleyRoss, Integrals, Jackknife, Lanes, MeanOfRatios, Mickey,
    Plain, Quenouille, RatioOfMeans, Scalar, Spectrum, Tin, conformance,
};

type All<V> =
    Blocked<V, Joined<ComomentsBlock<V>, UnivariateBlock<RatioOf<V>, 1>, GroupsBlock<V, 8>, ExtremesBlock<V>>>;

type Pair<S> = Spectrum<S, 2>;

/// Every ratio estimator on denominators that are 0, of both signs, tiny, infinite or NaN, beside an innocent channel:
/// a number wherever the plain mean is one, and that mean, flagged, where the formula is undefined; the ratio of
/// means exact but for rounding; the innocent channel's bits unchanged; unknown errors NaN, never 0.
pub fn denominators(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let kind = bytes.byte();
    let reach = [Reach::Moderate, Reach::Finite, Reach::Any, Reach::Moderate][usize::from(kind >> 1 & 3)];
    if kind & 1 == 0 { of::<f32>(&mut bytes, reach) } else { of::<f64>(&mut bytes, reach) }
}

fn of<S: Scalar>(bytes: &mut Bytes<'_>, reach: Reach) {
    let integral = if bytes.byte() & 3 == 0 { 1.0 } else { bytes.number::<f64>(reach) };
    let points = bytes.points::<S, 2>(reach, 100);
    let mut lanes: Vec<Draw<Pair<S>>> = draws(&points);
    let innocent = |i: usize| [2.0 + (i % 5) as f64, 1.0 + (i % 3) as f64];
    for (i, draw) in lanes.iter_mut().enumerate() {
        let [f, h] = innocent(i).map(S::from_f64);
        (draw.f[1], draw.h[0][1]) = (f, h);
    }
    let harmless: Vec<Draw<Pair<S>>> =
        lanes.iter().map(|draw| Draw::new(Spectrum([draw.f[1]; 2]), Spectrum([draw.h[0][1]; 2]))).collect();
    let add = |draws: &[Draw<Pair<S>>]| {
        let mut moments = All::<Pair<S>>::default();
        draws.iter().for_each(|draw| moments.add(*draw));
        moments.closed()
    };
    let (hostile, harmless) = (add(&lanes), add(&harmless));
    let integrals = Integrals::new([Spectrum([integral, 1.5])]);
    let plain = Plain.estimate_anyway(&hostile, &integrals).channel(0);
    let of_channel = |estimate: ratiocv_core::Estimate<Pair<S>>, harmless: ratiocv_core::Estimate<Pair<S>>| {
        let [ours, right] = [estimate.channel(1), harmless.channel(1)];
        let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
        let untouched =
            same(ours.value, right.value) && same(ours.std_error, right.std_error) && ours.flags == right.flags;
        assert!(untouched, "the innocent channel: {ours:?}, alone {right:?}");
        estimate.channel(0)
    };
    macro_rules! each {
        ($($estimator:expr),*) => {$(
            let estimate = of_channel(
                $estimator.estimate_anyway(&hostile, &integrals),
                $estimator.estimate_anyway(&harmless, &integrals),
            );
            is_sound::<S>(estimate, plain, &points, integral, &format!("{:?}, H = {integral:e}", $estimator));
        )*};
    }
    each!(RatioOfMeans, Quenouille, Beale, Tin, MeanOfRatios, HartleyRoss, Mickey, Jackknife);
    if reach < Reach::Any {
        let estimate = RatioOfMeans.estimate_anyway(&hostile, &integrals).channel(0);
        is_right::<S>(estimate, hostile.channel(0).means(hostile.count()).h[0], &points, integral);
    }
    let empty = |_: &Integrals<Pair<S>>| All::<Pair<S>>::default();
    // Some thirty passes over the draws.
    if points.len() <= 8 {
        let alone = conformance::bad_channel_is_alone(&Tin, &empty, &lanes, points.len() % 2, &integrals);
        assert_eq!(alone, Ok(()));
    }
}

/// What holds for every ratio estimator and any draws.
fn is_sound<S: Scalar>(ours: ChannelEstimate, plain: ChannelEstimate, points: &[[f64; 2]], integral: f64, what: &str) {
    let about = || format!("{what}: {ours:?}; plain {plain:?}");
    let ChannelEstimate { value, std_error, flags } = ours;
    assert!(!plain.value.is_finite() || value.is_finite(), "the plain mean is a number: {}", about());
    assert!(value.is_nan() || value.is_finite(), "{}", about());
    assert!(!value.is_nan() || flags.contains(Flags::NONFINITE), "{}", about());
    assert!(std_error.is_nan() || (0.0..f64::INFINITY).contains(&std_error), "{}", about());
    if flags.fell_back() && plain.value.is_finite() {
        assert_eq!(value.to_bits(), plain.value.to_bits(), "it fell back, but not to the plain mean: {}", about());
    }
    let why = Flags::OVERFLOW | Flags::UNDERFLOW | Flags::NONFINITE | Flags::NO_SUPPORT | Flags::EMPTY;
    assert!(!std_error.is_nan() || points.len() == 1 || flags & why != Flags::NONE, "an unknown error: {}", about());
    let bad = integral == 0.0 || !integral.is_finite();
    assert_eq!(flags.contains(Flags::BAD_INTEGRAL), bad, "{}", about());
    assert_eq!(flags.contains(Flags::ONE_SAMPLE), points.len() == 1, "{}", about());
    if points.len() == 1 {
        assert!(std_error.is_nan(), "the error of one draw: {}", about());
    }
    let is = |entry: usize, test: fn(f64) -> bool| points.iter().all(|point| test(point[entry]));
    if is(0, |f| f == 0.0) && is(1, f64::is_finite) {
        // Where h or its squares left the range, squares of f are unknown too.
        let unseen = flags & why != Flags::NONE;
        assert!(unseen && value == 0.0 && std_error.is_nan(), "black: {}", about());
    }
    let unbounded = points.iter().any(|[f, h]| *h == 0.0 && *f != 0.0);
    let ordinary = |[f, h]: &[f64; 2]| f.abs() < 1e6 && (*h == 0.0 || (1e-7..1e7).contains(&h.abs()));
    if flags.contains(Flags::UNBOUNDED_RATIO) && points.iter().all(ordinary) {
        assert!(unbounded, "no f/h is unbounded: {}", about());
    }
    if is(1, |h| h == 0.0) && !is(0, |f| f == 0.0) && is(0, f64::is_finite) {
        // Squares below the range, or groups that cancel, cannot be told from black.
        let least = 2.0 * libm::sqrt(Lanes::widen(<S as FloatCore>::min_positive_value()) / epsilon::<S>());
        let told = points.iter().any(|[f, _]| f.abs() >= least) && !(what.starts_with("Jackknife") && points.len() > 8);
        let black = flags.contains(Flags::NO_SUPPORT) && value == 0.0 && std_error.is_nan();
        assert!(flags.fell_back() || !told && black, "h was 0 in every draw: {}", about());
    }
}

/// H·Σf/Σh as far as the digits of the means go, or a flag.
fn is_right<S: Scalar>(ours: ChannelEstimate, mean_h: f64, points: &[[f64; 2]], integral: f64) {
    let numbers = |entry: usize| -> Vec<f64> { points.iter().map(|point| point[entry]).collect() };
    let (f, h) = (Truth::new(&numbers(0)), Truth::new(&numbers(1)));
    let ChannelEstimate { value, flags, .. } = ours;
    if h.sum.is_zero() && !f.sum.is_zero() {
        assert!(!flags.is_empty() || points.len() < 3, "Σh is 0, and no flag says so: {ours:?}");
    }
    if flags.fell_back() {
        let mean = h.sum.over(&h.count);
        let reason = integral == 0.0
            || !integral.is_finite()
            || mean_h == 0.0
            || !mean_h.is_finite()
            || mean.abs() <= h.mean_tolerance::<S>()
            || !ours.value.is_finite()
            || f.range > 1e30
            || f.most > 1e30
            || f.most / mean.abs() * integral.abs() > 1e300;
        assert!(reason, "no reason to fall back: {ours:?}, mean of h {mean_h:e}");
        return;
    }
    let (mean_f, mean_h) = (f.sum.over(&f.count), h.sum.over(&h.count));
    let lost = h.mean_tolerance::<S>() / mean_h.abs();
    if lost.is_nan() || lost >= 0.1 {
        return;
    }
    let ratio = f.sum.over(&h.sum);
    let right = ratio * libm::ldexp(integral, -64);
    if right.is_nan()
        || right.abs() >= libm::ldexp(f64::MAX, -64)
        || right.abs() < 1e-280
        || mean_f.abs() < 1e-280
        || mean_h.abs() < 1e-280
        || ratio.abs() < 1e-280
        || integral.abs() < 1e-280
    {
        return;
    }
    let allowed = f.mean_tolerance::<S>() / mean_f.abs() + 2.0 * lost + 8.0 * f64::EPSILON;
    let off = (libm::ldexp(value, -64) - right).abs() / right.abs();
    assert!(
        off <= allowed * (1.0 + allowed),
        "{value:e} is off by {off:e}, allowed {allowed:e}: {ours:?}, ε {}",
        epsilon::<S>()
    );
}
