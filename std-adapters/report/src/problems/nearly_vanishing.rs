//! An auxiliary that is almost zero where the integrand is not.

use crate::problems::uniform::uniform;
use crate::problems::{Axis, Curve, Description, Solved, Source};

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct NearlyVanishing;

fn h(x: f64) -> f64 {
    1e-4 + x * x
}

fn f(x: f64) -> f64 {
    0.05 + x * x
}

impl Solved for NearlyVanishing {
    type Value = f64;
    const UNIFORMS: usize = 1;
    const DESCRIPTION: Description = Description {
        id: "nearly-vanishing",
        title: "An auxiliary that nearly vanishes",
        formula: "f = 1/20 + x², h = 1/10000 + x², x uniform on [0, 1]",
        why: "f/h reaches 500: fatal for whatever averages f/h (mean of ratios, Hartley–Ross), harmless for ratios of means; the defensive auxiliary is the remedy.",
    };

    fn exact(&self) -> f64 {
        0.05 + 1.0 / 3.0
    }
    fn source(&self) -> impl Source<Value = f64> {
        uniform(|x| f(*x), |x| h(*x), 1e-4 + 1.0 / 3.0)
    }
    fn channel(&self, _: usize) -> String {
        String::new()
    }
    fn curves(&self) -> (Axis, Vec<Curve>) {
        ("x", Curve::pair(|x| f(x) / self.exact(), |x| h(x) / (1e-4 + 1.0 / 3.0)))
    }
}
