//! Directions to lights, from one place and from eight side by side.

use crate::frame::{Frame, turn};
use crate::lanes::{LANES, Lane, Vectors, in_memory};
use crate::planted::planted;
use core::f32::consts::PI;
use glam::Vec3;

/// A direction to a light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Towards {
    pub(crate) direction: Vec3,
    pub(crate) distance: f32,
    /// 1 over the density per solid angle; of a point, 1 over its squared distance.
    pub(crate) inverse_pdf: f32,
}

impl Towards {
    /// A point that was chosen uniformly over `area`; `None` if it shows `from` its back.
    #[inline(always)]
    pub(super) fn to_area(from: Vec3, (position, normal): (Vec3, Vec3), area: f32) -> Option<Self> {
        let to = position - from;
        let square = to.dot(to);
        let distance = square.sqrt();
        let direction = to / distance;
        let cos = -normal.dot(direction);
        (cos > 0.0 && distance > 0.0).then_some(Self {
            direction,
            distance,
            inverse_pdf: planted!("area_without_cosine": cos, 1.0) * area / square,
        })
    }

    /// By the cone in which a sphere is seen; `inverse_pdf` is 0 from inside. Without branches, for places side by side.
    #[inline(always)]
    pub(super) fn to_sphere(from: Vec3, (center, radius): (Vec3, f32), [u, v]: [f32; 2]) -> Self {
        let to_center = center - from;
        let square = to_center.dot(to_center);
        let cap = cone(radius, square);
        // 1 − cos, which keeps its digits in a narrow cone.
        let versine = u * cap;
        let sin2 = versine * (2.0 - versine);
        let (sin, cos) = (sin2.sqrt(), 1.0 - versine);
        let [x, y] = turn(v);
        let distance = square.sqrt();
        let direction = Frame::about(to_center / distance).to_world(Vec3::new(sin * x, sin * y, cos));
        let half_chord = (radius * radius - square * sin2).max(0.0).sqrt();
        Self { direction, distance: distance * cos - half_chord, inverse_pdf: 2.0 * PI * cap }
    }
}

/// 1 − cos of the cone in which a sphere is seen; 0 from inside.
#[inline(always)]
pub(super) fn cone(radius: f32, square: f32) -> f32 {
    let sin2 = radius * radius / square;
    let cap = sin2 / (1.0 + (1.0 - sin2).max(0.0).sqrt());
    if sin2 < 1.0 { cap } else { 0.0 }
}

/// Directions from eight places.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Directions {
    direction: Vectors,
    distance: Lane,
    inverse_pdf: Lane,
}

impl Directions {
    /// To the spheres about `centers`, as [`Emitter::sample`] of one that is seen from outside.
    #[inline(always)]
    pub(crate) fn to_spheres(from: &Vectors, (centers, radii): (&Vectors, &Lane), u: [&Lane; 2]) -> Self {
        let (from, centers, radii, [u, v]) = (*from, *centers, *radii, u.map(|u| *u));
        let mut directions = Self { direction: Vectors::ZERO, distance: [0.0; LANES], inverse_pdf: [0.0; LANES] };
        for lane in 0..LANES {
            let sphere = (centers.get(lane), radii[lane]);
            let towards = Towards::to_sphere(from.get(lane), sphere, [u[lane], v[lane]]);
            directions.direction.set(lane, towards.direction);
            directions.distance[lane] = towards.distance;
            directions.inverse_pdf[lane] = towards.inverse_pdf;
        }
        in_memory(&mut directions);
        directions
    }

    /// That of place `lane`; `None` from inside.
    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> Option<Towards> {
        let (direction, distance) = (self.direction.get(lane), self.distance[lane]);
        let inverse_pdf = self.inverse_pdf[lane];
        (inverse_pdf > 0.0).then_some(Towards { direction, distance, inverse_pdf })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::uniform_direction;
    use crate::geometry::Sphere;
    use crate::light::Emitter;
    use crate::random::Random;

    /// To the bit, and `None` from inside alike.
    #[test]
    fn spheres_side_by_side_are_sampled_as_each_is_alone() {
        let mut random = Random::new(6, [0, 0], 0);
        let mut inside = 0;
        for _ in 0..1000 {
            let (mut from, mut centers, mut radii) = (Vectors::ZERO, Vectors::ZERO, [0.0; LANES]);
            let [u, v] = [random.lane(), random.lane()];
            for (lane, radius) in radii.iter_mut().enumerate() {
                from.set(lane, uniform_direction(random.uniforms()) * 2.0);
                centers.set(lane, uniform_direction(random.uniforms()));
                *radius = 0.1 + random.uniform() * 1.5;
            }
            let directions = Directions::to_spheres(&from, (&centers, &radii), [&u, &v]);
            for lane in 0..LANES {
                let emitter = Emitter::Sphere(Sphere::new(centers.get(lane), radii[lane], false).expect("a sphere"));
                let bits = |towards: Option<Towards>| {
                    let Towards { direction: Vec3 { x, y, z }, distance, inverse_pdf } = towards?;
                    Some([x, y, z, distance, inverse_pdf].map(f32::to_bits))
                };
                let alone = emitter.sample(from.get(lane), [u[lane], v[lane]]);
                inside += usize::from(alone.is_none());
                assert_eq!(bits(directions.get(lane)), bits(alone));
            }
        }
        assert!(inside > 200 && inside < 7500, "{inside}");
    }
}
