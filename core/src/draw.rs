//! What a renderer has in its hands after one sample.

use crate::filled::filled;
use crate::lanes::Lanes;
use crate::spectrum::Spectrum;

/// One draw X ~ g, element-wise over the channels: `f` = f(X)/g(X) and, for each of the `K`
/// auxiliaries, `h[k]` = h_k(X)/g(X). Both are already divided by the pdf.
///
/// ```
/// use ratiocv_core::{Draw, Spectrum};
/// // f/pdf, and p_j/pdf: how much likelier each channel's own technique would have been.
/// let draw = Draw::new(Spectrum([0.9_f32, 0.4, 0.1]), Spectrum([1.5, 0.8, 0.7]));
/// assert_eq!(draw.h[0][2], 0.7);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw<V, const K: usize = 1> {
    /// The integrand over the pdf.
    pub f: V,
    /// Each auxiliary over the pdf.
    pub h: [V; K],
}

impl<V> Draw<V> {
    /// A draw with one auxiliary.
    #[inline(always)]
    pub const fn new(f: V, h: V) -> Self {
        Self { f, h: [h] }
    }
}

impl<V: Lanes, const K: usize> Draw<V, K> {
    /// 0 everywhere.
    pub const ZERO: Self = Self { f: V::ZERO, h: [V::ZERO; K] };

    /// The same draw in `f64` lanes, exactly.
    #[inline(always)]
    pub fn widen(&self) -> Draw<V::Wide, K> {
        self.map(V::widen)
    }

    /// The draw of one channel, read in place: a copy of all lanes for each of them would cost their square.
    #[inline(always)]
    pub(crate) fn channel(&self, channel: usize) -> Draw<V::Scalar, K> {
        Draw { f: self.f.get(channel), h: core::array::from_fn(|k| self.h[k].get(channel)) }
    }

    /// `change` of every entry.
    #[inline(always)]
    pub(crate) fn map<U: Lanes>(self, mut change: impl FnMut(V) -> U) -> Draw<U, K> {
        Draw { f: change(self.f), h: filled(U::ZERO, |k| change(self.h[k])) }
    }

    /// `combine` of the entries of two draws.
    #[inline(always)]
    pub(crate) fn zip(self, other: Self, mut combine: impl FnMut(V, V) -> V) -> Self {
        Self { f: combine(self.f, other.f), h: filled(V::ZERO, |k| combine(self.h[k], other.h[k])) }
    }

    /// `P` draws as one of `P` times as many channels.
    #[inline(always)]
    pub(crate) fn side_by_side<const P: usize>(draws: &[Self; P]) -> Draw<Spectrum<V, P>, K> {
        let mut wide = Draw::<Spectrum<V, P>, K>::ZERO;
        for (i, draw) in draws.iter().enumerate() {
            wide.f.0[i] = draw.f;
            for (wide, h) in wide.h.iter_mut().zip(draw.h) {
                wide.0[i] = h;
            }
        }
        wide
    }

    /// The draw with auxiliary `k` alone; panics if there is no such auxiliary.
    #[inline(always)]
    pub fn auxiliary(&self, k: usize) -> Draw<V> {
        Draw::new(self.f, self.h[k])
    }
}
