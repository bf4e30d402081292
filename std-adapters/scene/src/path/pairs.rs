//! The pairs (f, h) of a block of samples, but for those that are alike.

use crate::colour::Colour;
use crate::geometry::Beam;
use crate::path::samples::BLOCK;
use crate::planted::planted;
use ratiocv_core::Draw;

/// The pairs of each term of a block. Paths that end leave (0, h) in all deeper terms, so that those beyond the
/// deepest that was reached are alike: one of them stands for all.
#[derive(Clone, Debug)]
pub(super) struct Pairs<C> {
    /// Of term k and sample i at k·[`BLOCK`] + i.
    pub(super) draws: Vec<Draw<C>>,
    /// Draws of the terms that were reached and of the next one, if there is one.
    pub(super) distinct: usize,
}

impl<C: Colour> Pairs<C> {
    /// Room for so many terms.
    pub(super) fn new(terms: usize) -> Self {
        Self { draws: vec![Draw::ZERO; terms * BLOCK], distinct: 0 }
    }

    /// Another block begins: no term has been reached.
    pub(super) fn begin(&mut self) {
        self.distinct = self.draws.len().min(BLOCK);
    }

    /// The draws of distinct terms.
    #[inline(always)]
    pub(super) fn distinct(&mut self) -> &mut [Draw<C>] {
        // Never fewer; a check that cannot fail is cheaper than one that may panic.
        let end = self.distinct.min(self.draws.len());
        &mut self.draws[..end]
    }

    /// Makes all samples of a beam like its first, number `first`.
    #[inline(always)]
    pub(super) fn repeat(&mut self, first: usize) {
        let (beams, _) = self.distinct().as_chunks_mut();
        for beam in beams.iter_mut().skip(first / Beam::RAYS).step_by(BLOCK / Beam::RAYS) {
            *beam = [beam[0]; Beam::RAYS];
        }
    }

    /// A path has come to the term of the draw at `at`: it needs draws of its own, as the samples before left them.
    // Out of line: once or twice per block.
    #[inline(never)]
    pub(super) fn distinguish(&mut self, at: usize) {
        let sample = planted!("unreached_terms_forgotten": at % BLOCK, 0);
        while at >= self.distinct {
            let (known, rest) = self.draws.split_at_mut(self.distinct);
            let (Some(last), Some(next)) = (known.last_chunk::<BLOCK>(), rest.first_chunk_mut::<BLOCK>()) else {
                return;
            };
            next[..sample].copy_from_slice(&last[..sample]);
            self.distinct += BLOCK;
        }
    }
}
