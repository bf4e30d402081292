//! An auxiliary that falls where the integrand rises.

use crate::problems::uniform::uniform;
use crate::problems::{Axis, Curve, Description, Solved, Source};
use core::f64::consts::PI;

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct NegativeCorrelation;

fn h(x: f64) -> f64 {
    0.5 + x
}

fn f(x: f64) -> f64 {
    1.5 - x + 0.1 * libm::cos(2.0 * PI * x)
}

impl Solved for NegativeCorrelation {
    type Value = f64;
    const UNIFORMS: usize = 1;
    const DESCRIPTION: Description = Description {
        id: "negative-correlation",
        title: "Negative correlation",
        formula: "f = 3/2 − x + cos(2πx)/10, h = 1/2 + x, x uniform on [0, 1]",
        why: "A ratio assumes that f rises with h; here it doubles the noise. A fitted coefficient turns the sign.",
    };

    fn exact(&self) -> f64 {
        1.0
    }
    fn source(&self) -> impl Source<Value = f64> {
        uniform(|x| f(*x), |x| h(*x), 1.0)
    }
    fn channel(&self, _: usize) -> String {
        String::new()
    }
    fn curves(&self) -> (Axis, Vec<Curve>) {
        ("x", Curve::pair(|x| f(x) / self.exact(), |x| h(x) / 1.0))
    }
}
