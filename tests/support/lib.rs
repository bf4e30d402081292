//! What the tests share: tolerance checks, golden files, exact enumeration.

pub mod alone;
pub mod enumerate;
pub mod golden;
pub mod population;
pub mod samples;
pub mod sum;

/// The README's example, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
#[derive(Debug)]
pub struct Readme;

/// Panics unless `|ours − right| ≤ tolerance`, so that a NaN on either side fails.
#[track_caller]
pub fn assert_close(ours: f64, right: f64, tolerance: f64, what: &str) {
    let error = (ours - right).abs();
    assert!(
        ours == right || error <= tolerance,
        "{what}: {ours:e} should be {right:e}; off by {error:e}, allowed {tolerance:e}"
    );
}
