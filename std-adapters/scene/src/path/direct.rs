//! Light that a diffuse surface scatters once: eight paths side by side, a step at a time.

use crate::Scene;
use crate::colour::Colour;
use crate::geometry::{Beam, NONE, Nearest, Point, Segments};
use crate::lanes::{LANES, Vectors, in_memory};
use crate::light::{Chosen, Directions};
use crate::path::Samples;
use crate::path::kernel::Block;
use crate::path::record::Record;
use crate::path::vertex::Vertex;
use crate::random::Random;
use core::f32::consts::FRAC_1_PI;
use glam::Vec3;
use ratiocv_simd::Work;

/// A place that scatters light, but for what is in lanes.
#[derive(Clone, Copy)]
struct Place<C> {
    point: Point,
    /// On the side of the ray.
    normal: Vec3,
    reflectance: C,
}

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
        let mut places = [None; LANES];
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
            if let Some(vertex) = Vertex::on::<false>(point, surface, ray.direction) {
                at.set(lane, point.position);
                normals.set(lane, vertex.shading);
                places[lane] = Some(Place { point, normal: vertex.normal, reflectance: vertex.lobes.reflectance });
            }
        }
        in_memory(&mut (&mut at, &mut normals));
        let choices = scene.lights.choose_each::<AUXILIARY>(&at, &normals, &random.lane(), &mut weights.by_place);
        let [u, v] = [random.lane(), random.lane()];
        let chosen: [Option<Chosen<C>>; LANES] =
            core::array::from_fn(|lane| places[lane].and_then(|_| scene.lights.chosen::<AUXILIARY>(&choices, lane)));
        let (mut centers, mut radii) = (Vectors::ZERO, [0.0; LANES]);
        for (lane, chosen) in chosen.iter().enumerate() {
            if let Some((center, radius)) =
                chosen.as_ref().and_then(|chosen| scene.lights.lights[chosen.light].emitter.ball())
            {
                centers.set(lane, center);
                radii[lane] = radius;
            }
        }
        in_memory(&mut (&mut centers, &mut radii));
        let to_balls = Directions::to_spheres(&at, (&centers, &radii), [&u, &v]);
        // f if nothing hides the light, and h.
        let mut light = [(C::ZERO, C::ONE); LANES];
        let mut shadows = Segments::NONE;
        for lane in 0..count {
            let (Some(place), Some(chosen)) = (&places[lane], &chosen[lane]) else { continue };
            light[lane].1 = chosen.h;
            let lamp = &scene.lights.lights[chosen.light];
            let towards = if radii[lane] > 0.0 {
                to_balls.get(lane)
            } else {
                lamp.emitter.sample(at.get(lane), [u[lane], v[lane]])
            };
            let Some(towards) = towards else { continue };
            let cos = normals.get(lane).dot(towards.direction);
            if !(cos > 0.0 && place.normal.dot(towards.direction) > 0.0) {
                continue;
            }
            let f = place.reflectance * lamp.radiance;
            light[lane].0 = f.times(cos * FRAC_1_PI * (towards.inverse_pdf / chosen.probability));
            let (end, to) = lamp.segment(towards.distance);
            shadows.set(lane, &place.point.towards(towards.direction), end, to);
        }
        in_memory(&mut shadows);
        let hidden = scene.geometry.hidden(&shadows);
        for lane in 0..count {
            let mut record = Record::<C, AUXILIARY>::new(&scene.terms, pairs, first + lane);
            record.scattering(1, emission[lane], C::ONE);
            if places[lane].is_some() {
                let (f, h) = light[lane];
                record.light(2, if hidden[lane] { C::ZERO } else { f }, h);
            }
            plain[first + lane] = record.end(C::ONE);
        }
    }
}
