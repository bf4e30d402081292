//! What is not draws and an estimator: a computation of its own on every lane type.

use crate::case::Precision;
use core::fmt;
use ratiocv_core::{ChannelEstimate, Lanes, Spectrum};
use ratiocv_simd::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};

/// A computation in lanes, whose worst channel is returned.
pub(crate) trait Probe {
    /// What comes out.
    fn on<V: Lanes>() -> ChannelEstimate;
}

/// What a lane type is called, and what a probe makes of it.
type OnLanes = (&'static str, fn() -> ChannelEstimate);

/// A probe on the lane types of a precision.
#[derive(Clone)]
pub struct Probes(Vec<OnLanes>);

impl Probes {
    /// `P` on every lane type.
    pub(crate) fn of<P: Probe>(precision: Precision) -> Self {
        macro_rules! on {
            ($($lanes:ty),*) => { vec![$((stringify!($lanes), P::on::<$lanes> as fn() -> ChannelEstimate)),*] };
        }
        Self(match precision {
            Precision::Single => on![f32, Spectrum<f32, 3>, Spectrum<f32, 16>, F32x4, F32x8, F32x16],
            Precision::Double => on![f64, Spectrum<f64, 3>, Spectrum<f64, 16>, F64x2, F64x4, F64x8],
        })
    }

    /// What does not depend on lanes.
    pub(crate) fn once(name: &'static str, run: fn() -> ChannelEstimate) -> Self {
        Self(vec![(name, run)])
    }

    /// What comes out, by lane type.
    pub(crate) fn run(&self) -> impl Iterator<Item = (&'static str, ChannelEstimate)> {
        self.0.iter().map(|(name, run)| (*name, run()))
    }
}

impl fmt::Debug for Probes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.0.iter().map(|(name, _)| name)).finish()
    }
}
