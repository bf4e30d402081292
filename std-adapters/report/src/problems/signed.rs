//! An integrand that changes its sign.

use crate::problems::uniform::uniform;
use crate::problems::{Axis, Curve, Description, Solved, Source};
use core::f64::consts::PI;

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct Signed;

fn h(x: f64) -> f64 {
    1.0 + 0.9 * libm::cos(2.0 * PI * x)
}

fn f(x: f64) -> f64 {
    0.25 + libm::cos(2.0 * PI * x) + 0.2 * libm::sin(6.0 * PI * x)
}

impl Solved for Signed {
    type Value = f64;
    const UNIFORMS: usize = 1;
    const DESCRIPTION: Description = Description {
        id: "signed",
        title: "A signed integrand",
        formula: "f = 1/4 + cos(2πx) + sin(6πx)/5, h = 1 + 9cos(2πx)/10, x uniform on [0, 1]",
        why: "Well correlated, but F is small beside the swing of f: the ratio takes away only F/H times h, too little.",
    };

    fn exact(&self) -> f64 {
        0.25
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
