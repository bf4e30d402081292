//! Thirty-two wavelengths, sampled by their mean.

use crate::problems::truncated::TruncatedExponential;
use crate::problems::{Axis, Curve, Description, Role, Solved, Source};
use core::f64::consts::PI;
use rand_core::Rng;
use ratiocv_core::{Problem, Proposal, Spectrum, WithIntegral, unit_interval};

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct MeanSpectrum;

const WAVELENGTHS: usize = 32;
const OMEGA: f64 = 4.0 * PI;
type Wavelengths = Spectrum<f64, WAVELENGTHS>;

/// In nm.
fn wavelength(k: usize) -> f64 {
    400.0 + 10.0 * k as f64
}

/// How deep light of each wavelength gets: an extinction ∝ λ⁻⁴, as in air (Rayleigh).
fn depths() -> [TruncatedExponential; WAVELENGTHS] {
    core::array::from_fn(|k| {
        let ratio = 400.0 / wavelength(k);
        TruncatedExponential::new(8.0 * ratio * ratio * ratio * ratio)
    })
}

/// A depth and the density of every wavelength there, which the proposal, f and h all need.
type Depth = (f64, Wavelengths);

/// The mean of the wavelengths' densities.
#[derive(Clone, Copy, Debug)]
struct Mean([TruncatedExponential; WAVELENGTHS]);

impl Mean {
    fn at(&self, t: f64) -> Depth {
        (t, Spectrum(self.0.map(|density| density.pdf(t))))
    }
}

impl Proposal for Mean {
    type Point = Depth;
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Depth {
        let k = (unit_interval(rng) * WAVELENGTHS as f64) as usize;
        self.at(self.0[k].quantile(unit_interval(rng)))
    }
    #[inline]
    fn pdf(&self, (_, densities): &Depth) -> f64 {
        densities.0.iter().sum::<f64>() / WAVELENGTHS as f64
    }
}

#[inline]
fn modulation(t: f64) -> f64 {
    1.0 + 0.5 * libm::cos(OMEGA * t)
}

impl Solved for MeanSpectrum {
    type Value = Wavelengths;
    const UNIFORMS: usize = 2;
    const DESCRIPTION: Description = Description {
        id: "spectrum-32",
        title: "32 wavelengths, sampled by the mean spectrum",
        formula: "f_k = g_k(t) (1 + cos(4πt)/2), h_k = g_k(t) ∝ exp(−σ_k t) on [0, 1], σ_k = 8 (400 nm/λ_k)⁴, \
                  λ_k = 400, 410, … 710 nm; t has the density g = mean of all g_k",
        why: "Distances in a coloured medium: one draw serves all wavelengths, and h_k/g is what each of them pays for it.",
    };

    fn exact(&self) -> Wavelengths {
        Spectrum(depths().map(|density| 1.0 + 0.5 * density.cosine(OMEGA)))
    }
    fn source(&self) -> impl Source<Value = Wavelengths> {
        Problem::new(|(t, densities): &Depth| *densities * Spectrum([modulation(*t); WAVELENGTHS]))
            .auxiliary(WithIntegral::new(|(_, densities): &Depth| *densities, Spectrum([1.0; WAVELENGTHS])))
            .proposal(Mean(depths()))
    }
    fn channel(&self, channel: usize) -> String {
        format!("{} nm", wavelength(channel))
    }
    fn curves(&self) -> (Axis, Vec<Curve>) {
        let (depths, exact) = (depths(), self.exact());
        let mut curves = Vec::new();
        for (group, k) in [0, 15, 31].into_iter().enumerate() {
            let density = depths[k];
            let name = self.channel(k);
            curves.push(Curve::of(name.clone(), group, Role::Integrand, |t| density.pdf(t) * modulation(t) / exact[k]));
            curves.push(Curve::of(name, group, Role::Auxiliary, |t| density.pdf(t)));
        }
        let mean = Mean(depths);
        curves.push(Curve::of(String::new(), 0, Role::Proposal, |t| mean.pdf(&mean.at(t))));
        ("t", curves)
    }
}
