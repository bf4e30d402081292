//! Direct light from three coloured lamps, in RGB.

use crate::problems::{Axis, Curve, Description, Role, Solved, Source};
use rand_core::Rng;
use ratiocv_core::{Problem, Proposal, Spectrum, WithIntegral, unit_interval};

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct ThreeLights;

type Rgb = Spectrum<f64, 3>;

/// Radiance of each light.
const RADIANCE: [Rgb; 3] = [Spectrum([3000.0, 5.0, 6.0]), Spectrum([3.0, 3000.0, 4.0]), Spectrum([4.8, 5.8, 3000.0])];
/// Luminance of red, green and blue.
pub(crate) const LUMINANCE: Rgb = Spectrum([0.212671, 0.715160, 0.072169]);
/// The part of each light that is not occluded.
const VISIBLE: [f64; 3] = [0.95, 0.9, 0.875];

/// The probability with which each light is chosen: its share of the luminance.
fn choice() -> [f64; 3] {
    let luminance = RADIANCE.map(|light| (0..3).map(|j| light[j] * LUMINANCE[j]).sum::<f64>());
    luminance.map(|light| light / luminance.iter().sum::<f64>())
}

/// What the channels add up to over all lights, unoccluded.
fn total() -> Rgb {
    RADIANCE[0] + RADIANCE[1] + RADIANCE[2]
}

/// The channels' own choice of a light: its share of each channel's radiance.
fn own_choice() -> [Rgb; 3] {
    RADIANCE.map(|light| light / total())
}

/// A light, and a point on it.
type Point = (usize, f64);

/// Chooses a light by luminance, and a point on it uniformly.
#[derive(Clone, Copy, Debug)]
struct ByLuminance([f64; 3]);

impl ByLuminance {
    fn light(&self, u: f64) -> usize {
        let [first, second, _] = self.0;
        if u < first {
            0
        } else if u < first + second {
            1
        } else {
            2
        }
    }
}

impl Proposal for ByLuminance {
    type Point = Point;
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Point {
        (self.light(unit_interval(rng)), unit_interval(rng))
    }
    #[inline]
    fn pdf(&self, (light, _): &Point) -> f64 {
        self.0[*light]
    }
}

#[inline]
fn f((light, place): &Point) -> Rgb {
    if *place < VISIBLE[*light] { RADIANCE[*light] } else { Spectrum([0.0; 3]) }
}

impl Solved for ThreeLights {
    type Value = Rgb;
    const UNIFORMS: usize = 2;
    const DESCRIPTION: Description = Description {
        id: "three-lights",
        title: "Three coloured lights, one chosen by luminance",
        formula: "radiances (3000, 5, 6), (3, 3000, 4), (4.8, 5.8, 3000), of which 0.95, 0.9 and 0.875 are visible; \
                  light i with probability p(i) ∝ luminance, h_j = p_j(i) = channel j's share of its radiance at light i",
        why: "The colour noise of next-event estimation: choosing by luminance starves red and blue, and h_j/p knows it.",
    };

    fn exact(&self) -> Rgb {
        (0..3).fold(Spectrum([0.0; 3]), |sum, light| sum + RADIANCE[light] * Spectrum([VISIBLE[light]; 3]))
    }
    fn source(&self) -> impl Source<Value = Rgb> {
        let own = own_choice();
        Problem::new(f)
            .auxiliary(WithIntegral::new(move |(light, _): &Point| own[*light], Spectrum([1.0; 3])))
            .proposal(ByLuminance(choice()))
    }
    fn channel(&self, channel: usize) -> String {
        ["red", "green", "blue"][channel].into()
    }
    fn curves(&self) -> (Axis, Vec<Curve>) {
        let (lights, own, exact) = (ByLuminance(choice()), own_choice(), self.exact());
        let mut curves = Vec::new();
        for j in 0..3 {
            let over_p = |u: f64, radiance: &dyn Fn(usize) -> f64| {
                let light = lights.light(u);
                radiance(light) / lights.0[light]
            };
            let y = |u| over_p(u, &|light| RADIANCE[light][j] * VISIBLE[light] / exact[j]);
            curves.push(Curve::of(self.channel(j), j, Role::Integrand, y));
            curves.push(Curve::of(self.channel(j), j, Role::Auxiliary, |u| over_p(u, &|light| own[light][j])));
        }
        ("u (chooses the light); f/p and h/p", curves)
    }
}
