//! B, of `f32` draws in `f64` blocks: where `f32` blocks may flag, these must be right.

use crate::answer::ErrorBar;
use crate::case::{Ask, Case, Precision};
use crate::probe::Probes;
use ratiocv_core::moments::{Accumulate, Comoments, Widened};
use ratiocv_core::{
    ChannelEstimate, Choose, Difference, Draw, Estimator, Integrals, RatioOfMeans, RegressionRatio, Spectrum,
};

/// What f and h are multiples of: those of B1, B2 and B3.
const SCALES: [(f32, f32); 3] = [(1e20, 1e20), (1e-25, 1e-25), (1e30, 1e-30)];

pub(super) fn cases() -> Vec<Case> {
    macro_rules! rows {
        ($($row:literal $id:literal $about:literal;)*) => {
            vec![$(
                row($id, $about, $row, widened::<$row, 0>),
                row($id, $about, $row, widened::<$row, 1>),
                row($id, $about, $row, widened::<$row, 2>),
                row($id, $about, $row, widened::<$row, 3>),
            )*]
        };
    }
    rows! {
        0 "B1" "squares overflow f32, in f64 blocks";
        1 "B2" "squares underflow f32, in f64 blocks";
        2 "B3" "β = 10⁶⁰, in f64 blocks";
    }
}

/// The value to rounding, and no error: f is proportional to h.
fn row(id: &'static str, about: &'static str, scale: usize, run: fn() -> ChannelEstimate) -> Case {
    let f = f64::from(SCALES[scale].0);
    let case = Case::new(id, about, Precision::Single, Ask::Probe(Probes::once("Spectrum<_, 3>", run)), f);
    case.digits(14.0).error(ErrorBar::AtMost(1e-12 * f))
}

/// The estimate of estimator `WHICH`, of 200 draws between two sound channels.
fn widened<const SCALE: usize, const WHICH: usize>() -> ChannelEstimate {
    type Rgb<S> = Spectrum<S, 3>;
    let (f, h) = SCALES[SCALE];
    let mut moments = Widened::<Rgb<f32>, Comoments<Rgb<f64>>>::default();
    for i in 0..200 {
        // Multiples without rounding.
        let times = if i % 2 == 0 { 1.0 } else { 4.0 };
        moments.add(Draw::new(Spectrum([1.0, times * f, 2.0]), Spectrum([1.0, times * h, times])));
    }
    let integrals = Integrals::new([Spectrum([1.0, f64::from(h), 2.5])]);
    let estimate = match WHICH {
        0 => RatioOfMeans.estimate_anyway(&moments, &integrals),
        1 => RegressionRatio::default().estimate_anyway(&moments, &integrals),
        2 => Difference::default().estimate_anyway(&moments, &integrals),
        _ => Choose::default().estimate_anyway(&moments, &integrals),
    };
    estimate.channel(1)
}
