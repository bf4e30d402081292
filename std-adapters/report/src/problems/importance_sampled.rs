//! Draws that follow neither the integrand nor the auxiliary quite.

use crate::problems::truncated::TruncatedExponential;
use crate::problems::{Axis, Curve, Description, Role, Solved, Source};
use core::f64::consts::PI;
use rand_core::Rng;
use ratiocv_core::{Problem, Proposal, WithIntegral, unit_interval};

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct ImportanceSampled;

/// The decay of f and h.
const DECAY: f64 = 4.0;
/// The decay of the sampling density.
const SAMPLED: f64 = 6.0;
const OMEGA: f64 = 4.0 * PI;

/// ∫h.
fn integral() -> f64 {
    -libm::expm1(-DECAY) / DECAY
}

fn h(x: f64) -> f64 {
    libm::exp(-DECAY * x)
}

fn f(x: f64) -> f64 {
    h(x) * (1.0 + 0.5 * libm::cos(OMEGA * x))
}

impl Proposal for TruncatedExponential {
    type Point = f64;
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> f64 {
        self.quantile(unit_interval(rng))
    }
    #[inline]
    fn pdf(&self, x: &f64) -> f64 {
        self.pdf(*x)
    }
}

impl Solved for ImportanceSampled {
    type Value = f64;
    const UNIFORMS: usize = 1;
    const DESCRIPTION: Description = Description {
        id: "importance-sampled",
        title: "Importance sampling by a third function",
        formula: "f = h (1 + cos(4πx)/2), h = exp(−4x), x on [0, 1] with density ∝ exp(−6x)",
        why: "Draws from a density g that is neither f nor h, so y = f/g and x = h/g: the usual case in a renderer.",
    };

    fn exact(&self) -> f64 {
        integral() * (1.0 + 0.5 * TruncatedExponential::new(DECAY).cosine(OMEGA))
    }
    fn source(&self) -> impl Source<Value = f64> {
        Problem::new(|x: &f64| f(*x))
            .auxiliary(WithIntegral::new(|x: &f64| h(*x), integral()))
            .proposal(TruncatedExponential::new(SAMPLED))
    }
    fn channel(&self, _: usize) -> String {
        String::new()
    }
    fn curves(&self) -> (Axis, Vec<Curve>) {
        let g = TruncatedExponential::new(SAMPLED);
        let mut curves = Curve::pair(|x| f(x) / self.exact(), |x| h(x) / integral());
        curves.push(Curve::of(String::new(), 0, Role::Proposal, |x| g.pdf(x)));
        ("x", curves)
    }
}
