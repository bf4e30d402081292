//! Functions of one number, sampled uniformly.

use crate::problems::Source;
use ratiocv_core::{Problem, Uniform, WithIntegral};

/// f and h of a uniform x in [0, 1], ∫h = `integral`.
///
/// Function pointers, so that all such problems share their machine code: each would add half a minute to a
/// build. A renderer's integrand is not inlined either.
pub(super) fn uniform(f: fn(&f64) -> f64, h: fn(&f64) -> f64, integral: f64) -> impl Source<Value = f64> {
    Problem::new(f).auxiliary(WithIntegral::new(h, integral)).proposal(Uniform)
}
