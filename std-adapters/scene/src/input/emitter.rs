//! `<emitter>`: light from surfaces, from points, from everywhere.

use super::element::Element;
use super::error::Error;
use crate::Light;
use glam::{DAffine3, DVec3, Vec3};

/// The radiance of an `area` emitter.
pub(super) fn area(emitter: Element<'_>) -> Result<Vec3, Error> {
    match emitter.kind()?.as_str() {
        "area" => {}
        "constant" | "point" => return Err(emitter.invalid("belongs into <scene>; the emitter of a shape is an area")),
        _ => return Err(emitter.unsupported_type("area")),
    }
    let radiance = emitter.color("radiance", f64::MAX)?.unwrap_or(DVec3::ONE).as_vec3();
    emitter.finish()?;
    Ok(radiance)
}

/// The lights of `scene` that are not surfaces.
pub(super) fn read(scene: Element<'_>) -> Result<Vec<Light>, Error> {
    let mut lights: Vec<Light> = Vec::new();
    for emitter in scene.objects("emitter")? {
        let Some(light) = emitter.or_leave_out(light(emitter), "left out")? else { continue };
        let is_environment = |light: &Light| matches!(light, Light::Environment(_));
        if is_environment(&light) && lights.iter().any(is_environment) {
            return Err(emitter.invalid("a second constant emitter; there is one environment"));
        }
        lights.push(light);
    }
    Ok(lights)
}

fn light(emitter: Element<'_>) -> Result<Light, Error> {
    let light = match emitter.kind()?.as_str() {
        "constant" => Light::Environment(emitter.color("radiance", f64::MAX)?.unwrap_or(DVec3::ONE).as_vec3()),
        "point" => Light::Point {
            position: position(emitter)?.as_vec3(),
            intensity: emitter.color("intensity", f64::MAX)?.unwrap_or(DVec3::ONE).as_vec3(),
        },
        "area" => return Err(emitter.invalid("belongs into a <shape>")),
        _ => return Err(emitter.unsupported_type("point, constant, and area within a shape")),
    };
    emitter.finish()?;
    Ok(light)
}

fn position(emitter: Element<'_>) -> Result<DVec3, Error> {
    match (emitter.point("position")?, emitter.transform("to_world")?) {
        (Some(_), Some(_)) => Err(emitter.invalid("has both position and to_world; give one of them")),
        (Some(position), None) => Ok(position),
        (None, to_world) => Ok(to_world.unwrap_or(DAffine3::IDENTITY).translation),
    }
}
