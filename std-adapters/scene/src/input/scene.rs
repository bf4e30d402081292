//! `<scene>`: the whole.

use super::element::Element;
use super::error::Error;
use super::file::File;
use super::{emitter, integrator, sensor, shape, surface};
use crate::{Description, Light};
use glam::Vec3;

/// The scene that `file` describes.
pub(super) fn read<'a>(file: &'a File<'a>) -> Result<Description, Error> {
    let scene = file.root();
    if scene.tag() != "scene" {
        return Err(scene.invalid("the outermost element must be <scene version=\"3.0.0\">"));
    }
    scene.only_attributes(&["version", "id", "name", "type"])?;
    let version = scene.required("version")?;
    if !matches!(version.split('.').next(), Some("2" | "3")) {
        return Err(scene.unsupported(format!("version {version} is not supported; 2 and 3 are")));
    }
    // Those that no shape refers to are read too, so that mistakes in them do not stay hidden.
    for bsdf in scene.objects("bsdf")? {
        bsdf.or_leave_out(surface::read(bsdf), "grey of reflectance 0.5 instead")?;
    }
    // What a medium is named, and so whether it is supported, is said where it is used.
    scene.objects("medium")?;
    let lights = emitter::read(scene)?;
    let shapes = shape::read(scene)?;
    let depths = integrator::read(scene)?;
    let sensor = sensor::read(scene)?;
    scene.finish()?;
    let description = Description {
        max_depth: depths.longest,
        roulette_depth: depths.roulette,
        camera: sensor.camera,
        size: sensor.size,
        filter: sensor.filter,
        samples: sensor.samples,
        shapes,
        lights,
    };
    check_light(scene, &description)?;
    Ok(description)
}

/// Without light an image is black, and nobody means that.
fn check_light(scene: Element<'_>, description: &Description) -> Result<(), Error> {
    let surfaces = description.shapes.iter().filter_map(|shape| shape.emission);
    let others = description.lights.iter().map(|light| match light {
        Light::Environment(radiance) => *radiance,
        Light::Point { intensity, .. } => *intensity,
    });
    if surfaces.chain(others).any(|light| light.cmpgt(Vec3::ZERO).any()) {
        return Ok(());
    }
    Err(scene.invalid("nothing emits light; add an <emitter>: area in a shape, point or constant in the scene"))
}
