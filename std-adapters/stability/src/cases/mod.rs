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

use crate::case::{Case, Precision};

/// The sections and what they are about.
pub const SECTIONS: &[(&str, &str)] = &[
    ("A", "Denominators"),
    ("B", "Dynamic range"),
    ("C", "Offsets, constants, cancellation"),
    ("D", "Counts, few draws, merges"),
    ("E", "The estimators' own formulas"),
    ("F", "Bad draws, signs of zero, lanes"),
    ("G", "Nested, stiff, heavy-tailed"),
    ("H", "Platform"),
    ("StRD", "Constructible sets of NIST's Statistical Reference Datasets"),
];

pub use strd::condition_of_wampler;

/// All of them.
pub fn all() -> Vec<Case> {
    let sections = [
        denominators::cases(),
        range::cases(),
        cancellation::cases(),
        counts::cases(),
        estimators::cases(),
        several::cases(),
        weights::cases(),
        bad_draws::cases(),
        nested::cases(),
        platform::cases(),
        strd::cases(),
    ];
    sections.into_iter().flatten().collect()
}

/// Those of this id (`C7`), or of this section (`C`).
pub fn named(id: &str) -> Vec<Case> {
    all().into_iter().filter(|case| case.id == id || case.section() == id).collect()
}

/// `make` for each precision.
fn both(make: impl Fn(Precision) -> Vec<Case>) -> Vec<Case> {
    Precision::BOTH.into_iter().flat_map(make).collect()
}
