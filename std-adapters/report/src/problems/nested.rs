//! Light that bounces three times, in RGB.

use crate::problems::{Axis, Curve, Description, Role, Solved, Source};
use core::f64::consts::PI;
use rand_core::Rng;
use ratiocv_core::{Lanes, Problem, Proposal, Spectrum, WithIntegral, unit_interval};

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct Nested;

pub(crate) type Rgb = Spectrum<f64, 3>;

/// Bounces.
pub(crate) const BOUNCES: usize = 3;
/// How narrow the lobe of each channel is: ρ of a wrapped Cauchy density.
const CONCENTRATION: [f64; 3] = [0.8, 0.6, 0.1];
/// The same of the one lobe that all turns are drawn from.
const SAMPLED: f64 = 0.45;
/// Where the walls reflect most of each channel.
const BRIGHTEST: [f64; 3] = [1.0 / 2.0, 5.0 / 6.0, 1.0 / 6.0];
/// Where the lamp is.
const LAMP: f64 = 0.1;
/// Where a path begins: x₀.
const START: f64 = 0.5;

/// The share of each channel that the wall at `x` reflects.
fn albedo(x: f64) -> Rgb {
    Spectrum(BRIGHTEST.map(|brightest| 0.5 + 0.3 * libm::cos(2.0 * PI * (x - brightest))))
}

/// What reaches the wall at `x` from the lamp, all channels alike.
fn lamp(x: f64) -> f64 {
    1.0 + 0.8 * libm::cos(2.0 * PI * (x - LAMP))
}

/// The wrapped Cauchy density of a turn whose cosine is `cosine`.
fn density(rho: f64, cosine: f64) -> f64 {
    (1.0 - rho * rho) / (1.0 - 2.0 * rho * cosine + rho * rho)
}

/// The density of a turn by each channel's own lobe, and the one that it is drawn with.
fn lobes(turn: f64) -> (Rgb, f64) {
    let cosine = libm::cos(2.0 * PI * turn);
    (Spectrum(CONCENTRATION.map(|rho| density(rho, cosine))), density(SAMPLED, cosine))
}

/// One bounce: h_d = `albedo`·`lobe`, whose integral over the next point is `albedo`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounce {
    /// H_d: it depends on where the path has come to, its prefix.
    pub(crate) albedo: Rgb,
    /// The channels' own densities of the next point.
    pub(crate) lobe: Rgb,
    /// The density that the next point was drawn with.
    pub(crate) pdf: f64,
}

/// A path from x₀ along three more points of the ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    pub(crate) bounces: [Bounce; BOUNCES],
    /// The lamp's light at the end.
    pub(crate) light: f64,
}

impl Path {
    /// Turn by turn.
    fn along(turns: [f64; BOUNCES]) -> Self {
        let mut x = START;
        let bounces = turns.map(|turn| {
            let (albedo, (lobe, pdf)) = (albedo(x), lobes(turn));
            x += turn;
            Bounce { albedo, lobe, pdf }
        });
        Self { bounces, light: lamp(x) }
    }

    /// Π h_d/H_d: what is left is the product of the lobes.
    pub(crate) fn h(&self) -> Rgb {
        self.bounces.iter().fold(Rgb::ONE, |product, bounce| product * bounce.lobe)
    }

    /// Π f_d, of which the last also sees the lamp.
    pub(crate) fn f(&self) -> Rgb {
        let reflected = self.bounces.iter().fold(Rgb::ONE, |product, bounce| product * bounce.albedo * bounce.lobe);
        reflected * Rgb::splat(self.light)
    }
}

/// Every turn from one lobe, which is no channel's own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OneLobe;

impl Proposal for OneLobe {
    type Point = Path;
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Path {
        Path::along(core::array::from_fn(|_| {
            libm::atan((1.0 - SAMPLED) / (1.0 + SAMPLED) * libm::tan(PI * (unit_interval(rng) - 0.5))) / PI
        }))
    }
    #[inline]
    fn pdf(&self, path: &Path) -> f64 {
        path.bounces.iter().map(|bounce| bounce.pdf).product()
    }
}

/// Points of the ring: the trapezoidal rule over so many is exact for trigonometric polynomials of a
/// degree below that.
const GRID: usize = 8;

/// ∫ lobe(y − x) u(y) dy at any x, for a trigonometric polynomial u of degree 3 at most, and a lobe
/// whose n-th Fourier coefficient is `damping(n)`, of which three then are enough.
fn through(damping: &dyn Fn(usize) -> f64, u: &dyn Fn(f64) -> f64, x: f64) -> f64 {
    let lobe = |turn: f64| (1..=3).fold(1.0, |sum, n| sum + 2.0 * damping(n) * libm::cos(2.0 * PI * n as f64 * turn));
    let points = (0..GRID).map(|i| i as f64 / GRID as f64);
    points.map(|y| lobe(y - x) * u(y)).sum::<f64>() / GRID as f64
}

/// The Fourier coefficients ρⁿ of a lobe.
fn powers(rho: f64) -> impl Fn(usize) -> f64 {
    move |n| libm::pow(rho, n as f64)
}

/// What the wall at `x` reflects of `channel` after two more bounces by lobes of coefficients `damping`.
fn reflected_at(channel: usize, damping: &dyn Fn(usize) -> f64, x: f64) -> f64 {
    let third = |x: f64| albedo(x)[channel] * through(damping, &lamp, x);
    albedo(x)[channel] * through(damping, &third, x)
}

/// What x₀ reflects if the first bounce has the lobe of `channel`, and the others that of `damping`.
fn reflected(channel: usize, damping: &dyn Fn(usize) -> f64) -> f64 {
    albedo(START)[channel] * through(&powers(CONCENTRATION[channel]), &|x| reflected_at(channel, damping, x), START)
}

impl Nested {
    /// H₁: all paths begin at the same place.
    pub(crate) fn first_integral() -> Rgb {
        albedo(START)
    }

    /// What the naive nested ratio converges to: behind the first bounce every channel sees the lobe that
    /// was sampled in place of its own.
    pub(crate) fn naive_limit() -> Rgb {
        Rgb::from_fn(|channel| reflected(channel, &powers(SAMPLED)))
    }
}

impl Solved for Nested {
    type Value = Rgb;
    const UNIFORMS: usize = BOUNCES;
    const DESCRIPTION: Description = Description {
        id: "nested",
        title: "Three bounces, nested",
        formula: "f = Π c(x_{d−1}) p(x_d − x_{d−1}) · l(x₃), d = 1, 2, 3, on a ring of length 1, x₀ = 1/2; channel j's lobe p_j is \
                  wrapped Cauchy with ρ = 0.8, 0.6, 0.1; walls c_j(x) = 1/2 + 3/10 cos(2π(x − 1/2 − j/3)); lamp l(x) \
                  = 1 + 4/5 cos(2π(x − 0.1)); h = Π h_d/H_d(prefix) with h_d = c p, H_d = c(x_{d−1}); every turn is \
                  drawn from such a lobe with ρ = 0.45",
        why: "A path: each integral is inside the one before it, and its auxiliary's integral depends on the path so far. \
              The product of all h_d/H_d has the integral 1.",
    };

    fn exact(&self) -> Rgb {
        Rgb::from_fn(|channel| reflected(channel, &powers(CONCENTRATION[channel])))
    }
    fn source(&self) -> impl Source<Value = Rgb> {
        Problem::new(Path::f).auxiliary(WithIntegral::new(Path::h, Rgb::ONE)).proposal(OneLobe)
    }
    fn channel(&self, channel: usize) -> String {
        ["red", "green", "blue"][channel].into()
    }
    fn curves(&self) -> (Axis, Vec<Curve>) {
        let exact = self.exact();
        let mut curves = Vec::new();
        for j in 0..3 {
            // Over the first bounce, the others integrated.
            let rest = |x: f64| reflected_at(j, &powers(CONCENTRATION[j]), x);
            let f = |x: f64| albedo(START)[j] * lobes(x - START).0[j] * rest(x) / exact[j];
            curves.push(Curve::of(self.channel(j), j, Role::Integrand, f));
            curves.push(Curve::of(self.channel(j), j, Role::Auxiliary, |x| lobes(x - START).0[j]));
        }
        curves.push(Curve::of(String::new(), 0, Role::Proposal, |x| lobes(x - START).1));
        ("x₁, the first point", curves)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ over three turns of `f`, by the midpoint rule with `n` points each: off by some 0.8ⁿ.
    fn integral(n: usize, f: impl Fn(&Path) -> Rgb) -> Rgb {
        let turn = |i: usize| (i as f64 + 0.5) / n as f64 - 0.5;
        let mut sum = Rgb::ZERO;
        for i in 0..n {
            for k in 0..n {
                for l in 0..n {
                    sum = sum + f(&Path::along([turn(i), turn(k), turn(l)]));
                }
            }
        }
        sum / Rgb::splat((n * n * n) as f64)
    }

    fn equal(ours: Rgb, right: Rgb) {
        for channel in 0..3 {
            let off = libm::fabs(ours[channel] / right[channel] - 1.0);
            assert!(off <= 1e-7, "{channel}: {} for {}", ours[channel], right[channel]);
        }
    }

    #[test]
    fn the_closed_form_is_the_integral() {
        equal(Nested.exact(), integral(100, Path::f));
        equal(Rgb::ONE, integral(100, Path::h));
    }

    #[test]
    fn the_naive_limit_is_that_of_its_draws() {
        // E[y₁·H₂·(y₂/x₂)·H₃·(y₃/x₃)] with x₂, x₃ drawn from the one lobe (golden `naive_limit`).
        let limit = integral(100, |path| {
            let [first, second, third] = &path.bounces;
            let drawn = Rgb::splat(second.pdf * third.pdf * path.light);
            first.albedo * first.lobe * second.albedo * third.albedo * drawn
        });
        equal(Nested::naive_limit(), limit);
        let off = Nested::naive_limit() / Nested.exact();
        assert!((0..3).all(|channel| libm::fabs(off[channel] - 1.0) > 0.05), "{off:?}");
    }
}
