//! Which light to sample: one probability per channel, and the one that is used.

use crate::colour::PathColour;
use crate::geometry::NONE;
use crate::lanes::{LANES, Lane, each, in_memory, total};
use crate::light::Emitter;
use crate::light::lamps::Lamps;
use crate::planted::planted;
use glam::Vec3;

/// How likely each channel, left alone, would choose a light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightChoice {
    /// All alike, whatever their colours: no auxiliary.
    Uniform,
    /// By the power in the channel.
    Power,
    /// By what the channel receives where the light is sampled from: power × cosines / squared distance,
    /// unoccluded.
    #[default]
    Local,
}

/// The choice that is made for all channels, as a mixture of theirs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mixture {
    /// By the luminance of the channels' weights.
    Luminance,
    /// By the root of the sum of their squares.
    #[default]
    L2,
    /// The mean of the channels' own probabilities.
    Uniform,
}

/// Something that is sampled directly.
#[derive(Clone, Debug)]
pub(crate) struct Light<C> {
    pub(crate) emitter: Emitter,
    /// The number of its shape.
    pub(crate) shape: u32,
    /// Radiance; radiant intensity of a point.
    pub(crate) radiance: C,
    /// What the choice of each channel is proportional to, but for the place.
    pub(super) weight: C,
}

impl<C> Light<C> {
    /// Where a shadow ray to it ends, `distance` away, and the shape that does not hide that: a light that is convex
    /// does not hide what is seen of it.
    #[inline(always)]
    pub(crate) const fn segment(&self, distance: f32) -> (f32, u32) {
        if self.emitter.hides_itself() { (distance * (1.0 - 1e-4), NONE) } else { (distance, self.shape) }
    }
}

/// What cosine a place has for light.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Facing {
    /// None: a place in a medium.
    Any,
    /// The surface scatters what comes from above, by some law of its own.
    Above(Vec3),
    /// The surface scatters in proportion to the cosine.
    Cosine(Vec3),
}

/// All lights that are sampled directly.
#[derive(Debug)]
pub(crate) struct Lights<C> {
    pub(crate) lights: Vec<Light<C>>,
    /// The same, side by side.
    pub(super) lamps: Vec<Lamps>,
    pub(super) choice: LightChoice,
    pub(super) mixture: Mixture,
}

/// The weights at the last vertex, so that what is hit from there knows how likely it was to be sampled.
#[derive(Clone, Debug, Default)]
pub(crate) struct Weights {
    seen: Vec<Lane>,
    weights: Vec<Lane>,
    total: f32,
    /// What each of eight places receives of every light.
    pub(crate) by_place: Vec<Lane>,
}

impl Weights {
    pub(crate) fn new(lights: usize) -> Self {
        let lamps = vec![[1.0; LANES]; lights.div_ceil(LANES)];
        Self { seen: lamps.clone(), weights: lamps, total: lights as f32, by_place: vec![[1.0; LANES]; lights] }
    }

    /// The probability of `light`, as it was at the last choice.
    #[inline(always)]
    pub(crate) fn probability(&self, light: usize) -> f32 {
        self.weights.as_flattened()[light] / self.total
    }

    /// The light whose weight `place`, in [0, total), falls into.
    #[inline(always)]
    fn light_at(&self, mut place: f32) -> usize {
        for (lamps, weights) in self.weights.iter().enumerate() {
            let (mut sum, mut passed) = (0.0, 0);
            for weight in weights {
                sum += weight;
                passed += usize::from(place >= sum);
            }
            if passed < LANES {
                return lamps * LANES + passed;
            }
            place -= sum;
        }
        // Past the end by rounding.
        self.weights.as_flattened().iter().rposition(|weight| *weight > 0.0).unwrap_or(0)
    }
}

/// A light that was chosen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chosen<C> {
    pub(crate) light: usize,
    pub(crate) probability: f32,
    /// p_j/p: how much likelier each channel was to choose it. 1 without auxiliary.
    pub(crate) h: C,
}

impl<C: PathColour> Lights<C> {
    pub(crate) const fn new(choice: LightChoice, mixture: Mixture) -> Self {
        Self { lights: Vec::new(), lamps: Vec::new(), choice, mixture }
    }

    /// Adds a light; `shape` is the number of its shape.
    pub(crate) fn push(&mut self, emitter: Emitter, shape: u32, radiance: C) {
        let size = match self.choice {
            LightChoice::Uniform => 0.0,
            LightChoice::Power => emitter.seen_area() * emitter.power(),
            LightChoice::Local => emitter.seen_area(),
        };
        let weight = if self.choice == LightChoice::Uniform { C::ONE } else { radiance.times(size) };
        let importance = match self.mixture {
            Mixture::Luminance => weight.luminance(),
            Mixture::L2 => (weight * weight).sum().sqrt(),
            Mixture::Uniform => 1.0,
        };
        let lane = self.lights.len() % LANES;
        if lane == 0 {
            self.lamps.push(Lamps::NONE);
        }
        if let Some(lamps) = self.lamps.last_mut() {
            lamps.set(lane, emitter.bound(), emitter.plane());
            lamps.importance[lane] = importance;
            for channel in 0..C::CHANNELS {
                lamps.weights[channel][lane] = weight.channel(channel);
            }
        }
        self.lights.push(Light { emitter, shape, radiance, weight });
    }

    /// Chooses a light for a vertex; `None` if no light reaches it.
    #[inline(always)]
    pub(crate) fn choose<const AUXILIARY: bool>(
        &self,
        (at, facing): (Vec3, Facing),
        u: f32,
        weights: &mut Weights,
    ) -> Option<Chosen<C>> {
        if self.lights.len() == 1 {
            return Some(Chosen { light: 0, probability: 1.0, h: C::ONE });
        }
        // The channels' own sums are needed for p_j, and for their mean.
        let by_channel = AUXILIARY || self.mixture == Mixture::Uniform;
        let mut sums = [[0.0; LANES]; 3];
        let mut sum = [0.0; LANES];
        for ((lamps, seen), weight) in self.lamps.iter().zip(&mut weights.seen).zip(&mut weights.weights) {
            if self.choice == LightChoice::Local {
                lamps.seen_from(at, facing, seen);
            }
            *weight = each(&lamps.importance, seen, |importance, seen| importance * seen);
            sum = each(&sum, weight, |sum, weight| sum + weight);
            in_memory(&mut sum);
            if by_channel {
                for (channel, weights) in lamps.weights.iter().enumerate().take(C::CHANNELS) {
                    let own = each(weights, seen, |weight, seen| weight * seen);
                    sums[channel] = each(&sums[channel], &own, |sum, own| sum + own);
                }
                in_memory(&mut sums);
            }
        }
        let totals = C::of(Vec3::from_array([total(sums[0]), total(sums[1]), total(sums[2])]));
        let inverse_totals = totals.map(|sum| if sum > 0.0 { 1.0 / sum } else { 0.0 });
        if self.mixture == Mixture::Uniform {
            sum = [0.0; LANES];
            for ((lamps, seen), weight) in self.lamps.iter().zip(&weights.seen).zip(&mut weights.weights) {
                for lane in 0..LANES {
                    let own = |channel: usize| lamps.weights[channel][lane] * inverse_totals.channel(channel);
                    weight[lane] = (0..C::CHANNELS).map(own).sum::<f32>() * seen[lane];
                    sum[lane] += weight[lane];
                }
            }
        }
        weights.total = total(sum);
        if weights.total.is_nan() || weights.total <= 0.0 {
            return None;
        }
        let chosen = weights.light_at(u * weights.total);
        let probability = weights.probability(chosen);
        let h = if AUXILIARY {
            let own =
                (self.lights[chosen].weight * inverse_totals).times(weights.seen.as_flattened()[chosen] / probability);
            // A channel without light has no preference.
            let own = planted!("light_choice_not_normalised": own, own * totals);
            C::select(C::ZERO.lt(totals), own, C::ONE)
        } else {
            C::ONE
        };
        Some(Chosen { light: chosen, probability, h })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use ratiocv_simd::F32x4;

    fn lights(choice: LightChoice, mixture: Mixture) -> Lights<F32x4> {
        let mut lights = Lights::new(choice, mixture);
        let intensities = [[3.0, 1.0, 0.0], [0.5, 2.0, 0.0], [1.0, 1.0, 0.0]];
        let places = [Vec3::new(0.0, 2.0, 0.0), Vec3::new(3.0, 1.0, 0.0), Vec3::new(0.0, -1.0, 0.0)];
        for (place, intensity) in places.into_iter().zip(intensities) {
            lights.push(Emitter::Point(place), NONE, F32x4::of(Vec3::from_array(intensity)));
        }
        lights
    }

    /// H0: each light is chosen with the probability that is stated. N = 100 000; binomial; α = 10⁻⁹ for 27 counts:
    /// 6.6 standard deviations. h·p is p_j, which adds up to 1 per channel.
    #[test]
    fn probabilities_are_frequencies_and_add_up_to_1() {
        let n = 100_000;
        let place = (Vec3::ZERO, Facing::Cosine(Vec3::Y));
        for choice in [LightChoice::Uniform, LightChoice::Power, LightChoice::Local] {
            for mixture in [Mixture::Luminance, Mixture::L2, Mixture::Uniform] {
                let lights = lights(choice, mixture);
                let mut weights = Weights::new(3);
                let mut random = Random::new(6, [choice as u32, mixture as u32], 0);
                let mut seen = [None; 3];
                let mut counts = [0.0; 3];
                for _ in 0..n {
                    let chosen = lights.choose::<true>(place, random.uniform(), &mut weights).expect("a light");
                    counts[chosen.light] += 1.0;
                    seen[chosen.light] = Some(chosen);
                }
                let mut sums = [0.0; 4];
                for (light, chosen) in seen.iter().enumerate() {
                    let Some(chosen) = chosen else { continue };
                    let p = f64::from(chosen.probability);
                    let allowed = 6.6 * libm::sqrt(f64::from(n) * p * (1.0 - p));
                    let expected = p * f64::from(n);
                    assert!((counts[light] - expected).abs() <= allowed, "{choice:?} {mixture:?} {light}: {counts:?}");
                    sums[3] += p;
                    (0..3).for_each(|c| sums[c] += f64::from(chosen.h.channel(c)) * p);
                }
                assert!(sums.iter().all(|sum| (sum - 1.0).abs() <= 1e-6), "{choice:?} {mixture:?}: {sums:?}");
                // Below the horizon there is a light.
                assert_eq!(seen[2].is_none(), choice == LightChoice::Local);
            }
        }
    }

    /// Red: 3/4 from the first, 0.5/10·(1/√10) from the second.
    #[test]
    fn local_probabilities_by_hand() {
        let lights = lights(LightChoice::Local, Mixture::Luminance);
        let mut weights = Weights::new(3);
        let place = (Vec3::ZERO, Facing::Cosine(Vec3::Y));
        let chosen = lights.choose::<true>(place, 0.0, &mut weights).expect("a light");
        let far = 0.1 / libm::sqrtf(10.0);
        let red = 0.75 / (0.75 + 0.5 * far);
        let green = 0.25 / (0.25 + 2.0 * far);
        let luminance = |r: f32, g: f32| 0.212_671 * r + 0.715_160 * g;
        let p = luminance(0.75, 0.25) / (luminance(0.75, 0.25) + luminance(0.5 * far, 2.0 * far));
        assert_eq!(chosen.light, 0);
        assert!((chosen.probability - p).abs() <= 1e-6, "{chosen:?} {p}");
        for (ours, right) in chosen.h.to_array().into_iter().zip([red / p, green / p, 1.0]) {
            assert!((ours - right).abs() <= 1e-5, "{chosen:?} {right}");
        }
    }
}
