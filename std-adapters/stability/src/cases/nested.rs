//! G: nested, stiff, heavy-tailed.

use super::both;
use crate::answer::ErrorBar;
use crate::case::Precision::Double;
use crate::case::{Ask, Case, Precision};
use crate::draws::Draws;
use crate::method::{Method, number};
use crate::noise::noise;
use crate::probe::{Probe, Probes};
use ratiocv_core::moments::Accumulate;
use ratiocv_core::{ChannelEstimate, Draw, Flags, Integrals, Lanes, PathProduct, Scalar, ScaledSums};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = both(in_each_precision);
    for (about, alpha, right, digits) in [
        ("Pareto, α = 1.5: no variance", 1.5, 3.0, 2.0),
        ("Pareto, α = 0.9: no mean", 0.9, f64::NAN, f64::NEG_INFINITY),
    ] {
        let draws = Draws::new(1_000_000, move |i| Draw::new(libm::pow((i as f64 + 0.5) / 1e6, -1.0 / alpha), 1.0));
        let ask = Ask::One { method: Method::Plain, draws, then: None, integral: 1.0 };
        let id = if alpha > 1.0 { "G6" } else { "G7" };
        cases.push(Case::new(id, about, Double, ask, right).digits(digits).must(Flags::HEAVY_TAIL));
    }
    cases
}

fn in_each_precision(precision: Precision) -> Vec<Case> {
    let probe = |id, about, probes, right: f64, digits| {
        Case::new(id, about, precision, Ask::Probe(probes), right).digits(digits)
    };
    let about = "f = 3h, h = 10⁻¹⁰⁰⁰ and less";
    // 0.1 is rounded, 400 times.
    let up_and_down = libm::pow(precision.rounded(0.1) * 10.0, 400.0);
    let mut cases = vec![
        probe(
            "G1",
            "400 factors of 0.1 and 400 of 10",
            Probes::of::<UpAndDown>(precision),
            up_and_down,
            precision.of(7.0, 12.5),
        ),
        probe("G3", about, Probes::of::<Deep>(precision), 3.0, precision.of(7.0, 15.0)),
        probe("G4", "H = 0 on half of the paths", Probes::of::<Trivial>(precision), 1.0, precision.of(7.0, 15.0)),
        probe("G5", "H = 0 in one channel: how many others notice", Probes::of::<Chromatic>(precision), 0.0, 17.0),
        probe("G11", "a ratio of paths is consistent", Probes::of::<Joint>(precision), 3.0, precision.of(6.0, 14.0))
            .naive(ratio_at_each_vertex),
    ];
    let one = |id, about, method, draws, integral, right| {
        Case::new(id, about, precision, Ask::One { method, draws, then: None, integral }, right)
    };
    // The product of 50 factors uniform on [0, 2): mean 1, but a few paths carry it all.
    let deep = Draws::new(10_000, |i| {
        let h = (0..50).fold(1.0, |h, d| h * 2.0 * noise(50 + d, i));
        Draw::new(h, h)
    });
    let g2 = one("G2", "a product of 50 factors: few paths make the mean", Method::Ratio, deep, 1.0, 1.0);
    cases.push(g2.must(Flags::LOW_ESS));
    let missed = Draws::new(1_000_000, |_| Draw::new(0.0, 1.0));
    let g8 = one("G8", "a delta that no draw has hit", Method::Plain, missed, 1.0, 0.0);
    cases.push(g8.exact().must(Flags::NO_SUPPORT).error(ErrorBar::Unknown));
    let firefly = Draws::new(1024, |i| Draw::new(if i == 1023 { 1e12 } else { 1.0 }, 1.0));
    let right = (precision.rounded(1e12) + 1023.0) / 1024.0;
    let g9 = one("G9", "a firefly, left alone", Method::Plain, firefly, 1.0, right);
    cases.push(g9.must(Flags::HEAVY_TAIL));
    let spike = Draws::new(100, |i| {
        let h = if i == 37 { 1e30 } else { 1.0 };
        Draw::new(2.0 * h, h)
    });
    let g10 = one("G10", "f and h share a spike", Method::Ratio, spike, 1.0, 2.0);
    cases.push(g10.digits(precision.of(6.5, 15.0)).may(Flags::OVERFLOW));
    cases
}

/// The channel whose value is furthest from `right`.
fn worst<V: Lanes>(value: impl Fn(usize) -> f64, right: f64) -> ChannelEstimate {
    let off = |lane: &usize| (value(*lane) - right).abs();
    let lane = (0..V::LANES).max_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0);
    number(value(lane), Flags::NONE)
}

fn all<V: Lanes>(x: f64) -> V {
    V::splat(V::Scalar::from_f64(x))
}

struct UpAndDown;

impl Probe for UpAndDown {
    fn on<V: Lanes>() -> ChannelEstimate {
        let mut path = PathProduct::<V>::default();
        for factor in [0.1, 10.0] {
            (0..400).for_each(|_| path.extend(Draw::new(all(factor), V::ONE), &Integrals::ONE));
        }
        worst::<V>(|lane| path.draw().f.get(lane).widen(), 1.0)
    }
}

struct Deep;

impl Probe for Deep {
    fn on<V: Lanes>() -> ChannelEstimate {
        let mut sums = ScaledSums::<V>::default();
        for x in [0.1, 0.01, 0.25] {
            let mut path = PathProduct::<V>::default();
            (0..1000).for_each(|_| path.extend(Draw::new(all(x), all(x)), &Integrals::ONE));
            path.extend(Draw::new(all(3.0), V::ONE), &Integrals::ONE);
            sums.add(path);
        }
        worst::<V>(|lane| sums.ratio_of_means().channel(lane).value, 3.0)
    }
}

struct Trivial;

impl Probe for Trivial {
    fn on<V: Lanes>() -> ChannelEstimate {
        let mut sums = ScaledSums::<V>::default();
        for i in 0..64 {
            let mut path = PathProduct::<V>::default();
            let seen = f64::from(i % 2);
            path.extend(Draw::new(V::ONE, all(seen)), &Integrals::new([V::Wide::splat(seen)]));
            sums.add(path);
        }
        worst::<V>(|lane| sums.ratio_of_means().channel(lane).value, 1.0)
    }
}

struct Chromatic;

impl Probe for Chromatic {
    fn on<V: Lanes>() -> ChannelEstimate {
        let sums = |dark: bool| {
            let mut sums = ScaledSums::<V>::default();
            for i in 0..16 {
                let mut path = PathProduct::<V>::default();
                let here = |lane: usize| if dark && lane == V::LANES / 2 { 0.0 } else { 1.0 };
                let x = 0.5 + f64::from(i * 7 % 5) / 8.0;
                let h = V::from_fn(|lane| V::Scalar::from_f64(here(lane) * x));
                path.extend(Draw::new(all(x), h), &Integrals::new([V::Wide::from_fn(here)]));
                sums.add(path);
            }
            sums.ratio_of_means()
        };
        let (dark, light) = (sums(true), sums(false));
        let others = (0..V::LANES).filter(|lane| *lane != V::LANES / 2);
        let noticed = others.filter(|lane| dark.channel(*lane).value.to_bits() != light.channel(*lane).value.to_bits());
        let itself = u32::from(!dark.channel(V::LANES / 2).value.is_finite());
        number(noticed.count() as f64 + f64::from(itself), Flags::NONE)
    }
}

/// Paths of two steps, x then y, all equally likely: f = f₁(x)·f₂(x, y), and h likewise.
const PATHS: [([f64; 2], [[f64; 2]; 2]); 2] =
    [([1.0, 0.5], [[2.0, 1.0], [4.0, 3.0]]), ([3.0, 1.5], [[1.0, 0.5], [1.0, 1.5]])];

struct Joint;

impl Probe for Joint {
    fn on<V: Lanes>() -> ChannelEstimate {
        let mut sums = ScaledSums::<V>::default();
        for ([f, h], steps) in PATHS {
            let integral = (steps[0][1] + steps[1][1]) / 2.0;
            for [f2, h2] in steps {
                let mut path = PathProduct::<V>::default();
                path.extend(Draw::new(all(f), all(h)), &Integrals::ONE);
                path.extend(Draw::new(all(f2), all(h2)), &Integrals::new([V::Wide::splat(integral)]));
                sums.add(path);
            }
        }
        worst::<V>(|lane| sums.ratio_of_means().channel(lane).value, 3.0)
    }
}

/// One sample of y for each x: f₂/h₂·H₂ inside the outer ratio, averaged over all samples.
fn ratio_at_each_vertex() -> f64 {
    let (mut f, mut h) = (0.0, 0.0);
    for ([f1, h1], steps) in PATHS {
        let integral = (steps[0][1] + steps[1][1]) / 2.0;
        for [f2, h2] in steps {
            f += f1 * f2 / h2 * integral;
            h += h1;
        }
    }
    f / h
}
