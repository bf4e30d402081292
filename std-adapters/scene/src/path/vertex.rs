//! Where a path scatters, and by which law.

use crate::colour::PathColour;
use crate::frame::{Frame, cosine_direction, uniform_direction};
use crate::geometry::Point;
use crate::light::Facing;
use crate::material::{Lobes, Surface};
use crate::random::Random;
use core::f32::consts::FRAC_1_PI;
use glam::Vec3;

/// What scatters light at a vertex.
pub(super) struct Vertex<C> {
    pub(super) point: Point,
    /// Where the ray came from.
    wi: Vec3,
    law: Law,
    pub(super) lobes: Lobes<C>,
    /// On the side of the ray.
    pub(super) normal: Vec3,
    /// The one that scatters.
    pub(super) shading: Vec3,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Law {
    Diffuse,
    Conductor,
    Isotropic,
}

/// f·cos and the densities of a direction: f·cos is `over_density`·`density`, channel by channel.
pub(super) struct Scattered<C> {
    pub(super) over_density: C,
    pub(super) density: C,
}

impl<C: PathColour> Vertex<C> {
    /// Of a medium, where a ray in `direction` came to.
    #[inline(always)]
    pub(super) const fn inside(position: Vec3, direction: Vec3) -> Self {
        Self {
            point: Point::free(position),
            wi: Vec3::new(-direction.x, -direction.y, -direction.z),
            law: Law::Isotropic,
            lobes: Lobes { reflectance: C::ONE, roughness: C::ZERO },
            normal: direction,
            shading: direction,
        }
    }

    /// Of a surface, where a ray in `direction` came to; `None` if it scatters nothing there.
    #[inline(always)]
    pub(super) fn on<const CONDUCTORS: bool>(point: Point, surface: &Surface<C>, direction: Vec3) -> Option<Self> {
        let front = point.normal.dot(direction) < 0.0;
        if surface.black || !(front || surface.two_sided) {
            return None;
        }
        let side = if front { 1.0 } else { -1.0 };
        let normal = point.normal * side;
        let shading = point.shading * side;
        let shading = if shading.dot(direction) < 0.0 { shading } else { normal };
        let law = if CONDUCTORS && surface.conductor { Law::Conductor } else { Law::Diffuse };
        Some(Self { point, wi: -direction, law, lobes: surface.lobes, normal, shading })
    }

    /// Of a direction from it; `None` below the horizon.
    #[inline(always)]
    pub(super) fn scattered<const CONDUCTORS: bool, const MEDIA: bool>(&self, wo: Vec3) -> Option<Scattered<C>> {
        if MEDIA && self.law == Law::Isotropic {
            return Some(Scattered { over_density: C::ONE, density: C::splat(0.25 * FRAC_1_PI) });
        }
        let cos = self.shading.dot(wo);
        if !(cos > 0.0 && self.normal.dot(wo) > 0.0) {
            return None;
        }
        Some(if CONDUCTORS && self.law == Law::Conductor {
            let frame = Frame::about(self.shading);
            let [wi, wo] = [frame.to_local(self.wi), frame.to_local(wo)];
            Scattered { over_density: self.lobes.over_density(wo), density: self.lobes.density(wi, wo) }
        } else {
            Scattered { over_density: self.lobes.reflectance, density: C::splat(cos * FRAC_1_PI) }
        })
    }

    /// A direction by channel `channel`'s density; `over_density` is 0 below the horizon.
    #[inline(always)]
    pub(super) fn sample<const CONDUCTORS: bool, const MEDIA: bool>(
        &self,
        channel: usize,
        random: &mut Random,
    ) -> (Vec3, Scattered<C>) {
        let u = random.uniforms();
        if MEDIA && self.law == Law::Isotropic {
            let density = C::splat(0.25 * FRAC_1_PI);
            return (uniform_direction(u), Scattered { over_density: C::ONE, density });
        }
        let frame = Frame::about(self.shading);
        let (local, over_density, density) = if CONDUCTORS && self.law == Law::Conductor {
            let (wo, density) = self.lobes.sample(channel, frame.to_local(self.wi), u);
            (wo, self.lobes.over_density(wo), density)
        } else {
            let wo = cosine_direction(u);
            (wo, self.lobes.reflectance, C::splat(wo.z * FRAC_1_PI))
        };
        let wo = frame.to_world(local);
        let above = local.z > 0.0 && self.normal.dot(wo) > 0.0;
        (wo, Scattered { over_density: if above { over_density } else { C::ZERO }, density })
    }

    #[inline(always)]
    pub(super) fn facing<const CONDUCTORS: bool, const MEDIA: bool>(&self) -> Facing {
        match self.law {
            Law::Isotropic if MEDIA => Facing::Any,
            Law::Conductor if CONDUCTORS => Facing::Above(self.shading),
            _ => Facing::Cosine(self.shading),
        }
    }
}
