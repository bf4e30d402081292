//! The stopping rule: its radius by hand, its refusals, and its error under peeking.

use ratiocv_core::moments::{Accumulate, Blocked, Comoments, ComomentsBlock, ExtremesBlock, Joined};
use ratiocv_core::{
    Draw, Error, Estimate, Estimator, Flags, Integrals, Lanes, Plain, RatioOfMeans, Reads, Scalar, Spectrum, Stopping,
};
use ratiocv_tests::assert_close;
use ratiocv_tests::samples::Noise;

const RULE: Stopping = Stopping { alpha: 0.05, burn_in: 1, tightest: 100, absolute: 0.0, relative: 0.1 };

/// An estimate without flags.
fn estimate<V: Lanes>(value: V::Wide, std_error: V::Wide) -> Estimate<V> {
    let mut moments = Comoments::<V>::default();
    for f in [1.0, 2.0] {
        moments.add(Draw::new(V::splat(V::Scalar::from_f64(f)), V::ONE));
    }
    let mut estimate = Plain.estimate(&moments, &Integrals::ONE).expect("two draws");
    (estimate.value, estimate.std_error) = (value, std_error);
    estimate
}

fn scalar(value: f64, std_error: f64) -> Estimate<f64> {
    estimate(value, std_error)
}

#[test]
fn radii_are_those_of_the_formula() {
    // √((1 + 1/t)(log(1 + t) + d)), t = N(d + log(1 + d))/tightest, d = −2 log(α/M): mpmath, 25 digits.
    for (count, width) in [(100, 3.035_208_990_376_253), (7, 4.244_255_350_498_663), (5000, 3.465_200_978_483_295)] {
        let radius = RULE.decide(&scalar(1.0, 0.25), count).unwrap().radius;
        assert_close(radius, 0.25 * width, 1e-15 * width, "one channel");
    }
    let rule = Stopping { alpha: 0.01, tightest: 1000, ..RULE };
    let rgb = estimate::<Spectrum<f32, 3>>(Spectrum([1.0; 3]), Spectrum([1.0, 0.5, f64::NAN]));
    let radius = rule.decide(&rgb, 400).unwrap().radius;
    assert_close(radius[0], 3.959_293_196_644_088, 4e-15, "channel 0 of three");
    assert_eq!(radius[1], 0.5 * radius[0]);
    assert!(radius[2].is_nan());
}

#[test]
fn the_radius_is_tightest_where_it_was_asked_to_be() {
    let at = |tightest, count| Stopping { tightest, ..RULE }.decide(&scalar(1.0, 1.0), count).unwrap().radius;
    for count in [1, 100, 12_345, 1 << 40] {
        let best = at(count, count);
        for other in [count / 2, count * 2, count * 10] {
            assert!(other == 0 || best < at(other, count), "{other} at {count}");
        }
        assert_close(best, 3.035, 5e-4, "3.04 standard errors");
    }
}

#[test]
fn targets_hold_for_every_integral_in_the_interval() {
    let width = RULE.decide(&scalar(1.0, 1.0), 100).unwrap().radius;
    let met =
        |rule: Stopping, value: f64, radius: f64| rule.decide(&scalar(value, radius / width), 100).unwrap().all_met();
    // |F̂ − F| ≤ |F|/10 for all F in 22 ± 2, but not in 21 ± 2, where F may be 19.
    for sign in [1.0, -1.0] {
        assert!(met(RULE, sign * 22.1, 2.0) && !met(RULE, sign * 21.9, 2.0));
    }
    let absolute = Stopping { absolute: 2.0, relative: 0.0, ..RULE };
    assert!(met(absolute, 0.1, 1.999) && !met(absolute, 0.1, 2.001) && !met(absolute, 1e9, 2.001));
    // The larger of the two counts.
    let either = Stopping { absolute: 2.0, ..RULE };
    assert!(met(either, 0.0, 1.999) && met(either, 100.0, 9.0) && !met(either, 100.0, 9.2));
}

#[test]
fn it_never_stops_before_the_burn_in_nor_on_an_unknown_error() {
    let rule = Stopping { burn_in: 64, ..RULE };
    let decide = |std_error, count| rule.decide(&scalar(1.0, std_error), count).unwrap();
    assert!(!decide(0.0, 63).all_met() && decide(0.0, 63).radius.is_nan());
    assert!(decide(0.0, 64).all_met() && decide(0.0, 64).radius == 0.0);
    assert!(!decide(1e-9, 0).all_met() && !decide(1e-9, 63).all_met() && decide(1e-9, 64).all_met());
    for unknown in [f64::NAN, f64::INFINITY] {
        assert!(!decide(unknown, 1000).all_met());
    }
    assert!(!rule.decide(&scalar(f64::NAN, f64::NAN), 1000).unwrap().all_met());
}

/// Whether a lax rule stops on the ratio of `count` draws, and the flags.
fn on(count: u64, draw: impl Fn(u64) -> (f64, f64)) -> (bool, Flags) {
    let mut moments = Blocked::<f64, Joined<ComomentsBlock<f64>, (), (), ExtremesBlock<f64>>>::default();
    for i in 0..count {
        let (f, h) = draw(i);
        moments.add(Draw::new(f, h));
    }
    let estimate = RatioOfMeans.estimate_anyway(&moments, &Integrals::ONE);
    let rule = Stopping { absolute: 1e3, ..RULE };
    (rule.decide(&estimate, count).unwrap().all_met(), estimate.flags(0))
}

#[test]
fn it_never_stops_on_an_error_bar_that_cannot_be_trusted() {
    assert_eq!(on(0, |_| (1.0, 1.0)), (false, Flags::EMPTY));
    assert!(!on(1, |_| (1.0, 1.0)).0);
    // All black; a denominator within its own error; one that a single draw makes; an f that one makes;
    // a wrong H.
    let h = |i: u64| 0.5 + (i % 11) as f64 / 10.0;
    for (flag, (met, flags)) in [
        (Flags::NO_SUPPORT, on(1000, |i| (0.0, h(i)))),
        (Flags::DENOM_ILL, on(1000, |i| (1.0, if i % 2 == 0 { 51.0 } else { -49.0 }))),
        (Flags::LOW_ESS, on(1000, |i| (h(i), if i == 0 { 900.0 } else { 0.1 }))),
        (Flags::HEAVY_TAIL, on(1000, |i| (if i == 0 { 100.0 } else { 1.0 }, h(i)))),
        (Flags::AUX_MISMATCH, on(1000, |i| (h(i) * h(i), 1.5 * h(i)))),
    ] {
        assert!(flags.contains(flag) && !met, "{flag}: {flags}");
    }
    // Flags that do not concern the error bar; the same draws with the right H.
    assert_eq!(on(1100, |i| (h(i) * h(i), h(i))), (true, Flags::NONE));
    assert_eq!(on(1000, |i| (h(i), 0.0)), (true, Flags::DENOM_ZERO));
}

#[test]
fn channels_are_judged_one_by_one() {
    let rgb = estimate::<Spectrum<f64, 3>>(Spectrum([1.0, 1.0, 1.0]), Spectrum([0.01, 0.1, f64::NAN]));
    let decision = RULE.decide(&rgb, 100).unwrap();
    assert_eq!([0, 1, 2].map(|channel| decision.met(channel)), [true, false, false]);
    assert!(!decision.all_met());
}

#[test]
fn bad_parameters_are_named() {
    let named = |rule: Stopping| match rule.decide(&scalar(1.0, 1.0), 100) {
        Err(Error::Parameter { parameter, .. }) => parameter,
        other => panic!("{rule:?}: {other:?}"),
    };
    for alpha in [0.0, 1.0, -0.1, 1.5, f64::NAN] {
        assert_eq!(named(Stopping { alpha, ..RULE }), "alpha");
    }
    assert_eq!(named(Stopping { burn_in: 0, ..RULE }), "burn_in");
    assert_eq!(named(Stopping { burn_in: 101, ..RULE }), "tightest");
    assert_eq!(named(Stopping { burn_in: 0, tightest: 0, ..RULE }), "burn_in");
    for bad in [-1.0, f64::INFINITY, f64::NAN] {
        assert_eq!(named(Stopping { absolute: bad, ..RULE }), "absolute");
        assert_eq!(named(Stopping { relative: bad, ..RULE }), "relative");
    }
    let error = Stopping { relative: 0.0, ..RULE }.decide(&scalar(1.0, 1.0), 100).unwrap_err();
    assert_eq!(
        error.to_string(),
        "relative is 0 and must be above 0 where absolute is 0: no error bar falls to 0 by more draws"
    );
}

const RUNS: u64 = 10_000;

/// α + 3√(α(1−α)/10⁴): three standard errors above what is allowed, one chance in 740.
fn allowed(alpha: f64) -> f64 {
    alpha + 3.0 * (alpha * (1.0 - alpha) / RUNS as f64).sqrt()
}

/// A standard normal number (Box, Muller 1958).
fn normal(noise: &mut Noise) -> f64 {
    (-2.0 * (1.0 - noise.next_unit()).ln()).sqrt() * (core::f64::consts::TAU * noise.next_unit()).cos()
}

#[test]
fn gaussian_increments_of_known_variance_are_covered_at_every_look_from_the_first() {
    let (mut noise, mut wrong, mut misled) = (Noise(1), 0, 0);
    let mut estimate = scalar(0.0, 1.0);
    for _ in 0..RUNS {
        let (mut sum, mut outside, mut peeked) = (0.0, false, false);
        for count in 1..=2000_u32 {
            let n = f64::from(count);
            sum += normal(&mut noise);
            (estimate.value, estimate.std_error) = (sum / n, 1.0 / n.sqrt());
            let radius = RULE.decide(&estimate, u64::from(count)).unwrap().radius;
            let within = |radius| estimate.value.abs() <= radius; // false for NaN
            outside |= !within(radius);
            peeked |= !within(1.96 * estimate.std_error);
        }
        wrong += u64::from(outside);
        misled += u64::from(peeked);
    }
    let [wrong, misled] = [wrong, misled].map(|runs| runs as f64 / RUNS as f64);
    println!("Gaussian: {wrong} outside at some of 2000 looks (α = 0.05), {misled} outside 1.96 standard errors");
    assert!(wrong <= allowed(RULE.alpha), "{wrong}");
    // Neither does the rule waste its α, nor does the naive interval pass by luck.
    assert!(wrong >= 0.5 * RULE.alpha && misled > 10.0 * RULE.alpha, "{wrong}, {misled}");
}

/// Of many runs of one estimator.
#[derive(Clone, Copy, Debug, Default)]
struct Runs {
    /// F was outside the interval of some channel at some look.
    outside: u64,
    /// Stopped at an error above the target.
    wrong: u64,
    /// Never stopped.
    endless: u64,
    /// F was outside 1.96 standard errors of channel 0 at some look.
    misled: u64,
}

/// Plain and the defensive ratio on f = h(0.2 + v²), h and v uniform on [½, 1½) and [0, 1): bounded
/// and skewed, every channel its own.
fn under_peeking<V: Lanes>(rule: &Stopping, seed: u64) -> [Runs; 2] {
    let f = 0.2 + 1.0 / 3.0;
    let ratio = RatioOfMeans.defensive(0.01).unwrap();
    let (mut noise, mut runs) = (Noise(seed), [Runs::default(); 2]);
    for _ in 0..RUNS {
        let mut moments = Comoments::<V>::default();
        let mut run = [(false, None, false); 2];
        for count in 1..=2048 {
            let h = V::from_fn(|_| V::Scalar::from_f64(0.5 + noise.next_unit()));
            let v = V::from_fn(|_| V::Scalar::from_f64(noise.next_unit()));
            moments.add(Draw::new(h * (V::splat(V::Scalar::from_f64(0.2)) + v * v), h));
            if count < rule.burn_in || count % 16 > 0 {
                continue;
            }
            let estimates =
                [Plain.estimate_anyway(&moments, &Integrals::ONE), ratio.estimate_anyway(&moments, &Integrals::ONE)];
            for (estimate, (outside, stopped, misled)) in estimates.iter().zip(&mut run) {
                let decision = rule.decide(estimate, count).unwrap();
                let within = |channel, radius| (estimate.channel(channel).value - f).abs() <= radius;
                *outside |= !(0..V::LANES).all(|channel| within(channel, decision.radius.get(channel)));
                *misled |= !within(0, 1.96 * estimate.channel(0).std_error);
                if stopped.is_none() && decision.all_met() {
                    *stopped = Some((0..V::LANES).all(|channel| within(channel, rule.relative * f)));
                }
            }
        }
        for (runs, (outside, stopped, misled)) in runs.iter_mut().zip(run) {
            runs.outside += u64::from(outside);
            runs.wrong += u64::from(stopped == Some(false));
            runs.endless += u64::from(stopped.is_none());
            runs.misled += u64::from(misled);
        }
    }
    runs
}

#[test]
fn bounded_laws_are_covered_under_peeking_from_the_burn_in() {
    let rule = Stopping { alpha: 0.05, burn_in: 64, tightest: 500, absolute: 0.0, relative: 0.1 };
    let limit = allowed(rule.alpha) * RUNS as f64;
    for (channels, runs) in
        [("one channel", under_peeking::<f64>(&rule, 2)), ("RGB", under_peeking::<Spectrum<f32, 3>>(&rule, 3))]
    {
        for (estimator, runs) in ["plain", "ratio"].iter().zip(runs) {
            println!("{estimator}, {channels}: {runs:?} of {RUNS}");
            assert!(runs.outside as f64 <= limit && runs.wrong <= runs.outside, "{estimator}, {channels}: {runs:?}");
            assert_eq!(runs.endless, 0);
            // Peeking at a normal interval fails the same check by far.
            assert!(runs.misled as f64 > 5.0 * limit, "{estimator}, {channels}: {runs:?}");
        }
    }
}
