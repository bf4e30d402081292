//! F: bad draws, signs of zero, lanes.

use super::both;
use crate::answer::ErrorBar;
use crate::case::{Ask, Case, Precision};
use crate::draws::Draws;
use crate::lane_types;
use crate::method::{Everything, Method, number};
use crate::noise::noise;
use crate::probe::{Probe, Probes};
use rand_core::Rng;
use ratiocv_core::moments::{Accumulate, Comoments, Slices, Sums};
use ratiocv_core::{
    ChannelEstimate, Draw, Estimator, Flags, Integrals, Lanes, Plain, Problem, Proposal, RatioOfMeans, Scalar,
    Spectrum, unit_interval,
};

pub(super) fn cases() -> Vec<Case> {
    both(in_each_precision)
}

fn in_each_precision(precision: Precision) -> Vec<Case> {
    let one = |id, about, method, draws, right| {
        Case::new(id, about, precision, Ask::One { method, draws, then: None, integral: 1.0 }, right)
    };
    let nonfinite = Flags::NONFINITE;
    let million = Draws::new(1_000_000, |i| {
        let h = 0.5 + noise(1, i);
        Draw::new(if i == 123_456 { f64::NAN } else { h }, h)
    });
    let f1 = one("F1", "one NaN in a million", Method::Ratio, million, f64::NAN).must(nonfinite);
    let mut cases = vec![f1.error(ErrorBar::Unknown)];
    let ten = Draws::new(10, |i| Draw::new(if i == 9 { f64::NAN } else { 1.0 }, 1.0));
    cases.push(one("F2", "nine ones and a NaN", Method::Ratio, ten, f64::NAN).must(nonfinite));
    let inf = f64::INFINITY;
    for method in [Method::Ratio, Method::Beale, Method::HartleyRoss, Method::MeanOfRatios, Method::Mickey] {
        for (about, f, h) in [("f = ∞", inf, 1.0), ("h = ∞", 1.0, inf), ("f = h = ∞", inf, inf)] {
            let right = if f == inf { f64::NAN } else { 1.0 };
            let case = one("F3", about, method, Draws::listed([(f, h), (1.0, 1.0)]), right).must(nonfinite);
            // Beside NONFINITE, the mean of ratios says UNDERFLOW of squares that are NaN: too much, but not silent.
            let too_much = if method == Method::MeanOfRatios { Flags::UNDERFLOW } else { Flags::NONE };
            cases.push(case.may(Flags::UNBOUNDED_RATIO | too_much));
        }
    }
    let least = precision.of(f64::from(f32::from_bits(1)), f64::from_bits(1));
    let case = one(
        "F5",
        "f = h = the least number: divide, do not multiply",
        Method::MeanOfRatios,
        Draws::listed([(least, least)]),
        1.0,
    );
    cases.push(case.exact());
    let edge = Probes::of::<Edge>(precision);
    cases.push(Case::new("F4", "pdf = 0 where f = 0: a draw of 0", precision, Ask::Probe(edge), 0.5).exact());
    let empty = Draws::new(100, |_| Draw::new(0.0, 0.0));
    let f6 = one("F6", "0/0 in a lane that is not chosen", Method::MeanOfRatios, empty, 0.0);
    cases.push(f6.exact().must(Flags::NO_SUPPORT));
    let probe = |id, about, probes, right| Case::new(id, about, precision, Ask::Probe(probes), right).exact();
    for method in [Method::Plain, Method::Ratio] {
        for count in [1, 3, 200] {
            let negative = Draws::new(count, |_| Draw::new(-0.0, 1.0));
            cases.push(one("F7", "the sign of a mean of −0", method, negative, 0.0).exact().must(Flags::NO_SUPPORT));
        }
    }
    cases.push(probe("F8", "maxima with NaN and with ±0, against scalars", Probes::of::<Maxima>(precision), 0.0));
    let once =
        Probes::once("Slices", precision.of(any_channels::<f32> as fn() -> ChannelEstimate, any_channels::<f64>));
    cases.push(probe("F9", "1 to 31 channels and 1 to 200 draws, against one", once, 0.0));
    cases.push(probe("F10", "payloads of NaN, and a checkpoint that goes on", Probes::of::<Payloads>(precision), 0.0));
    cases
}

/// The mean of two draws: one of value 1, and one at the edge of the support, where pdf and f are 0.
struct Edge;

impl Probe for Edge {
    fn on<V: Lanes>() -> ChannelEstimate {
        struct Ramp;
        impl Proposal for Ramp {
            type Point = f64;
            fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> f64 {
                libm::sqrt(unit_interval(rng))
            }
            fn pdf(&self, x: &f64) -> f64 {
                2.0 * x
            }
        }
        let problem = Problem::new(|x: &f64| V::splat(V::Scalar::from_f64(2.0 * x))).proposal(Ramp);
        let mut moments = Sums::<V, 0>::default();
        moments.add(problem.draw_at(&0.5));
        moments.add(problem.draw_at(&0.0));
        let estimate = Plain.estimate_anyway(&moments, &Integrals::NONE);
        let same = (1..V::LANES).all(|lane| estimate.channel(lane).value == estimate.channel(0).value);
        if same { estimate.channel(0) } else { number(f64::NAN, Flags::NONE) }
    }
}

/// How many of the maxima of pairs, by comparing and selecting, differ from the scalars'.
struct Maxima;

impl Probe for Maxima {
    fn on<V: Lanes>() -> ChannelEstimate {
        let numbers = [0.0, -0.0, 1.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY].map(V::Scalar::from_f64);
        let mut differ = 0;
        for (i, a) in numbers.into_iter().enumerate() {
            for b in numbers {
                // Another pair in every other lane.
                let (x, y) = (
                    V::from_fn(|lane| if lane % 2 == 0 { a } else { numbers[(i + lane) % numbers.len()] }),
                    V::splat(b),
                );
                let larger = V::select(x.lt(y), y, x);
                let right = if a < b { b } else { a };
                let same = larger.get(0).widen().to_bits() == right.widen().to_bits();
                differ += u32::from(!same && !right.widen().is_nan());
                differ += u32::from(right.widen().is_nan() != larger.get(0).widen().is_nan());
            }
        }
        number(f64::from(differ), Flags::NONE)
    }
}

/// How many channels differ in a bit from the same channel alone, draw by draw.
fn any_channels<S: Scalar>() -> ChannelEstimate {
    let mut differ = 0;
    for channels in [1_usize, 3, 7, 8, 9, 15, 16, 17, 31] {
        for count in [1_usize, 2, 3, 4, 5, 63, 64, 65, 68, 69, 200] {
            let f = |i: usize, m: usize| S::from_f64(0.5 + noise(90, i * channels + m));
            let h = |i: usize, m: usize| S::from_f64(0.5 + noise(91, i * channels + m));
            let mut pieces = vec![Comoments::<Spectrum<S, 4>>::default(); channels.div_ceil(4)];
            let Ok(mut together) = Slices::new(&mut pieces, channels) else { return number(f64::NAN, Flags::NONE) };
            let mut alone = vec![Comoments::<S>::default(); channels];
            for i in 0..count {
                let row = |of: &dyn Fn(usize, usize) -> S| (0..channels).map(|m| of(i, m)).collect::<Vec<_>>();
                let (row_f, row_h) = (row(&f), row(&h));
                differ += u32::from(together.add(&row_f, [&row_h]).is_err());
                alone.iter_mut().enumerate().for_each(|(m, alone)| alone.add(Draw::new(row_f[m], row_h[m])));
            }
            let done = together.estimate(
                &RatioOfMeans,
                |_| [1.0],
                |m, ours| {
                    let right = ratiocv_core::Estimator::estimate_anyway(
                        &RatioOfMeans,
                        &alone[m],
                        &ratiocv_core::Integrals::ONE,
                    );
                    let right = right.channel(0);
                    let bits = |e: ChannelEstimate| (e.value.to_bits(), e.std_error.to_bits(), e.flags);
                    differ += u32::from(bits(ours) != bits(right));
                },
            );
            differ += u32::from(done.is_err() && count > 0);
        }
    }
    number(f64::from(differ), Flags::NONE)
}

/// How many words of a checkpoint are NaNs other than the one of Rust, after draws with NaNs of other signs and
/// payloads, or are others after it was loaded and saved again.
struct Payloads;

impl Probe for Payloads {
    fn on<V: Lanes>() -> ChannelEstimate {
        let payloads = [0x7ff8_0000_0000_0000, 0xfff8_0000_0000_0000, 0x7ff8_beef_0000_0000_u64].map(f64::from_bits);
        let draw = |i: usize| {
            let nan = V::Scalar::from_f64(payloads[i]);
            let f = V::from_fn(|lane| if lane == V::LANES / 2 { nan } else { <V::Scalar as Lanes>::ONE });
            Draw::new(f, V::ONE)
        };
        let mut moments = Everything::<V>::default();
        lane_types::add(&mut moments, 0, payloads.len(), 1, &draw);
        let saved = lane_types::saved(&mut moments);
        let again = lane_types::saved(&mut lane_types::loaded::<Everything<V>>(&saved));
        let strange = |word: &&u64| f64::from_bits(**word).is_nan() && **word != f64::NAN.to_bits();
        let differ = saved.iter().filter(strange).count() + saved.iter().zip(&again).filter(|(a, b)| a != b).count();
        let known = saved.iter().any(|word| f64::from_bits(*word).is_nan());
        number(if known { differ as f64 } else { f64::NAN }, Flags::NONE)
    }
}
