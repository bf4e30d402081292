//! One path after another: a backward walk from the camera, with a pair (f, h) per depth and technique.
//!
//! Everything whose sampling depends on the channel is sampled by one channel, drawn once per path. With P_j the
//! density with which channel j would have taken the path so far, the density that is divided by is their mean
//! M = ΣP_c/3, and h_j = P_j/M ≤ 3. So the next event, of densities p_j, is divided by m = Σ(h_c/3)p_c, and h_j
//! becomes h_j·p_j/m: spectral multiple importance sampling (Wilkie et al. 2014) in running form.

use crate::Scene;
use crate::colour::{Colour, PathColour};
use crate::geometry::{Beam, NONE, Nearest};
use crate::medium::{pass, transmittance};
use crate::path::Samples;
use crate::path::record::Record;
use crate::path::vertex::Vertex;
use crate::planted::planted;
use crate::random::Random;
use core::ops::Range;
use ratiocv_core::{Draw, Lanes};
use ratiocv_simd::Work;

/// What to trace.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    pub(crate) pixel: [u32; 2],
    pub(crate) block: u64,
    pub(crate) count: usize,
    pub(crate) seed: u64,
}

/// What traces samples from rays of the camera on. A trait, not a closure, because it must be inlined.
pub(super) trait Trace {
    /// Traces the samples `numbers`, which start with the first of `rays`.
    fn trace(&mut self, numbers: Range<usize>, rays: (&Beam, &Nearest), random: &mut Random);
}

/// Makes the rays of the camera and what they meet side by side, for `paths` to go on from.
#[inline(always)]
pub(super) fn each_beam<C: Colour>(
    scene: &Scene<C>,
    Block { pixel, block, count, seed }: Block,
    mut paths: impl Trace,
) {
    let mut random = Random::new(seed, pixel, block);
    for first in (0..count).step_by(Beam::RAYS) {
        let beam = scene.camera.rays(pixel, &mut random);
        let seen = scene.geometry.seen_by_camera(&beam);
        paths.trace(first..count.min(first + Beam::RAYS), (&beam, &seen), &mut random);
    }
}

/// The paths of a block, in a kernel that has what the scene needs.
pub(super) struct Paths<
    'a,
    C: Colour,
    const AUXILIARY: bool,
    const MEDIA: bool,
    const CONDUCTORS: bool,
    const LIGHTS: bool,
    const SCATTERING: bool,
> {
    pub(super) scene: &'a Scene<C>,
    pub(super) block: Block,
    pub(super) samples: &'a mut Samples<C>,
}

impl<
    C: Colour,
    const AUXILIARY: bool,
    const MEDIA: bool,
    const CONDUCTORS: bool,
    const LIGHTS: bool,
    const SCATTERING: bool,
> Work for Paths<'_, C, AUXILIARY, MEDIA, CONDUCTORS, LIGHTS, SCATTERING>
{
    type Output = ();
    #[inline(always)]
    fn run(self) {
        each_beam(self.scene, self.block, self);
    }
}

impl<
    C: Colour,
    const AUXILIARY: bool,
    const MEDIA: bool,
    const CONDUCTORS: bool,
    const LIGHTS: bool,
    const SCATTERING: bool,
> Trace for Paths<'_, C, AUXILIARY, MEDIA, CONDUCTORS, LIGHTS, SCATTERING>
{
    #[inline(always)]
    fn trace(&mut self, numbers: Range<usize>, (beam, seen): (&Beam, &Nearest), random: &mut Random) {
        if self.scene.is_sky::<MEDIA>(beam, seen) {
            return self.sky(numbers);
        }
        for (lane, sample) in numbers.enumerate() {
            self.samples.plain[sample] = self.path(sample, (beam, seen, lane), random);
        }
    }
}

impl<
    C: Colour,
    const AUXILIARY: bool,
    const MEDIA: bool,
    const CONDUCTORS: bool,
    const LIGHTS: bool,
    const SCATTERING: bool,
> Paths<'_, C, AUXILIARY, MEDIA, CONDUCTORS, LIGHTS, SCATTERING>
{
    /// Samples whose paths end where they begin, no ray of the beam meeting anything: all like the first.
    #[inline(always)]
    fn sky(&mut self, numbers: Range<usize>) {
        let Samples { plain, pairs, .. } = &mut *self.samples;
        let mut record = Record::<C, AUXILIARY>::new(&self.scene.terms, pairs, numbers.start);
        record.scattering(1, self.scene.environment, <C::OnPath>::ONE);
        let light = record.end(<C::OnPath>::ONE);
        plain[numbers.clone()].fill(light);
        if AUXILIARY {
            pairs.repeat(numbers.start);
        }
    }

    /// Traces sample number `sample`, which starts with ray `lane` of the camera's; what is not in pairs is returned.
    #[inline(always)]
    fn path(&mut self, sample: usize, (beam, seen, lane): (&Beam, &Nearest, usize), random: &mut Random) -> Draw<C, 0> {
        let Self { scene, samples, .. } = self;
        let Samples { pairs, weights, .. } = &mut **samples;
        let mut record = Record::<C, AUXILIARY>::new(&scene.terms, pairs, sample);
        let mut ray = beam.ray(lane);
        let mut hit = scene.geometry.seen_by(&ray, seen, lane);
        let channel = if C::LANES > 1 && (MEDIA || CONDUCTORS) { random.below(C::LANES) } else { 0 };
        // f of the path so far over its density M, and P_j/M.
        let mut throughput = <C::OnPath>::ONE;
        let mut h = <C::OnPath>::ONE;
        // The density of the ray's direction, given what came before.
        let mut density = 0.0;
        let mut depth = 1;
        loop {
            let mut scattered_at = f32::INFINITY;
            if MEDIA {
                let passage = pass(&scene.media, &ray, hit.t, channel, random);
                let mean = (h * passage.density).mean();
                if mean.is_nan() || mean <= 0.0 {
                    break;
                }
                let ratio = passage.density.times(1.0 / mean);
                throughput = throughput * passage.over_density * ratio;
                h = h * ratio;
                scattered_at = passage.t;
            }
            let in_medium = MEDIA && scattered_at.is_finite();
            let mut found = None;
            if !in_medium && hit.shape != NONE {
                found = Some((scene.geometry.point(&ray, hit), &scene.surfaces[hit.shape as usize]));
            }
            if in_medium && (SCATTERING || depth == 1) {
                record.dark(depth, h);
            } else if SCATTERING || depth == 1 {
                let mut radiance = <C::OnPath>::ZERO;
                let mut weight = 1.0;
                match &found {
                    Some((point, surface)) => {
                        let cos = -point.normal.dot(ray.direction);
                        if surface.light != NONE && cos > 0.0 {
                            radiance = surface.emission;
                            if LIGHTS && depth > 1 {
                                let light = surface.light as usize;
                                let inverse = scene.lights.lights[light].emitter.inverse_pdf(ray.origin, hit.t, cos);
                                // Balance: m/(m + p).
                                weight = 1.0 / (1.0 + weights.probability(light) / (inverse * density));
                            }
                        }
                    }
                    None => radiance = scene.environment,
                }
                let h = planted!("weight_on_h": h, h.times(weight));
                record.scattering(depth, (throughput * radiance).times(weight), h);
            }
            if depth >= scene.max_depth {
                break;
            }
            let vertex = if in_medium {
                Vertex::inside(ray.at(scattered_at), ray.direction)
            } else {
                let Some((point, surface)) = found else { break };
                let Some(vertex) = Vertex::on::<CONDUCTORS>(point, surface, ray.direction) else { break };
                vertex
            };
            if LIGHTS {
                let place = (vertex.point.position, vertex.facing::<CONDUCTORS, MEDIA>());
                let (mut f, mut h_light) = (<C::OnPath>::ZERO, <C::OnPath>::ONE);
                if let Some(chosen) = scene.lights.choose::<AUXILIARY>(place, random.uniform(), weights) {
                    h_light = chosen.h;
                    let light = &scene.lights.lights[chosen.light];
                    let sampled = light
                        .emitter
                        .sample(place.0, random.uniforms())
                        .and_then(|towards| Some((towards, vertex.scattered::<CONDUCTORS, MEDIA>(towards.direction)?)));
                    if let Some((towards, scattered)) = sampled {
                        let shadow = vertex.point.towards(towards.direction);
                        let (end, to) = light.segment(towards.distance);
                        if !scene.geometry.occluded(&shadow, end, to) {
                            let inverse = towards.inverse_pdf / chosen.probability;
                            let weight = if SCATTERING && !light.emitter.is_point() {
                                1.0 / (1.0 + (h * scattered.density).mean() * inverse)
                            } else {
                                1.0
                            };
                            f = throughput * scattered.over_density * scattered.density * light.radiance;
                            f = f.times(inverse * weight);
                            if MEDIA {
                                f = f * transmittance(&scene.media, &shadow, towards.distance);
                            }
                            h_light = planted!("weight_on_h": h_light, h_light.times(weight));
                        }
                    }
                }
                record.light(depth + 1, f, planted!("light_without_the_path": h * h_light, h_light));
            }
            if depth + 1 >= scene.max_depth && !SCATTERING {
                break;
            }
            let (direction, scattered) = vertex.sample::<CONDUCTORS, MEDIA>(channel, random);
            density = (h * scattered.density).mean();
            if density.is_nan() || density <= 0.0 {
                break;
            }
            let ratio = scattered.density.times(1.0 / density);
            throughput = throughput * scattered.over_density * ratio;
            h = h * ratio;
            let mut greatest = throughput.largest();
            if greatest.is_nan() || greatest <= 0.0 {
                h = planted!("h_zeroed_below_the_horizon": h, <C::OnPath>::ZERO);
                break;
            }
            depth += 1;
            if depth >= scene.roulette_depth {
                greatest = greatest.min(0.95);
                if random.uniform() >= greatest {
                    break;
                }
                throughput = throughput.times(planted!("roulette_without_weight": 1.0 / greatest, 1.0));
            }
            ray = vertex.point.towards(direction);
            hit = scene.geometry.closest(&ray);
        }
        record.end(h)
    }
}
