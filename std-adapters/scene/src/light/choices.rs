//! A light for each of eight places on diffuse surfaces: lanes are places, and sums over lights need no trees.

use crate::colour::PathColour;
use crate::lanes::{LANES, Lane, Vectors, blend, each, in_memory, mask};
use crate::light::choice::{Light, LightChoice, Lights, Mixture};
use crate::light::lamps::cosine;
use crate::planted::planted;
use glam::Vec3;

/// What was chosen for eight places.
#[derive(Clone, Debug)]
pub(crate) struct Choices {
    light: [u32; LANES],
    probability: Lane,
    /// p_j/p over the light's weight in the channel.
    preference: [Lane; 3],
    /// 1 where a channel has no light, and no preference.
    dark: [Lane; 3],
}

impl Choices {
    /// That of a lone light.
    #[inline(always)]
    pub(crate) const fn new() -> Self {
        Self { light: [0; LANES], probability: [1.0; LANES], preference: [[0.0; LANES]; 3], dark: [[1.0; LANES]; 3] }
    }

    /// How likely the light that was chosen for place `lane` was to be.
    #[inline(always)]
    pub(crate) const fn probability(&self, lane: usize) -> f32 {
        self.probability[lane]
    }

    /// How much likelier each channel was to choose `light` for place `lane`, where it was chosen.
    #[inline(always)]
    pub(crate) fn h<C: PathColour>(&self, light: &Light<C>, lane: usize) -> C {
        let of = |[r, g, b]: &[Lane; 3]| C::of(Vec3::new(r[lane], g[lane], b[lane]));
        light.weight * of(&self.preference) + of(&self.dark)
    }
}

impl<C: PathColour> Lights<C> {
    /// As [`choose`](Self::choose), for each place; `seen` has room for what it receives of every light. `choices` are
    /// new.
    #[inline(always)]
    pub(crate) fn choose_each<const AUXILIARY: bool>(
        &self,
        (at, normals): (&Vectors, &Vectors),
        u: &Lane,
        seen: &mut [Lane],
        choices: &mut Choices,
    ) {
        if self.lights.len() == 1 {
            return;
        }
        let by_channel = AUXILIARY || self.mixture == Mixture::Uniform;
        let lamps = || self.lamps.iter().flat_map(|lamps| (0..LANES).map(move |lane| (lamps, lane)));
        let (mut total, mut totals) = ([0.0; LANES], [[0.0; LANES]; 3]);
        for ((lamps, number), seen) in lamps().zip(seen.iter_mut()) {
            if self.choice == LightChoice::Local {
                let lamp = lamps.lamp(number);
                for (lane, seen) in seen.iter_mut().enumerate() {
                    *seen = lamp.received(at.get(lane), normals.get(lane), cosine);
                }
                in_memory(seen);
            }
            let importance = lamps.importance[number];
            total = each(&total, seen, |sum, seen| sum + importance * seen);
            in_memory(&mut total);
            if by_channel {
                for (totals, weights) in totals.iter_mut().zip(&lamps.weights).take(C::CHANNELS) {
                    *totals = each(totals, seen, |sum, seen| sum + weights[number] * seen);
                }
                in_memory(&mut totals);
            }
        }
        let mut inverses = [[0.0; LANES]; 3];
        if by_channel {
            for ((inverses, dark), totals) in inverses.iter_mut().zip(&mut choices.dark).zip(&totals) {
                *dark = totals.map(|sum| if sum > 0.0 { 0.0 } else { 1.0 });
                // 0 where it is dark.
                *inverses = each(totals, dark, |sum, dark| (1.0 - dark) / (sum + dark));
            }
            in_memory(&mut (&mut inverses, &mut choices.dark));
        }
        // The mean of the channels' own probabilities adds up to the number of those that see light.
        if self.mixture == Mixture::Uniform {
            total = [0.0; LANES];
            for dark in choices.dark.iter().take(C::CHANNELS) {
                total = each(&total, dark, |sum, dark| sum + (1.0 - dark));
            }
        }
        // The last light that begins before the place, in [0, total).
        let place = each(u, &total, |u, total| u * total);
        let (mut begin, mut weight_of_chosen, mut seen_of_chosen) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let mut chosen = [0; LANES];
        for (light, ((lamps, number), seen)) in lamps().zip(seen.iter()).enumerate() {
            let mut weights = [lamps.importance[number]; LANES];
            if self.mixture == Mixture::Uniform {
                weights = [0.0; LANES];
                for (inverses, own) in inverses.iter().zip(&lamps.weights).take(C::CHANNELS) {
                    weights = each(&weights, inverses, |sum, inverse| sum + own[number] * inverse);
                }
            }
            weights = each(&weights, seen, |weight, seen| weight * seen);
            let begun = mask(&place, &begin, |place, begin| place >= begin);
            let here = mask(&weights, &begun, |weight, begun| (weight > 0.0) & (begun != 0));
            for (chosen, here) in chosen.iter_mut().zip(here) {
                *chosen = (light as u32 & here) | (*chosen & !here);
            }
            seen_of_chosen = blend(&here, seen, &seen_of_chosen);
            weight_of_chosen = blend(&here, &weights, &weight_of_chosen);
            begin = each(&begin, &weights, |begin, weight| begin + weight);
            in_memory(&mut (&mut chosen, &mut seen_of_chosen, &mut weight_of_chosen, &mut begin));
        }
        choices.light = chosen;
        choices.probability = each(&weight_of_chosen, &total, |weight, total| weight / total);
        if AUXILIARY {
            let scale = each(&seen_of_chosen, &choices.probability, |seen, probability| seen / probability);
            for (preference, inverses) in choices.preference.iter_mut().zip(&inverses) {
                *preference = each(
                    &scale,
                    inverses,
                    |scale, inverse| planted!("light_choice_not_normalised": scale * inverse, scale),
                );
            }
        }
        in_memory(choices);
    }

    /// The light that was chosen for place `lane`; `None` if no light reaches it.
    #[inline(always)]
    pub(crate) fn chosen(&self, choices: &Choices, lane: usize) -> Option<&Light<C>> {
        (choices.probability[lane] > 0.0).then(|| &self.lights[choices.light[lane] as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::uniform_direction;
    use crate::geometry::{NONE, Rectangle, Sphere};
    use crate::light::{Emitter, Facing, Weights};
    use crate::random::Random;
    use glam::Affine3A;
    use ratiocv_simd::F32x4;

    /// `count` lights of all kinds, on all sides of the origin; the last channel has none.
    fn lights(count: usize, choice: LightChoice, mixture: Mixture) -> Lights<F32x4> {
        let mut lights = Lights::new(choice, mixture);
        let mut random = Random::new(8, [0, 0], 0);
        for i in 0..count {
            let center = uniform_direction(random.uniforms()) * (1.0 + 3.0 * random.uniform());
            let to_world = Affine3A::from_translation(center);
            let emitter = match i % 3 {
                0 => Emitter::Sphere(Sphere::new(center, 0.3, false).expect("a sphere")),
                1 => {
                    let rectangle = Rectangle::new(&to_world, false).expect("a square");
                    Emitter::Rectangle { area: rectangle.area(), rectangle }
                }
                _ => Emitter::Point(center),
            };
            lights.push(emitter, NONE, F32x4::of(Vec3::new(random.uniform(), random.uniform(), 0.0)));
        }
        lights
    }

    /// 10 and 24 lights do not fill packs of eight.
    #[test]
    fn eight_places_choose_what_each_would() {
        let mut random = Random::new(9, [0, 0], 0);
        for (count, mixture) in [1, 3, 10, 24]
            .into_iter()
            .flat_map(|count| [Mixture::Luminance, Mixture::L2, Mixture::Uniform].map(|mixture| (count, mixture)))
        {
            for choice in [LightChoice::Uniform, LightChoice::Power, LightChoice::Local] {
                let lights = lights(count, choice, mixture);
                let mut weights = Weights::new(count);
                let (mut same, mut none) = (0, 0);
                for _ in 0..100 {
                    let (mut at, mut normals) = (Vectors::ZERO, Vectors::ZERO);
                    for lane in 0..LANES {
                        at.set(lane, uniform_direction(random.uniforms()) * 2.0);
                        normals.set(lane, uniform_direction(random.uniforms()));
                    }
                    let u = random.lane();
                    let mut seen = vec![[1.0; LANES]; count];
                    let mut choices = Choices::new();
                    lights.choose_each::<true>((&at, &normals), &u, &mut seen, &mut choices);
                    for (lane, u) in u.into_iter().enumerate() {
                        let place = (at.get(lane), Facing::Cosine(normals.get(lane)));
                        let alone = lights.choose::<true>(place, u, &mut weights);
                        let (Some(ours), Some(alone)) = (lights.chosen(&choices, lane), alone) else {
                            assert_eq!(lights.chosen(&choices, lane).is_some(), alone.is_some());
                            none += 1;
                            continue;
                        };
                        // Sums in another order may choose the neighbour.
                        if choices.light[lane] as usize != alone.light {
                            continue;
                        }
                        same += 1;
                        let probability = choices.probability(lane);
                        let off = (probability - alone.probability).abs();
                        assert!(
                            off <= 1e-5 * alone.probability,
                            "{count} {choice:?} {mixture:?}: {probability} {alone:?}"
                        );
                        let h = choices.h(ours, lane);
                        for channel in 0..3 {
                            let (ours, alone) = (h.channel(channel), alone.h.channel(channel));
                            assert!((ours - alone).abs() <= 1e-5 * alone.abs(), "{choice:?} {mixture:?}");
                        }
                    }
                }
                assert!(same + none >= 798 && same >= 300, "{count} {choice:?} {mixture:?}: {same} {none}");
            }
        }
    }
}
