//! E: weights of several techniques.

use super::both;
use crate::case::{Ask, Case, Precision};
use crate::method::number;
use crate::probe::{Probe, Probes};
use ratiocv_core::weights::{PowerHeuristic, check_sum};
use ratiocv_core::{ChannelEstimate, Flags, Lanes, PerLane, Scalar};

pub(super) fn cases() -> Vec<Case> {
    both(|precision: Precision| {
        let probe = |id, about, probes, right| Case::new(id, about, precision, Ask::Probe(probes), right).exact();
        let large = "two pdfs near the largest number";
        vec![
            probe("E14", "no technique reaches the draw", Probes::of::<Heuristic<0>>(precision), 0.0),
            probe("E15", "a delta against a pdf", Probes::of::<Heuristic<1>>(precision), 1.0),
            probe("E15", large, Probes::of::<Heuristic<2>>(precision), 0.5),
            probe("E15", "two pdfs whose squares overflow", Probes::of::<Heuristic<3>>(precision), 0.5),
            probe("E15", "two pdfs whose squares underflow", Probes::of::<Heuristic<4>>(precision), 0.5),
            probe("E16", "Σw = 0.9", Probes::of::<Sum<900>>(precision), 0.0).must(Flags::WEIGHTS),
            probe("E16", "Σw = 1.001", Probes::of::<Sum<1001>>(precision), 0.0).must(Flags::WEIGHTS),
            probe("E16", "Σw = 1", Probes::of::<Sum<1000>>(precision), 0.0).silent(),
        ]
    })
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
