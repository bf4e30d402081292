//! An auxiliary that has nothing to do with the integrand.

use crate::problems::uniform::uniform;
use crate::problems::{Axis, Curve, Description, Solved, Source};
use core::f64::consts::PI;

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct BadlyCorrelated;

fn h(x: f64) -> f64 {
    0.3 + 1.4 * x
}

fn f(x: f64) -> f64 {
    let s = libm::sin(2.0 * PI * x);
    0.2 + s * s
}

impl Solved for BadlyCorrelated {
    type Value = f64;
    const UNIFORMS: usize = 1;
    const DESCRIPTION: Description = Description {
        id: "badly-correlated",
        title: "A badly correlated auxiliary",
        formula: "f = 1/5 + sin²(2πx), h = 3/10 + 7x/5, x uniform on [0, 1]",
        why: "Where ratios lose: f and h are uncorrelated, so dividing by the mean of h adds its noise to that of f.",
    };

    fn exact(&self) -> f64 {
        0.7
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
