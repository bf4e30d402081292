use ratiocv_core::moments::{Accumulate, GroupedPairs, Merge, Pairs};
use ratiocv_core::{ChannelEstimate, DeterministicMixture, Draw, Estimator, Flags, Integrals};
use ratiocv_tests::assert_close;

fn moments(draws: &[Pairs<f64, 2>]) -> GroupedPairs<f64, 2, 8> {
    let mut moments = GroupedPairs::default();
    draws.iter().for_each(|pairs| moments.add(*pairs));
    moments
}

fn run(draws: &[Pairs<f64, 2>], integrals: [f64; 2]) -> ChannelEstimate {
    DeterministicMixture.estimate_anyway(&moments(draws), &Integrals::new(integrals)).channel(0)
}

fn pairs(a: (f64, f64), b: (f64, f64)) -> Pairs<f64, 2> {
    Pairs([Draw::new(a.0, a.1), Draw::new(b.0, b.1)])
}

fn three() -> [Pairs<f64, 2>; 3] {
    [pairs((1.0, 2.0), (4.0, 1.0)), pairs((3.0, 2.0), (0.0, 3.0)), pairs((2.0, 1.0), (5.0, 4.0))]
}

#[test]
fn by_hand() {
    // 10·6/5 + 2·9/8. Leave-one-out totals: 10·5/3 + 2·5/7, 10·3/3 + 2·9/5, 10·4/4 + 2·4/4; 2/3·Σ(t − t̄)².
    let ours = run(&three(), [10.0, 2.0]);
    assert_close(ours.value, 12.0 + 2.25, 1e-14, "value");
    let totals = [50.0 / 3.0 + 10.0 / 7.0, 10.0 + 18.0 / 5.0, 12.0];
    let mean = totals.iter().sum::<f64>() / 3.0;
    let variance = totals.iter().map(|t| (t - mean).powi(2)).sum::<f64>() * 2.0 / 3.0;
    // Pseudovalues are about the jackknifed value, n·t − Σ(1 − 1/n)t₍₋ᵢ₎: for groups of one size the same.
    assert_close(ours.std_error, variance.sqrt(), 1e-14, "jackknife of the total");
    assert_eq!(ours.flags, Flags::NONE);
}

/// Two parts that share all their noise: their errors add up, or cancel; variances of the parts would not tell.
#[test]
fn parts_share_their_draws() {
    let x = |i: u32| 1.0 + f64::from(i % 7) / 7.0;
    let same: Vec<_> = (0..64).map(|i| pairs((x(i), 1.0), (x(i), 1.0))).collect();
    let opposed: Vec<_> = (0..64).map(|i| pairs((x(i), 1.0), (3.0 - x(i), 1.0))).collect();
    let alone: Vec<_> = (0..64).map(|i| pairs((x(i), 1.0), (0.0, 1.0))).collect();
    let alone = run(&alone, [1.0, 1.0]).std_error;
    assert_close(run(&same, [1.0, 1.0]).std_error, 2.0 * alone, 1e-12, "twice");
    assert_close(run(&opposed, [1.0, 1.0]).std_error, 0.0, 1e-13, "cancelled");
}

/// E13: a technique that was never hit.
#[test]
fn a_technique_without_draws() {
    let draws = three().map(|Pairs([a, _])| Pairs([a, Draw::new(0.0, 0.0)]));
    let unhit = run(&draws, [10.0, 2.0]);
    assert_close(unhit.value, 12.0, 1e-14, "a part that is 0 everywhere is 0");
    assert_eq!(unhit.flags, Flags::NONE);
    // Its integrand was seen, though: the part's plain mean, 9/3, and a flag.
    let lost = run(&three().map(|Pairs([a, b])| Pairs([a, Draw::new(b.f, 0.0)])), [10.0, 2.0]);
    assert_close(lost.value, 12.0 + 3.0, 1e-14, "the plain mean");
    assert!(lost.flags.contains(Flags::DENOM_ZERO), "{lost:?}");
    // A part that one draw alone has seen is 0 without it: leave-one-out totals 62/3, 10 and 14.
    let once = [pairs((1.0, 2.0), (0.0, 0.0)), pairs((3.0, 2.0), (2.0, 1.0)), pairs((2.0, 1.0), (0.0, 0.0))];
    let once = run(&once, [10.0, 2.0]);
    assert_close(once.value, 12.0 + 4.0, 1e-14, "value");
    assert_close(once.std_error, 56.0 / 9.0, 1e-14, "its error");
    // Where without it f is left and h is 0 there is no leave-one-out: the error is unknown.
    let orphan = [pairs((1.0, 2.0), (1.0, 0.0)), pairs((3.0, 2.0), (2.0, 1.0)), pairs((2.0, 1.0), (0.0, 0.0))];
    let orphan = run(&orphan, [10.0, 2.0]);
    assert!((orphan.value - 18.0).abs() <= 1e-14 && orphan.std_error.is_nan(), "{orphan:?}");
}

/// E16: weights that sum to 0.9 are a bias of exactly that, not a fault that estimates could hide.
#[test]
fn weights_are_taken_as_they_are() {
    let draws = |scale: f64| -> Vec<_> {
        (0..40)
            .map(|i| Draw { f: 1.0 + f64::from(i % 3), h: [1.0 + f64::from(i % 5), 2.0 + f64::from(i % 7)] })
            .map(|draw| Pairs::weighted(draw, [0.25 * scale, 0.75 * scale]))
            .collect()
    };
    let (whole, part) = (run(&draws(1.0), [3.0, 5.0]), run(&draws(0.9), [3.0, 5.0]));
    assert_close(part.value, 0.9 * whole.value, 1e-14, "Σw");
    // A weight of 0 hides what is no number.
    let hidden = Pairs::weighted(Draw { f: f64::INFINITY, h: [1.0, 1.0] }, [0.0, 0.0]);
    assert_eq!(hidden.0[0].f, 0.0);
}

#[test]
fn bad_integrals_and_few_draws() {
    for bad in [0.0, f64::NAN, f64::NEG_INFINITY] {
        let ours = run(&three(), [10.0, bad]);
        assert_close(ours.value, 12.0 + 3.0, 1e-14, "that part's plain mean");
        assert!(ours.flags.contains(Flags::BAD_INTEGRAL));
    }
    let one = run(&three()[..1], [10.0, 2.0]);
    assert!(one.value == 13.0 && one.std_error.is_nan() && one.flags.contains(Flags::ONE_SAMPLE), "{one:?}");
    let nothing = run(&[], [10.0, 2.0]);
    assert!(nothing.value.is_nan() && nothing.flags.contains(Flags::EMPTY));
    let black = run(&[pairs((0.0, 1.0), (0.0, 2.0)); 4], [1.0, 1.0]);
    assert!(black.value == 0.0 && black.std_error.is_nan() && black.flags.contains(Flags::NO_SUPPORT), "{black:?}");
    let nan = run(&[pairs((f64::NAN, 1.0), (1.0, 2.0)); 4], [1.0, 1.0]);
    assert!(nan.value.is_nan() && nan.std_error.is_nan() && nan.flags.contains(Flags::NONFINITE), "{nan:?}");
}

#[test]
fn split_at_every_index() {
    let draws: Vec<_> = (0..150)
        .map(|i| pairs((f64::from(i * 7 % 31), 1.0 + f64::from(i % 5)), (f64::from(i % 11), 2.0 + f64::from(i % 7))))
        .collect();
    let whole = run(&draws, [3.0, 5.0]);
    for at in 0..=draws.len() {
        let mut merged = moments(&draws[..at]);
        merged.merge(&moments(&draws[at..]));
        let merged = DeterministicMixture.estimate_anyway(&merged, &Integrals::new([3.0, 5.0])).channel(0);
        assert_close(merged.value, whole.value, 1e-14 * whole.value, "value");
        assert_close(merged.std_error, whole.std_error, 1e-12 * whole.std_error, "error");
    }
}
