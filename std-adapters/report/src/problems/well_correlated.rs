//! An auxiliary that follows the integrand.

use crate::problems::uniform::uniform;
use crate::problems::{Axis, Curve, Description, Solved, Source};
use core::f64::consts::PI;

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct WellCorrelated;

fn h(x: f64) -> f64 {
    let s = libm::sin(PI * x);
    0.3 + s * s
}

fn f(x: f64) -> f64 {
    h(x) * (1.0 + 0.2 * libm::cos(2.0 * PI * x) + 0.1 * x)
}

impl Solved for WellCorrelated {
    type Value = f64;
    const UNIFORMS: usize = 1;
    const DESCRIPTION: Description = Description {
        id: "well-correlated",
        title: "A well-correlated auxiliary",
        formula: "f = h (1 + cos(2πx)/5 + x/10), h = 3/10 + sin²(πx), x uniform on [0, 1]",
        why: "What ratios are made for: f/h varies little, so most of the noise of f is that of h.",
    };

    fn exact(&self) -> f64 {
        // ∫h = 0.8, ∫h cos(2πx) = −1/4, ∫hx = 0.4 (h is symmetric about 1/2).
        0.8 - 0.2 * 0.25 + 0.1 * 0.4
    }
    fn source(&self) -> impl Source<Value = f64> {
        uniform(|x| f(*x), |x| h(*x), 0.8)
    }
    fn channel(&self, _: usize) -> String {
        String::new()
    }
    fn curves(&self) -> (Axis, Vec<Curve>) {
        ("x", Curve::pair(|x| f(x) / self.exact(), |x| h(x) / 0.8))
    }
}
