//! What a kernel yields.

use crate::Scene;
use crate::colour::Colour;
use crate::light::Weights;
use crate::path::pairs::Pairs;
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

    /// f and h of term number `term` of [`Scene::terms`]; empty if there is no such term.
    pub fn pairs(&self, term: usize) -> &[Draw<C>] {
        let (terms, _) = self.pairs.draws.as_chunks::<BLOCK>();
        // What is not distinct has the pairs of the last that is.
        let kept = terms.get(term).and(terms.get(term.min(self.distinct().saturating_sub(1))));
        kept.map_or(&[], |draws| &draws[..self.count])
    }

    /// How many terms may have pairs of their own, from the first on: the others have those of the last of these.
    pub const fn distinct(&self) -> usize {
        self.pairs.distinct / BLOCK
    }
}
