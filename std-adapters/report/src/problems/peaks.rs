//! Gaussian peaks in four dimensions, one per channel.

use crate::problems::truncated::TruncatedLogistic;
use crate::problems::{Axis, Curve, Description, Role, Solved, Source};
use core::f64::consts::PI;
use rand_core::Rng;
use ratiocv_core::{Problem, Proposal, Spectrum, WithIntegral, unit_interval};

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct Peaks;

type Channels = Spectrum<f64, 3>;
type Position = [f64; 4];

const CENTRES: [Position; 3] = [[0.5, 0.5, 0.5, 0.5], [0.4, 0.6, 0.5, 0.45], [0.7, 0.35, 0.6, 0.55]];
/// f_k = exp(−SHARPNESS |x − c_k|²), a Gaussian of standard deviation 0.1.
const SHARPNESS: f64 = 50.0;
/// A logistic density of this scale is a little wider than the Gaussian, and has heavier tails.
const SCALE: f64 = 0.06;

/// A density about each centre: the product of four logistic ones.
type Densities = [[TruncatedLogistic; 4]; 3];

fn densities() -> Densities {
    CENTRES.map(|centre| centre.map(|c| TruncatedLogistic::new(c, SCALE)))
}

/// A position and the three densities there, which the proposal and h both need.
type Point = (Position, Channels);

/// The mean of the channels' densities.
#[derive(Clone, Copy, Debug)]
struct Mixture(Densities);

impl Mixture {
    fn at(&self, x: Position) -> Point {
        (x, Spectrum(self.0.map(|density| (0..4).fold(1.0, |product, i| product * density[i].pdf(x[i])))))
    }
}

impl Proposal for Mixture {
    type Point = Point;
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Point {
        let component = &self.0[(unit_interval(rng) * 3.0) as usize];
        self.at(core::array::from_fn(|i| component[i].quantile(unit_interval(rng))))
    }
    #[inline]
    fn pdf(&self, (_, densities): &Point) -> f64 {
        (densities[0] + densities[1] + densities[2]) / 3.0
    }
}

fn peak(x: &Position, centre: &Position) -> f64 {
    let squares = (0..4).fold(0.0, |sum, i| sum + (x[i] - centre[i]) * (x[i] - centre[i]));
    libm::exp(-SHARPNESS * squares)
}

impl Solved for Peaks {
    type Value = Channels;
    const UNIFORMS: usize = 5;
    const DESCRIPTION: Description = Description {
        id: "peaks-4d",
        title: "Three peaks in four dimensions",
        formula: "f_k = exp(−50|x − c_k|²) on [0, 1]⁴, c = (.5, .5, .5, .5), (.4, .6, .5, .45), (.7, .35, .6, .55); \
                  h_k = p_k, a product of logistic densities about c_k; x has the density g = (p_1 + p_2 + p_3)/3",
        why: "Several dimensions, a mixture that must serve all channels, and an auxiliary that has the right place but \
              not the right shape.",
    };

    fn exact(&self) -> Channels {
        let root = libm::sqrt(SHARPNESS);
        let side = |c: f64| libm::sqrt(PI) / (2.0 * root) * (libm::erf(root * (1.0 - c)) + libm::erf(root * c));
        Spectrum(CENTRES.map(|centre| centre.into_iter().fold(1.0, |product, c| product * side(c))))
    }
    fn source(&self) -> impl Source<Value = Channels> {
        Problem::new(|(x, _): &Point| Spectrum(CENTRES.map(|centre| peak(x, &centre))))
            .auxiliary(WithIntegral::new(|(_, densities): &Point| *densities, Spectrum([1.0; 3])))
            .proposal(Mixture(densities()))
    }
    fn channel(&self, channel: usize) -> String {
        format!("peak {}", channel + 1)
    }
    fn curves(&self) -> (Axis, Vec<Curve>) {
        let (mixture, exact) = (Mixture(densities()), self.exact());
        let mut curves = Vec::new();
        for (k, centre) in CENTRES.into_iter().enumerate() {
            // Along the first axis, through the peak.
            let through = |x: f64| [x, centre[1], centre[2], centre[3]];
            let f = |x| peak(&through(x), &centre) / exact[k];
            curves.push(Curve::of(self.channel(k), k, Role::Integrand, f));
            let h = |x| mixture.at(through(x)).1[k];
            curves.push(Curve::of(self.channel(k), k, Role::Auxiliary, h));
        }
        ("first coordinate, through each peak", curves)
    }
}
