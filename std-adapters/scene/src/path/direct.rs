//! Light that a diffuse surface scatters once: eight paths side by side, a step at a time.

use crate::Scene;
use crate::colour::{Colour, PathColour};
use crate::geometry::{Beam, NONE, Nearest, Point, Segments};
use crate::lanes::{LANES, Vectors, in_memory};
use crate::light::{Choices, Directions};
use crate::path::Samples;
use crate::path::kernel::{Block, Trace, each_beam};
use crate::path::vertex::Vertex;
use crate::random::Random;
use core::f32::consts::FRAC_1_PI;
use core::ops::Range;
use glam::Vec3;
use ratiocv_core::Draw;
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
pub(super) struct Direct<'a, C: Colour, const AUXILIARY: bool> {
    pub(super) scene: &'a Scene<C>,
    pub(super) block: Block,
    pub(super) samples: &'a mut Samples<C>,
}

impl<C: Colour, const AUXILIARY: bool> Work for Direct<'_, C, AUXILIARY> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        each_beam(self.scene, self.block, self);
    }
}

impl<C: Colour, const AUXILIARY: bool> Trace for Direct<'_, C, AUXILIARY> {
    #[inline(always)]
    fn trace(&mut self, numbers: Range<usize>, (beam, seen): (&Beam, &Nearest), random: &mut Random) {
        let Self { scene, samples, .. } = self;
        let Samples { plain, pairs, weights, .. } = &mut **samples;
        let pairs = &mut pairs.draws;
        let count = numbers.len();
        let plain = &mut plain[numbers.clone()];
        // What the camera sees is plain; the only pair there can be is of light that was sampled.
        let mut unpaired = [Draw::ZERO; LANES];
        let paired = AUXILIARY && !pairs.is_empty();
        let pairs = if paired { &mut pairs[numbers] } else { &mut unpaired[..count] };
        let mut places = [None::<Place<C::OnPath>>; LANES];
        let (mut at, mut normals) = (Vectors::ZERO, Vectors::ZERO);
        for (lane, plain) in plain.iter_mut().enumerate() {
            *plain = Draw::ZERO;
            let ray = beam.ray(lane);
            let hit = scene.geometry.seen_by(&ray, seen, lane);
            if hit.shape == NONE {
                continue;
            }
            let (point, surface) = (scene.geometry.point(&ray, hit), &scene.surfaces[hit.shape as usize]);
            if surface.light != NONE && point.normal.dot(ray.direction) < 0.0 {
                plain.f = C::kept(surface.emission);
            }
            if let Some(vertex) = Vertex::on::<false>(point, surface, ray.direction) {
                at.set(lane, point.position);
                normals.set(lane, vertex.shading);
                places[lane] = Some(Place { point, normal: vertex.normal, reflectance: vertex.lobes.reflectance });
            }
        }
        in_memory(&mut (&mut at, &mut normals));
        let mut choices = Choices::new();
        scene.lights.choose_each::<AUXILIARY>((&at, &normals), &random.lane(), &mut weights.by_place, &mut choices);
        let [u, v] = [random.lane(), random.lane()];
        let (mut centers, mut radii) = (Vectors::ZERO, [0.0; LANES]);
        for (lane, of_ball) in radii.iter_mut().enumerate() {
            if let Some((center, radius)) = scene.lights.chosen(&choices, lane).and_then(|lamp| lamp.emitter.ball()) {
                centers.set(lane, center);
                *of_ball = radius;
            }
        }
        in_memory(&mut (&mut centers, &mut radii));
        let to_balls = Directions::to_spheres(&at, (&centers, &radii), [&u, &v]);
        let mut shadows = Segments::NONE;
        for (lane, pair) in pairs.iter_mut().enumerate() {
            *pair = Draw::new(C::ZERO, C::ONE);
            let (Some(place), Some(lamp)) = (&places[lane], scene.lights.chosen(&choices, lane)) else { continue };
            if AUXILIARY {
                pair.h[0] = C::kept(choices.h(lamp, lane));
            }
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
            // As if nothing hid the light.
            pair.f = C::kept(f.times(cos * FRAC_1_PI * (towards.inverse_pdf / choices.probability(lane))));
            let (end, to) = lamp.segment(towards.distance);
            shadows.set(lane, &place.point.towards(towards.direction), end, to);
        }
        in_memory(&mut shadows);
        let hidden = scene.geometry.hidden(&shadows);
        for (pair, _) in pairs.iter_mut().zip(hidden).filter(|(_, hidden)| *hidden) {
            pair.f = C::ZERO;
        }
        if !paired {
            plain.iter_mut().zip(pairs).for_each(|(plain, pair)| plain.f = plain.f + pair.f);
        }
    }
}
