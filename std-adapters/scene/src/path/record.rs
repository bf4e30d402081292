//! Where the light of one path goes.

use crate::colour::Colour;
use crate::path::samples::BLOCK;
use crate::path::terms::{Paired, Terms};
use crate::planted::planted;
use ratiocv_core::Draw;

/// Sample number `sample`. Without `AUXILIARY` everything goes to the plain sum.
pub(super) struct Record<'a, C, const AUXILIARY: bool> {
    pub(super) plain: C,
    terms: &'a Terms,
    pairs: &'a mut [[Draw<C>; BLOCK]],
    sample: usize,
    /// Terms that were written: the number of the next.
    written: usize,
}

impl<'a, C: Colour, const AUXILIARY: bool> Record<'a, C, AUXILIARY> {
    #[inline(always)]
    pub(super) const fn new(terms: &'a Terms, pairs: &'a mut [[Draw<C>; BLOCK]], sample: usize) -> Self {
        Self { plain: C::ZERO, terms, pairs, sample, written: 0 }
    }

    /// f and h of light that was sampled.
    #[inline(always)]
    pub(super) fn light(&mut self, depth: usize, f: C, h: C) {
        self.put(self.terms.light, depth, f, h);
    }

    /// f and h of light that was met.
    #[inline(always)]
    pub(super) fn scattering(&mut self, depth: usize, f: C, h: C) {
        self.put(self.terms.scattering, depth, f, h);
    }

    #[inline(always)]
    fn put(&mut self, paired: Paired, depth: usize, f: C, h: C) {
        if !AUXILIARY || depth < paired.from {
            self.plain = self.plain + f;
            return;
        }
        // The remainder is the number itself, and needs no check.
        let place = self.sample % BLOCK;
        if let Some(draws) = self.pairs.get_mut(self.written) {
            draws[place] = Draw::new(f, h);
            self.written += 1;
        } else if let Some(draws) = self.pairs.get_mut(paired.last) {
            // Deeper than the terms go: with the h that it began with.
            draws[place].f = draws[place].f + f;
        }
    }

    /// The path has ended: h keeps its value, because E[h] = 1 given all that came before.
    #[inline(always)]
    pub(super) fn end(self, h: C) -> C {
        if AUXILIARY {
            let h = planted!("h_zeroed_at_the_end": h, C::ZERO);
            for draws in &mut self.pairs[self.written..] {
                draws[self.sample % BLOCK] = Draw::new(C::ZERO, h);
            }
        }
        self.plain
    }
}
