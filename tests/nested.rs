//! Path space: paths of any depth as draws, and the ratio inside the integral that is not consistent.

use ratiocv_core::moments::{Accumulate, Comoments, Merge, Moments, Sums};
use ratiocv_core::{
    ChannelEstimate, Draw, Error, Estimator, Flags, HartleyRoss, Integrals, Lanes, Mickey, PathProduct, Plain,
    RatioOfMeans, Reads, ScaledSums, Spectrum,
};
use ratiocv_tests::assert_close;
use ratiocv_tests::enumerate::{Exact, over_groups};
use ratiocv_tests::golden::{First, Nested, Point, Second, seed};
use ratiocv_tests::samples::Noise;

/// A law of single draws, one point for each path of two steps.
fn joint(law: &Nested, draw: impl Fn(&First, &Second, f64) -> Draw<f64>) -> Vec<Point> {
    let mut points = Vec::new();
    for ((first, seconds), h2) in law.stage1.iter().zip(&law.stage2).zip(&law.h2) {
        for second in seconds {
            let Draw { f, h: [h] } = draw(first, second, h2.0);
            points.push(Point { y: f, x: vec![h], p: first.p * second.q, w: vec![] });
        }
    }
    points
}

/// The joint integral of both steps.
fn paths(law: &Nested) -> Vec<Point> {
    joint(law, |first, second, h2| {
        let mut path = PathProduct::<f64>::default();
        path.extend(Draw::new(first.y1, first.x1), &Integrals::new([law.h1.0]));
        path.extend(Draw::new(second.y2, second.x2), &Integrals::new([h2]));
        path.draw()
    })
}

/// The counter-example: a ratio of one draw, H₂·y₂/x₂, in place of the inner integral.
fn ratios_inside(law: &Nested) -> Vec<Point> {
    joint(law, |first, second, h2| Draw::new(first.y1 * h2 * second.y2 / second.x2, first.x1))
}

/// `estimator` over all samples of `n` draws.
fn exact<E>(estimator: E, support: &[Point], n: usize, integral: f64, f: f64) -> Exact
where
    E: Reads + Estimator<<E::ErrorBar<f64> as Moments>::Channel>,
{
    let integrals = Integrals::new([integral]);
    let empty = estimator.error_bar(&integrals);
    over_groups(support, 1, n, f, |groups| {
        let mut moments = empty;
        for i in groups[0] {
            moments.add(Draw::new(support[*i].y, support[*i].x[0]));
        }
        estimator.estimate(&moments, &integrals).map_or(f64::NAN, |estimate| estimate.value)
    })
}

#[test]
fn moments_of_path_space_estimators_are_exact() {
    let (mut compared, mut worst) = (0, 0.0_f64);
    for law in &seed().nested {
        let (joint, inside) = (paths(law), ratios_inside(law));
        for record in &law.results {
            let ours = match record.id.as_str() {
                "path_mc" => exact(Plain, &joint, record.n, 1.0, law.f),
                "path_ratio" => exact(RatioOfMeans, &joint, record.n, 1.0, law.f),
                "path_hartley_ross" => exact(HartleyRoss, &joint, record.n, 1.0, law.f),
                "naive_ratio" => exact(RatioOfMeans, &inside, record.n, law.h1.0, law.f),
                other => panic!("no estimator {other}"),
            };
            let right = [record.expectation, record.bias, record.mse].map(|number| number.expect("a number"));
            let scale = law.f.abs() + right[2].sqrt();
            for (ours, right, scale) in [
                (ours.expectation, right[0], scale),
                (ours.bias, right[1], scale),
                (ours.mse, right[2], right[2] + law.f * law.f),
            ] {
                let error = (ours - right).abs() / scale;
                assert!(error <= 1e-12, "{} N={} {}: {ours:e} should be {right:e}", law.name, record.n, record.id);
                worst = worst.max(error);
            }
            compared += 1;
        }
    }
    println!("{compared} records, worst deviation {worst:e}");
    // Four estimators on two laws at N = 2, 3, 4, 8, 16.
    assert_eq!(compared, 2 * 4 * 5);
}

#[test]
fn the_ratio_inside_the_integral_converges_to_something_else() {
    for law in &seed().nested {
        // E[y₁·H₂·E[y₂/x₂ | first]], since E[x₁] = H₁.
        let limit: f64 = ratios_inside(law).iter().map(|point| point.p * point.y).sum();
        assert_close(limit, law.naive_limit.0, 1e-14 * limit, &law.name);
        assert!(
            (limit / law.f - 1.0).abs() >= 0.1,
            "{}: {limit} is too close to {} to prove anything",
            law.name,
            law.f
        );
        // In path space what is left of the bias at 2N is half of that at N, to first order.
        let bias = |n| exact(RatioOfMeans, &paths(law), n, 1.0, law.f).bias;
        assert!((bias(16) / bias(8) - 0.5).abs() <= 0.05, "{}: {} {}", law.name, bias(8), bias(16));
        let naive = |n| exact(RatioOfMeans, &ratios_inside(law), n, law.h1.0, limit).bias;
        assert!((naive(16) / naive(8) - 0.5).abs() <= 0.05, "{}: {} {}", law.name, naive(8), naive(16));
    }
}

#[test]
fn unbiased_estimators_stay_unbiased_on_paths() {
    for law in &seed().nested {
        for exact in [exact(Mickey, &paths(law), 2, 1.0, law.f), exact(HartleyRoss, &paths(law), 2, 1.0, law.f)] {
            assert!(exact.bias.abs() <= 1e-14 * law.f, "{}: {}", law.name, exact.bias);
        }
    }
}

/// A path of the given steps (f, h, H).
fn path<V: Lanes>(steps: impl IntoIterator<Item = (V, V, V::Wide)>) -> PathProduct<V> {
    let mut path = PathProduct::default();
    for (f, h, integral) in steps {
        path.extend(Draw::new(f, h), &Integrals::new([integral]));
    }
    path
}

/// The ratio of means of `paths` through [`ScaledSums`].
fn scaled<V: Lanes>(paths: impl IntoIterator<Item = PathProduct<V>>) -> ScaledSums<V> {
    let mut sums = ScaledSums::default();
    for path in paths {
        sums.add(path);
    }
    sums
}

#[test]
fn products_are_what_they_say_by_hand() {
    let path = path([(2.0, 3.0, 2.0), (5.0, 1.0, 4.0), (0.5, 8.0, 16.0)]);
    assert_eq!(path.draw(), Draw::new(5.0, 1.5 * 0.25 * 0.5));
    assert_eq!(path.trivial(0), 0);
    assert_eq!(PathProduct::<f64>::default().draw(), Draw::new(1.0, 1.0));
    // Two auxiliaries, each with its integral.
    let mut two = PathProduct::<f64, 2>::default();
    for _ in 0..2 {
        two.extend(Draw { f: 1.5, h: [3.0, 5.0] }, &Integrals::new([2.0, 4.0]));
    }
    assert_eq!(two.draw(), Draw { f: 2.25, h: [2.25, 1.5625] });
    assert_eq!(two.draw().auxiliary(1), Draw::new(2.25, 1.5625));
}

#[test]
fn g1_no_depth_leaves_the_range_on_the_way() {
    for (factor, depth) in [(0.1_f64, 324), (10.0, 324), (0.1, 1000), (1e-300, 1000), (5e-324, 1000)] {
        // Down and up again: 1, though the product was 10⁻³²⁴ and far below on the way.
        let there = (0..depth).map(|_| (factor, factor, 1.0));
        let back = (0..depth).map(|_| (1.0, 1.0, factor)).map(|(_, h, integral)| (1.0, h, integral));
        let Draw { h: [h], .. } = path(there.chain(back)).draw();
        assert_close(h, 1.0, 2.0 * depth as f64 * f64::EPSILON, &format!("{factor:e} at depth {depth}"));
    }
    // What f32 lanes cannot hold, f64 lanes do.
    let steps = |_| (0.1_f32, 10.0_f32, 1.0);
    let narrow = path((0..46).map(steps)).draw();
    assert_eq!((narrow.f, narrow.h[0]), (0.0, f32::INFINITY));
    let wide = path((0..46).map(|_| (0.1_f64, 10.0, 1.0))).draw();
    assert_close(wide.f, 1e-46, 1e-46 * 46.0 * f64::EPSILON, "f");
    assert_close(wide.h[0], 1e46, 1e46 * 46.0 * f64::EPSILON, "h");
}

#[test]
fn a5_a6_a7_a_step_is_divided_whatever_its_size() {
    for (h, integral, right) in [(5e-324, 5e-324, 1.0), (1e-200, 1e-200, 1.0), (1e-250, 1e-300, 1e50)] {
        let draw = path([(h, h, integral)]).draw();
        assert_close(draw.h[0], right, 1e-15 * right, "h/H");
    }
    let far = path([(1e300, 1e300, 1e-300), (1e-300, 1e-300, 1e300)]).draw();
    assert_close(far.f, 1.0, 1e-15, "f");
    assert_close(far.h[0], 1.0, 1e-15, "h");
    let smallest = f32::from_bits(1);
    assert_eq!(path([(smallest, smallest, f64::from(smallest))]).draw(), Draw::new(smallest, 1.0));
}

#[test]
fn g2_few_paths_that_carry_all_weight_are_flagged() {
    // Factors 2U: E[h] = 1, Var = (4/3)^D − 1, so that the effective size is N·(3/4)^D: 64 at D = 20,
    // 0.01 at D = 50.
    for depth in [50, 100] {
        let mut noise = Noise(depth);
        let mut moments = Comoments::<f64>::default();
        let mut sums = ScaledSums::<f64>::default();
        for _ in 0..20_000 {
            let path = path((0..depth).map(|_| 2.0 * noise.next_unit()).map(|h| (h, h, 1.0)));
            moments.add(path.draw());
            sums.add(path);
        }
        let estimate = RatioOfMeans.estimate(&moments, &Integrals::ONE).unwrap();
        assert!(estimate.flags(0).contains(Flags::LOW_ESS), "depth {depth}: {}", estimate.flags(0));
        assert_eq!(sums.ratio_of_means().flags(0), Flags::LOW_ESS, "depth {depth}");
    }
    // A shallow path is not accused: the effective size is 8438.
    let mut noise = Noise(3);
    let shallow = scaled((0..20_000).map(|_| path((0..3).map(|_| 2.0 * noise.next_unit()).map(|h| (h, h, 1.0)))));
    assert_eq!(shallow.ratio_of_means().flags(0), Flags::NONE);
}

#[test]
fn g3_paths_below_the_range_have_a_ratio() {
    // 10⁻⁴⁰⁰, 10⁻⁴⁰¹, 10⁻⁴⁰².
    let paths = [1.0, 0.1, 0.01].map(|h| path([(3e-200 * h, 1e-200 * h, 1.0), (1e-200, 1e-200, 1.0)]));
    assert!(paths.iter().all(|path| path.draw() == Draw::new(0.0, 0.0)));
    let ratio = scaled(paths).ratio_of_means().channel(0);
    assert_close(ratio.value, 3.0, 1e-15, "f = 3h");
    assert!(ratio.std_error.is_nan() && ratio.flags == Flags::NONE, "{ratio:?}");
    // And above it.
    let above = scaled([1.0, 2.0].map(|h| path([(3e200 * h, 1e200 * h, 1.0), (1e200, 1e200, 1.0)])));
    assert_close(above.ratio_of_means().value, 3.0, 1e-15, "f = 3h");
}

#[test]
fn g4_a_vanishing_integral_is_the_factor_one_and_counted() {
    // From one half of the first points there is no second h. f = 1: F = 1.
    let mut sums = Sums::<f64>::default();
    let mut trivial = 0;
    for (second, integral) in [(0.0, 0.0), (1.0, 1.0)] {
        let path = path([(1.0, 1.0, 1.0), (1.0, second, integral)]);
        trivial += path.trivial(0);
        sums.add(path.draw());
    }
    assert_eq!((RatioOfMeans.estimate(&sums, &Integrals::ONE).unwrap().value, trivial), (1.0, 1));
    // h counts for nothing there, not even NaN, and a zero of either sign is a zero.
    assert_eq!(path([(1.0, f64::NAN, -0.0)]).draw(), Draw::new(1.0, 1.0));
}

/// One bad channel, the middle one of three, and the bits of the others with and without it.
fn beside(f: f64, h: f64, integral: f64) -> (PathProduct<Spectrum<f64, 3>>, ChannelEstimate) {
    let run = |(f, h, integral): (f64, f64, f64)| {
        let mut moments = Comoments::default();
        let mut sums = ScaledSums::default();
        let mut last = PathProduct::default();
        for i in 0..9 {
            let x = 0.5 + f64::from(i * 7 % 5) / 8.0;
            last = path([
                (Spectrum([x, 1.0, 0.3]), Spectrum([0.7, 1.0, x]), Spectrum([0.7, 1.0, 0.9])),
                (Spectrum([1.1, f, x]), Spectrum([x, h, 0.1]), Spectrum([0.9, integral, 0.1])),
            ]);
            moments.add(last.draw());
            sums.add(last);
        }
        (last, RatioOfMeans.estimate(&moments, &Integrals::ONE).unwrap(), sums.ratio_of_means())
    };
    let (bad, good) = (run((f, h, integral)), run((1.0, 1.0, 1.0)));
    for channel in [0, 2] {
        for (ours, alone) in [(bad.1, good.1), (bad.2, good.2)] {
            let (ours, alone) = (ours.channel(channel), alone.channel(channel));
            assert_eq!(ours.value.to_bits(), alone.value.to_bits());
            assert_eq!(ours.std_error.to_bits(), alone.std_error.to_bits());
            assert_eq!(ours.flags, alone.flags);
        }
        assert_eq!(bad.0.draw().h[0].get(channel).to_bits(), good.0.draw().h[0].get(channel).to_bits());
        assert_eq!(bad.0.trivial(channel), 0);
    }
    (bad.0, bad.1.channel(1))
}

#[test]
fn g5_one_channel_does_not_touch_another() {
    let (last, estimate) = beside(2.0, 0.0, 0.0);
    assert_eq!((last.trivial(1), estimate.value, estimate.flags), (1, 2.0, Flags::NONE));
    // An integral or an auxiliary that is no number: the plain mean, and a flag.
    for (h, integral) in [(1.0, f64::NAN), (1.0, f64::INFINITY), (f64::NAN, 1.0), (f64::INFINITY, 1.0)] {
        let (last, estimate) = beside(2.0, h, integral);
        assert!(last.draw().f[1] == 2.0 && !last.draw().h[0][1].is_finite());
        assert_eq!((estimate.value, estimate.flags & Flags::NONFINITE), (2.0, Flags::NONFINITE), "{h} {integral}");
    }
    let (_, estimate) = beside(f64::NAN, 1.0, 1.0);
    assert!(estimate.value.is_nan() && estimate.flags.contains(Flags::NONFINITE));
}

#[test]
fn scaled_sums_say_what_is_undefined() {
    let one = |f: f64, h: f64| path([(f, h, 1.0)]);
    let estimate = |paths: &[(f64, f64)]| scaled(paths.iter().map(|(f, h)| one(*f, *h))).ratio_of_means().channel(0);
    let empty = estimate(&[]);
    assert!(empty.value.is_nan() && empty.std_error.is_nan() && empty.flags == Flags::EMPTY);
    for (draws, value, flags) in [
        (&[(3.0, 2.0)][..], 1.5, Flags::ONE_SAMPLE),
        (&[(1.0, 2.0), (4.0, 2.0)], 1.25, Flags::NONE),
        (&[(1.0, 1.0), (2.0, -1.0)], 1.5, Flags::DENOM_ZERO),
        (&[(0.0, 0.0), (-0.0, 0.0)], 0.0, Flags::NO_SUPPORT),
        (&[(1.0, f64::NAN), (2.0, 1.0)], 1.5, Flags::NONFINITE),
        (&[(1e300, 1e-300), (1e300, 1e-300)], 1e300, Flags::NONFINITE),
        (&[(1.0, -2.0), (2.0, -1.0)], -1.0, Flags::NEGATIVE),
    ] {
        let ours = estimate(draws);
        assert!(ours.value == value && ours.std_error.is_nan() && ours.flags == flags, "{draws:?}: {ours:?}");
    }
    for bad in [f64::NAN, f64::INFINITY] {
        let ours = estimate(&[(1.0, 1.0), (bad, 1.0)]);
        assert!(ours.value.is_nan() && ours.flags.contains(Flags::NONFINITE), "{ours:?}");
    }
    let strict: Result<_, Error> = scaled([one(3.0, 2.0)]).ratio_of_means().strict();
    assert_eq!(strict.unwrap_err(), Error::Flagged { channel: 0, flags: Flags::ONE_SAMPLE });
}

#[test]
fn scaled_sums_merge_and_round_like_plain_ones() {
    let mut noise = Noise(11);
    let paths: Vec<PathProduct<f64>> = (0..100_000)
        .map(|_| path([(noise.next_unit(), 0.5 + noise.next_unit(), 1.0), (1e-300, 1e-300, 1.0)]))
        .collect();
    let whole = scaled(paths.iter().copied());
    let bits = |sums: &ScaledSums<f64>| sums.ratio_of_means().value.to_bits();
    let (mut split, mut later) = (scaled(paths[..33_333].iter().copied()), ScaledSums::default());
    later.add_batch(&paths[33_333..]);
    split.merge(&later);
    assert_eq!(split.count(), whole.count());
    let right = whole.ratio_of_means().value;
    assert_close(split.ratio_of_means().value, right, 1e5 * f64::EPSILON * right, "merged");
    let (mut left, mut right) = (whole, ScaledSums::default());
    left.merge(&ScaledSums::default());
    right.merge(&whole);
    assert_eq!((bits(&left), bits(&right)), (bits(&whole), bits(&whole)));
    // In range they are the plain sums.
    let mut noise = Noise(11);
    let (mut f, mut h) = (0.0, 0.0);
    for _ in 0..100_000 {
        (f, h) = (f + noise.next_unit(), h + 0.5 + noise.next_unit());
    }
    assert_close(whole.ratio_of_means().value, f / h, 1e5 * f64::EPSILON * f / h, "plain sums");
}
