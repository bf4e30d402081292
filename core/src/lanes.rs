//! The arithmetic that every accumulator is written in: independent channels, side by side.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};
use num_traits::float::FloatCore;

/// Element-wise arithmetic over [`LANES`](Lanes::LANES) independent channels.
///
/// *Implemented by* `f32`, `f64`, [`Spectrum`](crate::Spectrum) and SIMD packs; *called by* the
/// accumulators, so that scalars, RGB and 64 wavelengths share one code path.
///
/// # Laws
/// Lane `i` of every result depends on lane `i` of the inputs alone, and equals, to the bit, the
/// same operation on the scalars of that lane. `from_fn(|i| x.get(i)) == x`. Lane `i` of pack `p` is lane
/// `p * Pack::LANES + i`, and `Pack::LANES * PACKS == LANES`.
///
/// # Implementing
/// Map each operation over the lanes. Never fuse a multiply with an add, never replace a division
/// by a multiplication with a reciprocal: results must be the same bits on every platform.
pub trait Lanes:
    Copy
    + Send
    + Sync
    + 'static
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The number in one lane.
    type Scalar: Scalar;
    /// The same lanes in `f64`: the state that blocks of draws are merged into.
    type Wide: Lanes<Scalar = f64, Wide = Self::Wide>;
    /// The lanes that lie side by side in an array of them, as in [`Spectrum`](crate::Spectrum); this type itself
    /// where there is no array.
    ///
    /// Long computations, such as merges, go pack by pack: their intermediate results then stay in registers.
    type Pack: Lanes<Scalar = Self::Scalar>;
    /// One truth value per lane.
    type Mask: Copy;
    /// One `T` per lane, for results that are not numbers.
    type PerLane<T: Copy + Debug>: PerLane<T>;
    /// The number of channels.
    const LANES: usize;
    /// The number of packs; 1 if the pack is this type itself.
    const PACKS: usize;
    /// 0 in every lane.
    const ZERO: Self;
    /// 1 in every lane.
    const ONE: Self;

    /// `x` in every lane.
    fn splat(x: Self::Scalar) -> Self;
    /// Lane `i` is `lane(i)`; called once per lane, in order.
    fn from_fn(lane: impl FnMut(usize) -> Self::Scalar) -> Self;
    /// The number in lane `lane`; panics if there is no such lane.
    fn get(&self, lane: usize) -> Self::Scalar;
    /// Pack `pack`; may panic if there is no such pack.
    fn pack(&self, pack: usize) -> Self::Pack;
    /// Pack `pack` becomes `lanes`; may panic if there is no such pack.
    fn set_pack(&mut self, pack: usize, lanes: Self::Pack);
    /// Exact conversion to `f64` lanes.
    fn widen(self) -> Self::Wide;
    /// Rounds `f64` lanes to this type.
    fn narrow(wide: Self::Wide) -> Self;
    /// `self < other` per lane; false where either is NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self == other` per lane; false where either is NaN, true for zeros of either sign.
    fn equal(self, other: Self) -> Self::Mask;
    /// `yes` where `mask` is set, else `no`. A choice of bits: what is not chosen leaves no trace,
    /// not even a NaN.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// `self` where `mask` is set, else 0: a choice of bits for which packs need one operation, not three.
    #[inline(always)]
    #[must_use]
    fn only(self, mask: Self::Mask) -> Self {
        Self::select(mask, self, Self::ZERO)
    }
    /// 0 where `mask` is set, else `self`.
    #[inline(always)]
    #[must_use]
    fn except(self, mask: Self::Mask) -> Self {
        Self::select(mask, Self::ZERO, self)
    }
}

/// One value per lane of a [`Lanes`] type; see [`Lanes::PerLane`].
pub trait PerLane<T>: Copy + Debug {
    /// The number of entries.
    const WIDTH: usize;
    /// Entry `i` is `lane(i)`.
    fn from_fn(lane: impl FnMut(usize) -> T) -> Self;
    /// The entry of lane `lane`; panics if there is no such lane.
    fn get(&self, lane: usize) -> T;
}

/// The entry of a single lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Single<T>(pub T);

impl<T: Copy + Debug> PerLane<T> for Single<T> {
    const WIDTH: usize = 1;
    fn from_fn(mut lane: impl FnMut(usize) -> T) -> Self {
        Self(lane(0))
    }
    fn get(&self, lane: usize) -> T {
        [self.0][lane]
    }
}

impl<T, P: PerLane<T>, const K: usize> PerLane<T> for [P; K] {
    const WIDTH: usize = K * P::WIDTH;
    fn from_fn(mut lane: impl FnMut(usize) -> T) -> Self {
        core::array::from_fn(|pack| P::from_fn(|i| lane(pack * P::WIDTH + i)))
    }
    fn get(&self, lane: usize) -> T {
        self[lane / P::WIDTH].get(lane % P::WIDTH)
    }
}

/// The number in one lane: `f32` or `f64`.
///
/// *Implemented by* those two, *called by* bounds that need a single number. A law beyond those of
/// [`Lanes`]: `LANES` is 1.
pub trait Scalar: Lanes<Scalar = Self, Wide = f64> + FloatCore {
    /// Rounds to the nearest representable number.
    fn from_f64(x: f64) -> Self;
}

macro_rules! scalar_lanes {
    ($($float:ident),*) => {$(
        impl Lanes for $float {
            type Scalar = Self;
            type Wide = f64;
            type Pack = Self;
            type Mask = bool;
            type PerLane<T: Copy + Debug> = Single<T>;
            const LANES: usize = 1;
            const PACKS: usize = 1;
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;

            #[inline(always)]
            fn splat(x: Self) -> Self {
                x
            }
            #[inline(always)]
            fn from_fn(mut lane: impl FnMut(usize) -> Self) -> Self {
                lane(0)
            }
            #[inline(always)]
            fn get(&self, lane: usize) -> Self {
                [*self][lane]
            }
            #[inline(always)]
            fn pack(&self, _: usize) -> Self {
                *self
            }
            #[inline(always)]
            fn set_pack(&mut self, _: usize, lanes: Self) {
                *self = lanes;
            }
            #[inline(always)]
            fn widen(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn narrow(wide: f64) -> Self {
                wide as Self
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn equal(self, other: Self) -> bool {
                self == other
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
        }

        impl Scalar for $float {
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as Self
            }
        }
    )*};
}

scalar_lanes!(f32, f64);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comparisons_with_nan_are_false_and_zeros_are_equal() {
        assert!(!f64::NAN.lt(1.0) && !1.0.lt(f64::NAN));
        assert!(!Lanes::equal(f32::NAN, f32::NAN));
        assert!(Lanes::equal(0.0_f64, -0.0));
    }

    #[test]
    fn select_leaves_no_trace_of_the_other_side() {
        assert_eq!(f64::select(false, f64::NAN, 2.0), 2.0);
        assert_eq!(f64::select(true, 1.0, f64::NAN), 1.0);
        assert_eq!((f64::NAN.only(false), f64::NAN.except(true)), (0.0, 0.0));
        assert_eq!((2.0.only(true), 2.0.except(false)), (2.0, 2.0));
    }

    #[test]
    fn per_lane_entries_nest_in_lane_order() {
        let nested = <[[Single<usize>; 2]; 3]>::from_fn(|i| i);
        assert_eq!(<[[Single<usize>; 2]; 3] as PerLane<usize>>::WIDTH, 6);
        for i in 0..6 {
            assert_eq!(nested.get(i), i);
        }
    }
}
