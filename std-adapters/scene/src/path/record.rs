//! Where the light of one path goes.

use crate::colour::Colour;
use crate::path::pairs::Pairs;
use crate::path::samples::BLOCK;
use crate::path::terms::{Paired, Terms};
use crate::planted::planted;
use ratiocv_core::{Draw, Lanes};

/// Sample number `sample`. Without `AUXILIARY` everything goes to the plain sum.
pub(super) struct Record<'a, C: Colour, const AUXILIARY: bool> {
    plain: C::OnPath,
    terms: &'a Terms,
    pairs: &'a mut Pairs<C>,
    /// Where the pair of the next term goes.
    at: usize,
}

impl<'a, C: Colour, const AUXILIARY: bool> Record<'a, C, AUXILIARY> {
    #[inline(always)]
    pub(super) const fn new(terms: &'a Terms, pairs: &'a mut Pairs<C>, sample: usize) -> Self {
        Self { plain: <C::OnPath>::ZERO, terms, pairs, at: sample }
    }

    /// f and h of light that was sampled.
    #[inline(always)]
    pub(super) fn light(&mut self, depth: usize, f: C::OnPath, h: C::OnPath) {
        self.put(self.terms.light, depth, f, h);
    }

    /// f and h of light that was met.
    #[inline(always)]
    pub(super) fn scattering(&mut self, depth: usize, f: C::OnPath, h: C::OnPath) {
        self.put(self.terms.scattering, depth, f, h);
    }

    /// h of a scattering that meets no light.
    #[inline(always)]
    pub(super) fn dark(&mut self, depth: usize, h: C::OnPath) {
        if AUXILIARY && depth >= self.terms.scattering.from {
            self.next(<C::OnPath>::ZERO, h);
        }
    }

    #[inline(always)]
    fn put(&mut self, paired: Paired, depth: usize, f: C::OnPath, h: C::OnPath) {
        if !AUXILIARY || depth < paired.from {
            self.plain = self.plain + f;
            return;
        }
        if !self.next(f, h)
            && let Some(draw) = self.pairs.draws.get_mut(paired.last * BLOCK + self.at % BLOCK)
        {
            // Deeper than the terms go: with the h that it began with.
            draw.f = draw.f + C::kept(f);
        }
    }

    /// Writes the pair of the next term, if there is one.
    #[inline(always)]
    fn next(&mut self, f: C::OnPath, h: C::OnPath) -> bool {
        let Some(draw) = self.pairs.draws.get_mut(self.at) else { return false };
        *draw = Draw::new(C::kept(f), C::kept(h));
        self.at += BLOCK;
        true
    }

    /// The path has ended: h keeps its value, because E[h] = 1 given all that came before. The light that is in no pair.
    #[inline(always)]
    pub(super) fn end(self, h: C::OnPath) -> Draw<C, 0> {
        if AUXILIARY {
            let h = C::kept(planted!("h_zeroed_at_the_end": h, <C::OnPath>::ZERO));
            if self.at >= self.pairs.distinct && self.pairs.distinct < self.pairs.draws.len() {
                self.pairs.distinguish(self.at);
            }
            let (draws, mut at) = (self.pairs.distinct(), self.at);
            while let Some(draw) = draws.get_mut(at) {
                *draw = Draw::new(C::ZERO, h);
                at += BLOCK;
            }
        }
        Draw { f: C::kept(self.plain), h: [] }
    }
}
