use ratiocv_core::moments::{Accumulate, Comoments};
use ratiocv_core::{ChannelEstimate, Draw, Error, Estimator, Flags, Integrals, RatioOfIntegrals};
use ratiocv_tests::assert_close;

fn run<const K: usize>(draws: &[Draw<f64, K>], integrals: [f64; K]) -> ChannelEstimate {
    let mut moments = Comoments::<f64, K>::default();
    draws.iter().for_each(|draw| moments.add(*draw));
    RatioOfIntegrals.estimate_anyway(&moments, &Integrals::new(integrals)).channel(0)
}

/// d = 2 + p, c = 3 + q, f = 6 + 5p + q + e with p = (−1, 0, 0, 1), q = (1, −1, −1, 1), e = (0, 1, −1, 0): f̄ = 6,
/// d̄ = 2, R̂ = 3; z = f − 3d has 2p + q + e.
const DRAWS: [Draw<f64, 2>; 4] = [
    Draw { f: 2.0, h: [1.0, 4.0] },
    Draw { f: 6.0, h: [2.0, 2.0] },
    Draw { f: 4.0, h: [2.0, 2.0] },
    Draw { f: 12.0, h: [3.0, 4.0] },
];

#[test]
fn by_hand() {
    // f̄ = 6; γ = Σqz/Σq² = 4/4: R̂ − γ(c̄ − C)/d̄ = 3 + 1·(1/2)/2. Residuals 2p + e: 8 + 2, with 2 degrees of
    // freedom, over 4·d̄²; C is ½ away from c̄: ×(1 + 4·¼/4).
    let ours = run(&DRAWS, [f64::NAN, 3.5]);
    assert_close(ours.value, 3.25, 1e-15, "value");
    // The distance of d̄ from its own value is 0.
    assert_close(ours.std_error, (10.0 / 3.0 / 4.0 * (3.0 / 2.0) * 1.25_f64).sqrt() / 2.0, 1e-14, "error");
    assert!(!ours.flags.fell_back(), "{ours:?}");
    // d with q/2 more: z has −q/2, γ = −½.
    let along = [1.5, 1.5, 1.5, 3.5];
    let turned: Vec<_> = DRAWS.iter().zip(along).map(|(draw, d)| Draw { f: draw.f, h: [d, draw.h[1]] }).collect();
    assert_close(run(&turned, [f64::NAN, 3.5]).value, 3.0 - 0.5 * 0.5 / 2.0, 1e-15, "a control that knows d");
    // Without controls: f̄/d̄, residuals 2p + q + e.
    let bare = run(&DRAWS.map(|Draw { f, h: [d, _] }| Draw { f, h: [d] }), [f64::NAN]);
    assert_close(bare.value, 3.0, 1e-15, "no controls");
    assert_close(bare.std_error, (14.0_f64 / 12.0).sqrt() / 2.0, 1e-14, "its error");
}

/// f = 5d + 2(c − C): exact, whatever d does.
#[test]
fn exact_where_the_controls_explain_it() {
    let mut noise = ratiocv_tests::samples::Noise(3);
    let draws: Vec<_> = (0..50)
        .map(|_| (1.0 + noise.next_unit(), noise.next_unit()))
        .map(|(d, c)| Draw { f: 5.0 * d + 2.0 * (c - 0.5), h: [d, c] })
        .collect();
    let ours = run(&draws, [f64::NAN, 0.5]);
    // γ comes from z = f − R̂d with R̂ ≠ 5: what it misses is of second order, (R̂ − 5)·s_dc.
    let bare = run(&draws.iter().map(|draw| draw.auxiliary(0)).collect::<Vec<_>>(), [f64::NAN]);
    assert!((ours.value - 5.0).abs() <= 0.1 * (bare.value - 5.0).abs(), "{ours:?}, {bare:?}");
    assert!(ours.std_error <= 0.1 * bare.std_error);
}

#[test]
fn undefined_ratios() {
    let zero = run(&[Draw { f: 1.0, h: [1.0, 1.0] }, Draw { f: 2.0, h: [-1.0, 2.0] }], [f64::NAN, 1.0]);
    assert!(zero.value.is_nan() && zero.std_error.is_nan() && zero.flags.contains(Flags::DENOM_ZERO), "{zero:?}");
    let bad = run(&DRAWS, [f64::NAN, 0.0]);
    assert!(bad.value.is_nan() && bad.flags.contains(Flags::BAD_INTEGRAL), "{bad:?}");
    let nan = run(&[Draw { f: f64::NAN, h: [1.0] }, Draw { f: 2.0, h: [1.0] }], [f64::NAN]);
    assert!(nan.value.is_nan() && nan.flags.contains(Flags::NONFINITE), "{nan:?}");
    let mut one = Comoments::<f64>::default();
    one.add(Draw::new(3.0, 2.0));
    let error = RatioOfIntegrals.estimate(&one, &Integrals::new([f64::NAN])).unwrap_err();
    assert_eq!(error, Error::TooFewDraws { estimator: "ratio_of_integrals", needed: 2, got: 1 });
    let anyway = run(&[Draw { f: 3.0, h: [2.0] }], [f64::NAN]);
    assert!(anyway.value == 1.5 && anyway.std_error.is_nan() && anyway.flags.contains(Flags::ONE_SAMPLE), "{anyway:?}");
    // A control that is constant in the draws changes nothing.
    let constant = run(&DRAWS.map(|Draw { f, h: [d, _] }| Draw { f, h: [d, 7.0] }), [f64::NAN, 7.0]);
    assert_close(constant.value, 3.0, 1e-15, "a constant control");
    // Nor does the place of d in the integrals.
    assert_eq!(run(&DRAWS, [0.0, 3.5]).value, run(&DRAWS, [f64::NAN, 3.5]).value);
}
