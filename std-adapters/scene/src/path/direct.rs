//! Light that a diffuse surface scatters once: eight paths side by side, a step at a time.

use crate::Scene;
use crate::colour::Colour;
use crate::geometry::{Beam, NONE, Nearest, Segments};
use crate::lanes::{LANES, Vectors, in_memory};
use crate::path::Samples;
use crate::path::kernel::Block;
use crate::path::record::Record;
use crate::path::vertex::Vertex;
use crate::random::Random;
use ratiocv_simd::Work;

/// The paths of a block in a scene of diffuse surfaces, lit by lights that are sampled, without media, where
/// paths end at the first scattering.
pub(super) struct Direct<'a, C, const AUXILIARY: bool> {
    pub(super) scene: &'a Scene<C>,
    pub(super) block: Block,
    pub(super) samples: &'a mut Samples<C>,
}

impl<C: Colour, const AUXILIARY: bool> Work for Direct<'_, C, AUXILIARY> {
    type Output = ();
    #[inline(always)]
    fn run(mut self) {
        let Block { pixel, block, count, seed } = self.block;
        let mut random = Random::new(seed, pixel, block);
        self.samples.count = count;
        let scene = self.scene;
        for first in (0..count).step_by(Beam::RAYS) {
            let beam = scene.camera.rays(pixel, &mut random);
            let seen = scene.geometry.seen_by_camera(&beam);
            self.eight(first, LANES.min(count - first), (&beam, &seen), &mut random);
        }
    }
}

impl<C: Colour, const AUXILIARY: bool> Direct<'_, C, AUXILIARY> {
    /// Samples `first..first + count`.
    #[inline(always)]
    fn eight(&mut self, first: usize, count: usize, (beam, seen): (&Beam, &Nearest), random: &mut Random) {
        let Self { scene, samples, .. } = self;
        let Samples { plain, pairs, weights, .. } = &mut **samples;
        let mut emission = [C::ZERO; LANES];
        let mut vertices: [Option<Vertex<C>>; LANES] = [const { None }; LANES];
        let (mut at, mut normals) = (Vectors::ZERO, Vectors::ZERO);
        for lane in 0..count {
            let ray = beam.ray(lane);
            let hit = scene.geometry.seen_by(&ray, seen, lane);
            if hit.shape == NONE {
                continue;
            }
            let (point, surface) = (scene.geometry.point(&ray, hit), &scene.surfaces[hit.shape as usize]);
            if surface.light != NONE && point.normal.dot(ray.direction) < 0.0 {
                emission[lane] = surface.emission;
            }
            vertices[lane] = Vertex::on::<false>(point, surface, ray.direction);
            if let Some(vertex) = &vertices[lane] {
                at.set(lane, vertex.point.position);
                normals.set(lane, vertex.shading);
            }
        }
        in_memory(&mut (&mut at, &mut normals));
        let choices = scene.lights.choose_each::<AUXILIARY>(&at, &normals, &random.lane(), &mut weights.by_place);
        let [u, v] = [random.lane(), random.lane()];
        // f if nothing hides the light, and h.
        let mut light = [(C::ZERO, C::ONE); LANES];
        let mut shadows = Segments::NONE;
        for lane in 0..count {
            let Some(vertex) = &vertices[lane] else { continue };
            let Some(chosen) = scene.lights.chosen::<AUXILIARY>(&choices, lane) else { continue };
            light[lane].1 = chosen.h;
            let lamp = &scene.lights.lights[chosen.light];
            let Some(towards) = lamp.emitter.sample(vertex.point.position, [u[lane], v[lane]]) else { continue };
            let Some(scattered) = vertex.scattered::<false, false>(towards.direction) else { continue };
            let f = scattered.over_density * scattered.density * lamp.radiance;
            light[lane].0 = f.times(towards.inverse_pdf / chosen.probability);
            let (end, to) = lamp.segment(towards.distance);
            shadows.set(lane, &vertex.point.towards(towards.direction), end, to);
        }
        in_memory(&mut shadows);
        let hidden = scene.geometry.hidden(&shadows);
        for lane in 0..count {
            let mut record = Record::<C, AUXILIARY>::new(&scene.terms, pairs, first + lane);
            record.scattering(1, emission[lane], C::ONE);
            if vertices[lane].is_some() {
                let (f, h) = light[lane];
                record.light(2, if hidden[lane] { C::ZERO } else { f }, h);
            }
            plain[first + lane] = record.end(C::ONE);
        }
    }
}
