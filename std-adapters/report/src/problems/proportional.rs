//! An integrand that is a multiple of the auxiliary.

use crate::problems::uniform::uniform;
use crate::problems::{Axis, Curve, Description, Solved, Source};

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct Proportional;

fn h(x: f64) -> f64 {
    0.5 + x * x
}

fn f(x: f64) -> f64 {
    2.5 * h(x)
}

impl Solved for Proportional {
    type Value = f64;
    const UNIFORMS: usize = 1;
    const DESCRIPTION: Description = Description {
        id: "proportional",
        title: "An auxiliary proportional to the integrand",
        formula: "f = 5h/2, h = 1/2 + x², x uniform on [0, 1]",
        why: "Every ratio is exact from the first draw on; what remains is rounding.",
    };

    fn exact(&self) -> f64 {
        2.5 * (0.5 + 1.0 / 3.0)
    }
    fn source(&self) -> impl Source<Value = f64> {
        uniform(|x| f(*x), |x| h(*x), 0.5 + 1.0 / 3.0)
    }
    fn channel(&self, _: usize) -> String {
        String::new()
    }
    fn curves(&self) -> (Axis, Vec<Curve>) {
        ("x", Curve::pair(|x| f(x) / self.exact(), |x| h(x) / (0.5 + 1.0 / 3.0)))
    }
}
