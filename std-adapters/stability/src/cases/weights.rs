//! E: weights of several techniques.

use super::both;
use crate::case::{Ask, Case, Precision};
use crate::method::number;
use crate::probe::{Probe, Probes};
use ratiocv_core::moments::{Accumulate, GroupedPairs, Moments, Pairs, Sums};
use ratiocv_core::sampling::Accepted;
use ratiocv_core::weights::{PowerHeuristic, check_sum};
use ratiocv_core::{
    ChannelEstimate, DeterministicMixture, Draw, Estimator, Flags, Integrals, Lanes, PerLane, Plain, Scalar,
};
use ratiocv_simd::Xoshiro16;

type WideScalar<V> = <<V as Lanes>::Wide as Lanes>::Scalar;

pub(super) fn cases() -> Vec<Case> {
    both(|precision: Precision| {
        let probe = |id, about, probes, right| Case::new(id, about, precision, Ask::Probe(probes), right).exact();
        let large = "two pdfs near the largest number";
        vec![
            probe(
                "E13",
                "a technique that nothing was sampled by: its part is 0",
                Probes::of::<Unhit<0>>(precision),
                12.0,
            )
            .silent(),
            probe("E13", "h of a technique is 0 and its f is not", Probes::of::<Unhit<3>>(precision), 15.0)
                .must(Flags::DENOM_ZERO),
            probe("E14", "no technique reaches the draw", Probes::of::<Heuristic<0>>(precision), 0.0),
            probe("E15", "a delta against a pdf", Probes::of::<Heuristic<1>>(precision), 1.0),
            probe("E15", large, Probes::of::<Heuristic<2>>(precision), 0.5),
            probe("E15", "two pdfs whose squares overflow", Probes::of::<Heuristic<3>>(precision), 0.5),
            probe("E15", "two pdfs whose squares underflow", Probes::of::<Heuristic<4>>(precision), 0.5),
            probe("E16", "Σw = 0.9", Probes::of::<Sum<900>>(precision), 0.0).must(Flags::WEIGHTS),
            probe("E16", "Σw = 1.001", Probes::of::<Sum<1001>>(precision), 0.0).must(Flags::WEIGHTS),
            probe("E16", "Σw = 1", Probes::of::<Sum<1000>>(precision), 0.0).silent(),
            probe("E17", "what was rejected counts as drawn", Probes::of::<Rejected>(precision), 0.0),
        ]
    })
}

/// The deterministic mixture of three pairs (1, 2), (3, 2), (2, 1) for H = 10 and of a technique with h = 0, and f = `F`,
/// in the middle channel; elsewhere it is the first technique again.
struct Unhit<const F: u32>;

impl<const F: u32> Probe for Unhit<F> {
    fn on<V: Lanes>() -> ChannelEstimate {
        let middle = V::LANES / 2;
        let splat = |x: f64| V::splat(V::Scalar::from_f64(x));
        let but = |x: f64, there: f64| V::from_fn(|lane| V::Scalar::from_f64(if lane == middle { there } else { x }));
        let mut moments = GroupedPairs::<V, 2, 8>::default();
        for (f, h) in [(1.0, 2.0), (3.0, 2.0), (2.0, 1.0)] {
            moments.add(Pairs([Draw::new(splat(f), splat(h)), Draw::new(but(f, f64::from(F)), but(h, 0.0))]));
        }
        let ten = V::Wide::splat(WideScalar::<V>::from_f64(10.0));
        DeterministicMixture.estimate_anyway(&moments, &Integrals::new([ten; 2])).channel(middle)
    }
}

/// How far the mean of 1/a over accepted samples, 0 over rejected ones, is from what the accepted of 64 make of it, and
/// from 64 draws.
struct Rejected;

impl Probe for Rejected {
    fn on<V: Lanes>() -> ChannelEstimate {
        let mut random = Xoshiro16::stream(17, 0);
        let (mut moments, mut accepted) = (Sums::<V, 0>::default(), vec![0_u32; V::LANES]);
        for _ in 0..64 {
            let of = Accepted::<V>::roll(V::Wide::splat(WideScalar::<V>::from_f64(0.25)), &mut random);
            (0..V::LANES).for_each(|lane| accepted[lane] += u32::from(of.contains(lane)));
            moments.add(Draw { f: of.value(|_| V::Scalar::from_f64(1.0)), h: [] });
        }
        let estimate = Plain.estimate_anyway(&moments, &Integrals::NONE);
        let off = |lane: usize| (estimate.channel(lane).value - 4.0 * f64::from(accepted[lane]) / 64.0).abs();
        let some = accepted.iter().all(|accepted| (1..64).contains(accepted)) && moments.count() == 64;
        number(if some { (0..V::LANES).map(off).fold(0.0, f64::max) } else { f64::NAN }, Flags::NONE)
    }
}

/// The first of two weights of the power heuristic, for pair `PAIR` of pdfs.
struct Heuristic<const PAIR: usize>;

impl<const PAIR: usize> Probe for Heuristic<PAIR> {
    fn on<V: Lanes>() -> ChannelEstimate {
        let single = V::Scalar::from_f64(1e-300).widen() == 0.0;
        let [overflow, underflow, largest] = if single { [1e20, 1e-25, 3e38] } else { [1e200, 1e-200, 1.7e308] };
        let pdfs = [[0.0, 0.0], [f64::INFINITY, 1.0], [largest; 2], [overflow; 2], [underflow; 2]][PAIR];
        let pdfs = pdfs.map(|pdf| V::splat(V::Scalar::from_f64(pdf)));
        let [first, _] = PowerHeuristic::SQUARE.weights(&[1.0, 1.0], &pdfs);
        let worst = (1..V::LANES).fold(first.get(0).widen(), |worst, lane| {
            let here = first.get(lane).widen();
            if here == worst { worst } else { f64::NAN }
        });
        number(worst, Flags::NONE)
    }
}

/// The flags of weights that sum to `THOUSANDTHS`/1000, in the middle channel of sound ones; how many others have any.
struct Sum<const THOUSANDTHS: u32>;

impl<const THOUSANDTHS: u32> Probe for Sum<THOUSANDTHS> {
    fn on<V: Lanes>() -> ChannelEstimate {
        let middle = V::LANES / 2;
        let rest = f64::from(THOUSANDTHS) / 1000.0 - 0.5;
        let half = V::splat(V::Scalar::from_f64(0.5));
        let other = V::from_fn(|lane| V::Scalar::from_f64(if lane == middle { rest } else { 0.5 }));
        let flags = check_sum(&[half, other], V::ONE);
        let others = (0..V::LANES).filter(|lane| *lane != middle && !flags.get(*lane).is_empty()).count();
        number(others as f64, flags.get(middle))
    }
}
