//! The pairs (f, h) that a scene's paths yield: one per depth and technique.

use crate::needs::Needs;
use core::fmt;

/// Deeper light is in the pair of this depth.
const DEEPEST: usize = 8;

/// How light was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Technique {
    /// By sampling a light.
    Light,
    /// By a ray that met it: of the camera, or scattered.
    Scattering,
}

/// The light of one pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term {
    /// How it was found.
    pub technique: Technique,
    /// The length of its paths, as Mitsuba counts: 1 is seen directly.
    pub depth: usize,
    /// Longer paths are in it too.
    pub and_deeper: bool,
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let technique = if self.technique == Technique::Light { "light" } else { "scattering" };
        let deeper = if self.and_deeper { " and deeper" } else { "" };
        write!(f, "{technique}, depth {}{deeper}", self.depth)
    }
}

/// Which depths of a technique have terms: all from one on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paired {
    /// The first; beyond any depth if none has one, and h is 1 in all.
    pub(super) from: usize,
    /// The number of the last term, which deeper light is in too.
    pub(super) last: usize,
}

impl Paired {
    const NONE: Self = Self { from: usize::MAX, last: 0 };

    fn add(&mut self, depth: usize, number: usize) {
        *self = Self { from: self.from.min(depth), last: number };
    }
}

/// The terms, in the order in which a path comes to them: it passes none by, so that the next one need not be looked up.
#[derive(Debug)]
pub(crate) struct Terms {
    pub(super) light: Paired,
    pub(super) scattering: Paired,
    pub(crate) terms: Vec<Term>,
}

impl Terms {
    pub(crate) fn new(needs: &Needs) -> Self {
        let mut terms = Self { light: Paired::NONE, scattering: Paired::NONE, terms: Vec::new() };
        if !needs.auxiliary {
            return terms;
        }
        let limit = needs.depth.map_or(usize::MAX, |depth| depth as usize);
        // What the vertices before it were sampled by: light that is sampled at a conductor is not reflected by it yet.
        let path = |reflections: usize| needs.coloured_media || needs.coloured_conductors && reflections > 0;
        for depth in 1..=limit.min(DEEPEST) {
            let term = |technique| Term { technique, depth, and_deeper: depth == DEEPEST && limit > DEEPEST };
            if depth > 1 && needs.light_sampling && (needs.coloured_lights || path(depth - 2)) {
                terms.light.add(depth, terms.terms.len());
                terms.terms.push(term(Technique::Light));
            }
            if (depth == 1 || needs.scattering) && path(depth - 1) {
                terms.scattering.add(depth, terms.terms.len());
                terms.terms.push(term(Technique::Scattering));
            }
        }
        terms
    }
}
