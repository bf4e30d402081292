//! `<medium>`: what a sphere or a cube is filled with.

use super::element::Element;
use super::error::Error;
use crate::Medium;
use crate::planted::planted;
use glam::DVec3;

/// Of a `<medium>`.
pub(super) fn read(medium: Element<'_>) -> Result<Medium, Error> {
    if medium.name() != "interior" {
        return Err(medium.unsupported("must be named \"interior\"; other media of a shape are not supported"));
    }
    if medium.kind()? != "homogeneous" {
        return Err(medium.unsupported_type("homogeneous"));
    }
    let scale = medium.float("scale", |scale| (0.0..=1e12).contains(&scale), "from 0 to 1e12")?.unwrap_or(1.0);
    let extinction = medium.color("sigma_t", 1e12)?.unwrap_or(DVec3::ONE);
    let albedo = medium.color("albedo", 1.0)?.unwrap_or(DVec3::splat(0.75));
    if let Some(phase) = medium.object("phase")? {
        if phase.kind()? != "isotropic" {
            return Err(phase.unsupported_type("isotropic"));
        }
        phase.finish()?;
    }
    medium.finish()?;
    Ok(Medium {
        extinction: planted!("medium_scale": extinction * scale, extinction).as_vec3(),
        albedo: albedo.as_vec3(),
    })
}
