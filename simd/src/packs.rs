//! Packs of four, eight or sixteen numbers over `wide`.

use crate::mask::Mask;
use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};
use ratiocv_core::{Lanes, Single, Spectrum, planted};

macro_rules! operators {
    ($pack:ident: $($trait:ident $method:ident)*) => {$(
        impl $trait for $pack {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )*};
}

macro_rules! packs {
    ($($(#[$about:meta])* $pack:ident: [$float:ident; $lanes:literal] in $inner:ident, $wide:ty;)*) => {$(
        $(#[$about])*
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub struct $pack(wide::$inner);

        impl $pack {
            /// A pack of these numbers, in order.
            #[inline(always)]
            pub const fn new(lanes: [$float; $lanes]) -> Self {
                Self(wide::$inner::new(lanes))
            }
            /// The numbers of the lanes, in order.
            #[inline(always)]
            pub fn to_array(self) -> [$float; $lanes] {
                self.0.to_array()
            }
        }

        impl fmt::Debug for $pack {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_tuple(stringify!($pack)).field(&self.to_array()).finish()
            }
        }

        impl PartialEq for $pack {
            fn eq(&self, other: &Self) -> bool {
                self.to_array() == other.to_array()
            }
        }

        operators!($pack: Add add Sub sub Mul mul Div div);

        impl Neg for $pack {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Lanes for $pack {
            type Scalar = $float;
            type Wide = $wide;
            type Pack = Self;
            type Mask = Mask<Self>;
            type PerLane<T: Copy + fmt::Debug> = [Single<T>; $lanes];
            const LANES: usize = $lanes;
            const PACKS: usize = 1;
            const ZERO: Self = Self::new([0.0; $lanes]);
            const ONE: Self = Self::new([1.0; $lanes]);

            #[inline(always)]
            fn splat(x: $float) -> Self {
                Self(wide::$inner::splat(x))
            }
            #[inline(always)]
            fn from_fn(lane: impl FnMut(usize) -> $float) -> Self {
                Self::new(core::array::from_fn(lane))
            }
            #[inline(always)]
            fn get(&self, lane: usize) -> $float {
                self.to_array()[lane]
            }
            #[inline(always)]
            fn pack(&self, _: usize) -> Self {
                *self
            }
            #[inline(always)]
            fn set_pack(&mut self, _: usize, lanes: Self) {
                *self = lanes;
            }
            // Through arrays: the compiler finds the converting instructions of whole packs itself.
            #[inline(always)]
            fn widen(self) -> $wide {
                let lanes = self.to_array();
                Lanes::from_fn(|i| f64::from(lanes[i]))
            }
            #[inline(always)]
            fn narrow(wide: $wide) -> Self {
                Self::from_fn(|i| wide.get(i) as $float)
            }
            #[inline(always)]
            fn lt(self, other: Self) -> Mask<Self> {
                Mask(Self(planted!("pack_below": self.0.simd_lt(other.0), self.0.simd_le(other.0))))
            }
            #[inline(always)]
            fn equal(self, other: Self) -> Mask<Self> {
                Mask(Self(self.0.simd_eq(other.0)))
            }
            #[inline(always)]
            fn select(mask: Mask<Self>, yes: Self, no: Self) -> Self {
                Self(mask.0.0.select(yes.0, no.0))
            }
            #[inline(always)]
            fn only(self, mask: Mask<Self>) -> Self {
                Self(mask.0.0 & self.0)
            }
            #[inline(always)]
            fn except(self, mask: Mask<Self>) -> Self {
                Self(!mask.0.0 & self.0)
            }
        }
    )*};
}

packs! {
    /// Four `f32`: one register of SSE2, NEON, or WebAssembly.
    F32x4: [f32; 4] in f32x4, F64x4;
    /// Eight `f32`: one register of AVX.
    ///
    /// ```
    /// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, Estimator, Integrals, Lanes, RatioOfMeans};
    /// use ratiocv_simd::F32x8;
    /// // Eight pixels at once, each with f and h of its own.
    /// let mut pixels = Comoments::<F32x8>::default();
    /// for sample in 1..=64 {
    ///     let h = F32x8::from_fn(|pixel| (sample % (pixel + 2)) as f32 + 0.5);
    ///     pixels.add(Draw::new(F32x8::splat(3.0) * h, h));
    /// }
    /// let estimate = RatioOfMeans.estimate(&pixels, &Integrals::ONE)?;
    /// assert_eq!(F32x8::narrow(estimate.value).to_array(), [3.0; 8]);
    /// # Ok::<(), ratiocv_core::Error>(())
    /// ```
    F32x8: [f32; 8] in f32x8, F64x8;
    /// Sixteen `f32`: one register of AVX-512.
    F32x16: [f32; 16] in f32x16, Spectrum<F64x8, 2>;
    /// Two `f64`: one register of SSE2, NEON, or WebAssembly.
    F64x2: [f64; 2] in f64x2, Self;
    /// Four `f64`: one register of AVX.
    F64x4: [f64; 4] in f64x4, Self;
    /// Eight `f64`: one register of AVX-512.
    F64x8: [f64; 8] in f64x8, Self;
}
