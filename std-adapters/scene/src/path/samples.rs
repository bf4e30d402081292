//! What a kernel yields.

use crate::Scene;
use crate::colour::Colour;
use crate::geometry::Beam;
use crate::light::Weights;
use crate::planted::planted;
use ratiocv_core::Draw;

/// Samples in a block.
pub const BLOCK: usize = 64;

/// The samples of one block of one pixel, to be used again and again.
///
/// The light of a sample is that of `plain` + Σ f over the pairs of all terms; each pair's h has the integral 1 in every
/// channel.
#[derive(Clone, Debug)]
pub struct Samples<C> {
    pub(super) plain: [Draw<C, 0>; BLOCK],
    pub(super) pairs: Pairs<C>,
    pub(super) weights: Weights,
    count: usize,
}

impl<C: Colour> Samples<C> {
    /// Room for the samples of `scene`.
    pub fn new(scene: &Scene<C>) -> Self {
        Self {
            plain: [Draw::ZERO; BLOCK],
            pairs: Pairs::new(scene.terms().len()),
            weights: Weights::new(scene.lights.lights.len()),
            count: 0,
        }
    }

    /// Room for `count` samples of another block.
    pub(crate) fn begin(&mut self, count: usize) {
        self.count = count;
        self.pairs.begin();
    }

    /// How many there are.
    pub const fn count(&self) -> usize {
        self.count
    }

    /// Light whose h is 1.
    pub fn plain(&self) -> &[Draw<C, 0>] {
        &self.plain[..self.count]
    }

    /// f and h of term number `term` of [`Scene::terms`], which must exist.
    pub fn pairs(&self, term: usize) -> &[Draw<C>] {
        // Where there are terms, the first is distinct.
        &self.pairs.draws[term.min(self.distinct().saturating_sub(1)) * BLOCK..][..self.count]
    }

    /// How many terms may have pairs of their own, from the first on: the others have those of the last of these.
    pub const fn distinct(&self) -> usize {
        self.pairs.distinct / BLOCK
    }
}

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
    fn new(terms: usize) -> Self {
        Self { draws: vec![Draw::ZERO; terms * BLOCK], distinct: 0 }
    }

    fn begin(&mut self) {
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
