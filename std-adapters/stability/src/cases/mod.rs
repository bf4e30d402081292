//! The cases, a file for each section.

mod bad_draws;
mod cancellation;
mod counts;
mod denominators;
mod estimators;
mod nested;
mod platform;
mod range;
mod several;
mod strd;
mod weights;
mod widened;

use crate::case::{Case, Precision};

/// A section.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Its letter, with which the ids of its cases begin.
    pub name: &'static str,
    /// What it is about.
    pub title: &'static str,
    cases: fn() -> Vec<Case>,
}

/// All sections.
pub const SECTIONS: &[Section] = &[
    Section { name: "A", title: "Denominators", cases: denominators::cases },
    Section { name: "B", title: "Dynamic range", cases: ranges },
    Section { name: "C", title: "Offsets, constants, cancellation", cases: cancellation::cases },
    Section { name: "D", title: "Counts, few draws, merges", cases: counts::cases },
    Section { name: "E", title: "The estimators' own formulas", cases: formulas },
    Section { name: "F", title: "Bad draws, signs of zero, lanes", cases: bad_draws::cases },
    Section { name: "G", title: "Nested, stiff, heavy-tailed", cases: nested::cases },
    Section { name: "H", title: "Platform", cases: platform::cases },
    Section { name: "StRD", title: "Constructible sets of NIST's Statistical Reference Datasets", cases: strd::cases },
];

fn ranges() -> Vec<Case> {
    [range::cases(), widened::cases()].into_iter().flatten().collect()
}

fn formulas() -> Vec<Case> {
    [estimators::cases(), several::cases(), weights::cases()].into_iter().flatten().collect()
}

pub use strd::condition_of_wampler;

/// All of them.
pub fn all() -> Vec<Case> {
    SECTIONS.iter().flat_map(|section| (section.cases)()).collect()
}

/// Those of this id (`C7`), or of this section (`C`).
pub fn named(id: &str) -> Vec<Case> {
    let section = SECTIONS.iter().filter(|section| section.name == section_of(id));
    section.flat_map(|section| (section.cases)()).filter(|case| case.id == id || case.section() == id).collect()
}

/// The section of a case: the letter of its id, or what is before the hyphen.
pub(crate) fn section_of(id: &str) -> &str {
    id.split('-').next().and_then(|part| part.split(|c: char| c.is_ascii_digit()).next()).unwrap_or_default()
}

/// `make` for each precision.
fn both(make: impl Fn(Precision) -> Vec<Case>) -> Vec<Case> {
    Precision::BOTH.into_iter().flat_map(make).collect()
}
