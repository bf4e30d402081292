//! The scalar reference.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};
use ratiocv_core::{Lanes, Scalar, Single};

/// One channel in plain scalar arithmetic that says it is `CHANNELS` alike, so that accumulators sum it in
/// the order that they have for that many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alone<S, const CHANNELS: usize>(
    /// The number.
    pub S,
);

macro_rules! operators {
    ($($trait:ident $method:ident)*) => {$(
        impl<S: Scalar, const CHANNELS: usize> $trait for Alone<S, CHANNELS> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )*};
}

operators!(Add add Sub sub Mul mul Div div);

impl<S: Scalar, const CHANNELS: usize> Neg for Alone<S, CHANNELS> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Scalar, const CHANNELS: usize> Lanes for Alone<S, CHANNELS> {
    type Scalar = S;
    type Wide = Alone<f64, CHANNELS>;
    type Pack = Self;
    type Mask = bool;
    type PerLane<T: Copy + Debug> = Single<T>;
    const LANES: usize = CHANNELS;
    const PACKS: usize = 1;
    const ZERO: Self = Self(S::ZERO);
    const ONE: Self = Self(S::ONE);

    fn splat(x: S) -> Self {
        Self(x)
    }
    fn from_fn(mut lane: impl FnMut(usize) -> S) -> Self {
        Self(lane(0))
    }
    fn get(&self, _: usize) -> S {
        self.0
    }
    fn pack(&self, _: usize) -> Self {
        *self
    }
    fn set_pack(&mut self, _: usize, lanes: Self) {
        *self = lanes;
    }
    fn widen(self) -> Self::Wide {
        Alone(Lanes::widen(self.0))
    }
    fn narrow(wide: Self::Wide) -> Self {
        Self(S::from_f64(wide.0))
    }
    fn lt(self, other: Self) -> bool {
        self.0 < other.0
    }
    fn equal(self, other: Self) -> bool {
        self.0 == other.0
    }
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}
