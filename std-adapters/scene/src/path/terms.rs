//! The pairs (f, h) that a scene's paths yield: one per depth and technique.

use crate::needs::Needs;
use core::fmt;

/// Deeper light is in the pair of this depth.
const DEEPEST: usize = 8;

/// Light that goes to the plain sum.
pub(super) const PLAIN: u8 = u8::MAX;

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

/// Which term each depth of each technique goes to; in the order in which a path comes to them.
#[derive(Debug)]
pub(crate) struct Terms {
    /// By depth, [`DEEPEST`] at most; [`PLAIN`] where h is 1.
    light: [u8; DEEPEST + 1],
    scattering: [u8; DEEPEST + 1],
    pub(crate) terms: Vec<Term>,
}

impl Terms {
    pub(crate) fn new(needs: &Needs) -> Self {
        let mut terms = Self { light: [PLAIN; DEEPEST + 1], scattering: [PLAIN; DEEPEST + 1], terms: Vec::new() };
        if !needs.auxiliary {
            return terms;
        }
        let limit = needs.depth.map_or(usize::MAX, |depth| depth as usize);
        // What the vertices before it were sampled by: light that is sampled at a conductor is not reflected by it yet.
        let path = |reflections: usize| needs.coloured_media || needs.coloured_conductors && reflections > 0;
        for depth in 1..=limit.min(DEEPEST) {
            let term = |technique| Term { technique, depth, and_deeper: depth == DEEPEST && limit > DEEPEST };
            let number = terms.terms.len() as u8;
            if depth > 1 && needs.light_sampling && (needs.coloured_lights || path(depth - 2)) {
                terms.light[depth] = number;
                terms.terms.push(term(Technique::Light));
            }
            let number = terms.terms.len() as u8;
            if (depth == 1 || needs.scattering) && path(depth - 1) {
                terms.scattering[depth] = number;
                terms.terms.push(term(Technique::Scattering));
            }
        }
        terms
    }

    #[inline(always)]
    pub(super) fn light(&self, depth: usize) -> u8 {
        self.light[depth.min(DEEPEST)]
    }

    #[inline(always)]
    pub(super) fn scattering(&self, depth: usize) -> u8 {
        self.scattering[depth.min(DEEPEST)]
    }
}
