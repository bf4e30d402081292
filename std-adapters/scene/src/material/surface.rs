//! A surface as the path tracer reads it.

use crate::colour::PathColour;
use crate::description::{Material, Roughness, Shape};
use crate::error::SceneError;
use crate::geometry::NONE;
use crate::material::Lobes;
use glam::Vec3;

/// α below this is a mirror, which has no density to speak of in `f32`.
const SMOOTHEST: f32 = 1e-3;

/// What a shape is made of and emits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface<C> {
    /// Roughness 0: diffuse.
    pub(crate) lobes: Lobes<C>,
    pub(crate) conductor: bool,
    /// Reflects nothing: paths end.
    pub(crate) black: bool,
    pub(crate) two_sided: bool,
    /// On the side of the normal.
    pub(crate) emission: C,
    /// Its light, if it emits.
    pub(crate) light: u32,
}

/// Every channel is finite and in [0, `most`].
pub(crate) fn within(v: Vec3, most: f32) -> bool {
    v.to_array().iter().all(|x| (0.0..=most).contains(x) && x.is_finite())
}

impl<C: PathColour> Surface<C> {
    /// Of shape `i`.
    pub(crate) fn new(shape: &Shape, i: usize) -> Result<Self, SceneError> {
        let (reflectance, roughness, conductor) = match shape.surface.material {
            Material::Diffuse { reflectance } => (reflectance, Vec3::ZERO, false),
            Material::Conductor { roughness: Roughness::Grey(a), reflectance } => (reflectance, Vec3::splat(a), true),
            Material::Conductor { roughness: Roughness::Chromatic(a), reflectance } => (reflectance, a, true),
            Material::Null => (Vec3::ONE, Vec3::ZERO, false),
        };
        let emission = shape.emission.unwrap_or(Vec3::ZERO);
        if !within(reflectance, 1.0) || !within(roughness, f32::MAX) || !within(emission, f32::MAX) {
            return Err(SceneError::Value(i));
        }
        let roughness = if conductor { roughness.max(Vec3::splat(SMOOTHEST)) } else { roughness };
        Ok(Self {
            lobes: Lobes { reflectance: C::of(reflectance), roughness: C::of(roughness) },
            conductor,
            black: reflectance == Vec3::ZERO,
            two_sided: shape.surface.two_sided,
            emission: C::of(emission),
            light: NONE,
        })
    }
}
