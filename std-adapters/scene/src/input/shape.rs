//! `<shape>`: where surfaces are, what they are made of, what they emit and hold.

use super::element::Element;
use super::error::Error;
use super::transform::{invertible, single, uniform_scale};
use super::{emitter, medium, mesh, surface};
use crate::planted::planted;
use crate::{Geometry, Material, Shape, Surface};
use glam::{DAffine3, DVec3, Vec3};

/// The shapes of `scene`.
pub(super) fn read(scene: Element<'_>) -> Result<Vec<Shape>, Error> {
    let mut shapes = Vec::new();
    for element in scene.objects("shape")? {
        shapes.extend(element.or_leave_out(shape(element), "left out")?.flatten());
    }
    Ok(shapes)
}

/// A shape; `None` if nothing is to be seen of it.
fn shape(element: Element<'_>) -> Result<Option<Shape>, Error> {
    let (geometry, is_mirrored) = geometry(element)?;
    let emission = match element.object("emitter")? {
        Some(emitter) => emitter.or_leave_out(emitter::area(emitter), "left out")?,
        None => None,
    };
    let medium = match element.object("medium")? {
        Some(medium) => Some(medium::read(medium)?),
        None => None,
    };
    let surface = surface(element, emission.is_some())?;
    let flip_normals = element.boolean("flip_normals")?.unwrap_or(false) != is_mirrored;
    let visible_to_camera = element.boolean("visible_to_camera")?.unwrap_or(true);
    element.finish()?;
    let is_null = surface.material == Material::Null;
    if medium.is_some() && !is_null {
        return Err(element.unsupported(
            "holds a medium, so its bsdf must be <bsdf type=\"null\"/>; only index-matched bounds are supported",
        ));
    }
    if medium.is_some() && !matches!(geometry, Geometry::Sphere { .. } | Geometry::Cube(_)) {
        return Err(element.unsupported("holds a medium; supported are media in a sphere or a cube"));
    }
    if emission.is_some() && is_null {
        return Err(element.unsupported("emits, so its bsdf must not be null"));
    }
    if is_null && medium.is_none() {
        return Ok(None);
    }
    Ok(Some(Shape { geometry, surface, emission, medium, flip_normals, visible_to_camera }))
}

/// As Mitsuba has it, a shape without a bsdf is grey, and black if it emits.
fn surface(element: Element<'_>, emits: bool) -> Result<Surface, Error> {
    match element.object("bsdf")? {
        Some(bsdf) => {
            Ok(bsdf.or_leave_out(surface::read(bsdf), "grey of reflectance 0.5 instead")?.unwrap_or(surface::GREY))
        }
        None if emits => Ok(Surface { material: Material::Diffuse { reflectance: Vec3::ZERO }, two_sided: false }),
        None => Ok(surface::GREY),
    }
}

/// Where it is, and whether its normals are turned by a transform that mirrors.
fn geometry(element: Element<'_>) -> Result<(Geometry, bool), Error> {
    let kind = element.kind()?;
    if !["sphere", "rectangle", "cube", "obj", "ply"].contains(&kind.as_str()) {
        return Err(element.unsupported_type("sphere, rectangle, cube, obj, ply"));
    }
    let to_world = invertible(element, element.transform("to_world")?.unwrap_or(DAffine3::IDENTITY))?;
    match kind.as_str() {
        "sphere" => sphere(element, &to_world),
        // Normals are transformed as such, so that mirroring does not turn them over.
        "rectangle" => Ok((Geometry::Rectangle(single(&to_world)), false)),
        "cube" => Ok((Geometry::Cube(single(&to_world)), false)),
        _ => Ok((Geometry::Mesh(mesh::read(element, &kind, &to_world)?), false)),
    }
}

fn sphere(element: Element<'_>, to_world: &DAffine3) -> Result<(Geometry, bool), Error> {
    let scale = uniform_scale(to_world)
        .ok_or_else(|| element.unsupported("to_world of a sphere may scale uniformly, rotate and move, no more"))?;
    let center = to_world.transform_point3(element.point("center")?.unwrap_or(DVec3::ZERO)).as_vec3();
    let radius = element.float("radius", |radius| radius > 0.0, "above 0")?.unwrap_or(1.0)
        * planted!("sphere_scale": scale, 1.0);
    if !(center.is_finite() && (1e-12..=1e12).contains(&radius)) {
        return Err(element.invalid(format!("its radius {radius:e} must be from 1e-12 to 1e12, and its center finite")));
    }
    // Mitsuba's spheres, unlike its other shapes, turn inside out in a mirror.
    let is_mirrored = planted!("mirrored_sphere": to_world.matrix3.determinant() < 0.0, false);
    Ok((Geometry::Sphere { center, radius: radius as f32 }, is_mirrored))
}
