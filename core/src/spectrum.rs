//! Several packs side by side: RGB, wavelengths, pixels.

use crate::filled::filled;
use crate::lanes::Lanes;
use core::ops::{Add, Div, Index, IndexMut, Mul, Neg, Sub};

/// `K` packs of channels side by side; itself [`Lanes`], with `K * L::LANES` channels.
///
/// `Spectrum<f32, 3>` is RGB, `Spectrum<f64, 64>` a fine spectrum, and
/// `Spectrum<Spectrum<f32, 8>, 3>` eight RGB pixels. Channel `i` is lane `i % L::LANES` of pack
/// `i / L::LANES`.
///
/// With `K` = 0 there is no channel: accumulators count draws, and estimates are of nothing.
///
/// Aligned to 16 bytes only where a pack is: an RGB pixel takes 12 bytes, not 16.
///
/// ```
/// use ratiocv_core::Spectrum;
/// let light = Spectrum([1.0_f32, 0.5, 0.25]) * Spectrum([2.0, 2.0, 4.0]);
/// assert_eq!(light, Spectrum([2.0, 1.0, 1.0]));
/// assert_eq!(light[1], 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Spectrum<L, const K: usize>(pub [L; K]);

impl<L: Lanes, const K: usize> Spectrum<L, K> {
    /// Combines two spectra pack by pack.
    #[inline(always)]
    fn zip(mut self, other: Self, mut combine: impl FnMut(L, L) -> L) -> Self {
        for (ours, theirs) in self.0.iter_mut().zip(other.0) {
            *ours = combine(*ours, theirs);
        }
        self
    }
}

macro_rules! element_wise {
    ($($trait:ident $method:ident)*) => {$(
        impl<L: Lanes, const K: usize> $trait for Spectrum<L, K> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, L::$method)
            }
        }
    )*};
}

element_wise!(Add add Sub sub Mul mul Div div);

impl<L: Lanes, const K: usize> Neg for Spectrum<L, K> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(filled(L::ZERO, |pack| -self.0[pack]))
    }
}

/// Pack `pack`; for `Spectrum<f32, K>` that is channel `pack`. Panics beyond the last one.
impl<L, const K: usize> Index<usize> for Spectrum<L, K> {
    type Output = L;
    fn index(&self, pack: usize) -> &L {
        &self.0[pack]
    }
}

/// Pack `pack`, to be written. Panics beyond the last one.
impl<L, const K: usize> IndexMut<usize> for Spectrum<L, K> {
    fn index_mut(&mut self, pack: usize) -> &mut L {
        &mut self.0[pack]
    }
}

impl<L: Lanes, const K: usize> Lanes for Spectrum<L, K> {
    type Scalar = L::Scalar;
    type Wide = Spectrum<L::Wide, K>;
    type Pack = L;
    type Mask = [L::Mask; K];
    type PerLane<T: Copy + core::fmt::Debug> = [L::PerLane<T>; K];
    const LANES: usize = K * L::LANES;
    const PACKS: usize = K;
    const ZERO: Self = Self([L::ZERO; K]);
    const ONE: Self = Self([L::ONE; K]);

    #[inline(always)]
    fn splat(x: L::Scalar) -> Self {
        Self([L::splat(x); K])
    }
    #[inline(always)]
    fn from_fn(mut lane: impl FnMut(usize) -> L::Scalar) -> Self {
        Self(filled(L::ZERO, |pack| L::from_fn(|i| lane(pack * L::LANES + i))))
    }
    #[inline(always)]
    fn get(&self, lane: usize) -> L::Scalar {
        self.0[lane / L::LANES].get(lane % L::LANES)
    }
    #[inline(always)]
    fn pack(&self, pack: usize) -> L {
        self.0[pack]
    }
    #[inline(always)]
    fn set_pack(&mut self, pack: usize, lanes: L) {
        self.0[pack] = lanes;
    }
    #[inline(always)]
    fn widen(self) -> Self::Wide {
        Spectrum(filled(L::Wide::ZERO, |pack| self.0[pack].widen()))
    }
    #[inline(always)]
    fn narrow(wide: Self::Wide) -> Self {
        Self(filled(L::ZERO, |pack| L::narrow(wide.0[pack])))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        filled(L::ZERO.lt(L::ZERO), |pack| self.0[pack].lt(other.0[pack]))
    }
    #[inline(always)]
    fn equal(self, other: Self) -> Self::Mask {
        filled(L::ZERO.lt(L::ZERO), |pack| self.0[pack].equal(other.0[pack]))
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(filled(L::ZERO, |pack| L::select(mask[pack], yes.0[pack], no.0[pack])))
    }
    #[inline(always)]
    fn only(self, mask: Self::Mask) -> Self {
        Self(filled(L::ZERO, |pack| self.0[pack].only(mask[pack])))
    }
    #[inline(always)]
    fn except(self, mask: Self::Mask) -> Self {
        Self(filled(L::ZERO, |pack| self.0[pack].except(mask[pack])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Pixels = Spectrum<Spectrum<f32, 2>, 3>;

    #[test]
    fn channels_are_numbered_pack_by_pack() {
        let x = Pixels::from_fn(|i| i as f32);
        assert_eq!(x, Spectrum([Spectrum([0.0, 1.0]), Spectrum([2.0, 3.0]), Spectrum([4.0, 5.0])]));
        assert_eq!(Pixels::LANES, 6);
        assert_eq!(Pixels::from_fn(|i| x.get(i)), x);
        assert_eq!(x[1][1], 3.0);
        let mut y = x;
        y.set_pack(2, x.pack(1));
        assert_eq!((y, y.pack(0).pack(1)), (Pixels::from_fn(|i| [0.0, 1.0, 2.0, 3.0, 2.0, 3.0][i]), 1.0));
        assert_eq!((Pixels::PACKS, f32::PACKS, 7.0_f64.pack(0)), (3, 1, 7.0));
    }

    #[test]
    fn every_operation_is_the_scalar_one_per_lane() {
        let (a, b) = ([3.0_f32, -1.5, 0.0], [0.5_f32, -0.0, f32::NAN]);
        let (x, y) = (Spectrum(a), Spectrum(b));
        for i in 0..3 {
            let bits = |s: Spectrum<f32, 3>| s.get(i).to_bits();
            assert_eq!(bits(x + y), (a[i] + b[i]).to_bits());
            assert_eq!(bits(x - y), (a[i] - b[i]).to_bits());
            assert_eq!(bits(x * y), (a[i] * b[i]).to_bits());
            assert_eq!(bits(x / y), (a[i] / b[i]).to_bits());
            assert_eq!(bits(-x), (-a[i]).to_bits());
            assert_eq!(x.lt(y)[i], a[i] < b[i]);
            assert_eq!(x.equal(y)[i], a[i] == b[i]);
            assert_eq!(bits(y.only(x.lt(y))), (if a[i] < b[i] { b[i] } else { 0.0 }).to_bits());
            assert_eq!(bits(y.except(x.lt(y))), (if a[i] < b[i] { 0.0 } else { b[i] }).to_bits());
            assert_eq!((x + y).widen().get(i).to_bits(), f64::from(a[i] + b[i]).to_bits());
        }
    }
}
