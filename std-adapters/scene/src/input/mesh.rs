//! Meshes in files: put into the world, checked, with Mitsuba's normals.

use super::element::Element;
use super::error::Error;
use super::{obj, ply};
use crate::Mesh;
use crate::planted::planted;
use glam::{DAffine3, DVec3, Vec3};
use std::path::Path;

/// A mesh file's bytes as a mesh in its own space, or what is wrong with them.
type Format = fn(&[u8]) -> Result<Mesh, String>;

/// Of a shape of type `kind`.
pub(super) fn read(element: Element<'_>, kind: &str, to_world: &DAffine3) -> Result<Mesh, Error> {
    let format: Format = if kind == "obj" { obj::read } else { ply::read };
    let name = element.string("filename")?;
    let name = name.ok_or_else(|| element.invalid("has no <string name=\"filename\" …>"))?;
    let is_flat = element.boolean("face_normals")?.unwrap_or(false);
    // Beside the scene file; an absolute path stays itself.
    let path = Path::new(element.file.name()).parent().unwrap_or(Path::new("")).join(name);
    let in_file = |what: String| element.invalid(format!("{}: {what}", path.display()));
    let bytes = std::fs::read(&path).map_err(|error| in_file(format!("cannot be read: {error}")))?;
    let mut mesh = format(&bytes).map_err(in_file)?;
    check(&mesh).map_err(in_file)?;
    if is_flat {
        mesh.normals.clear();
    }
    place(&mut mesh, to_world);
    if !mesh.positions.iter().all(|position| position.is_finite()) {
        return Err(in_file("to_world takes it out of the range of numbers".into()));
    }
    mesh.triangles.retain(|corners| normal(&mesh.positions, corners).is_some());
    if mesh.triangles.is_empty() {
        return Err(in_file("has no triangle with an area".into()));
    }
    if mesh.normals.is_empty() && !is_flat {
        mesh.normals = smooth_normals(&mesh).map_err(in_file)?;
    }
    Ok(mesh)
}

/// That all numbers are finite, and all indices in range.
fn check(mesh: &Mesh) -> Result<(), String> {
    let bad = |vectors: &[Vec3]| vectors.iter().position(|vector| !vector.is_finite());
    if let Some(i) = bad(&mesh.positions) {
        return Err(format!("vertex {i} (from 0) is at {}, which is not finite", mesh.positions[i]));
    }
    if let Some(i) = bad(&mesh.normals).or_else(|| mesh.normals.iter().position(|normal| *normal == Vec3::ZERO)) {
        return Err(format!("the normal {} of vertex {i} (from 0) is no direction", mesh.normals[i]));
    }
    if !mesh.normals.is_empty() && mesh.normals.len() != mesh.positions.len() {
        return Err("some vertices have normals and some have none".into());
    }
    let count = mesh.positions.len();
    for (i, corners) in mesh.triangles.iter().enumerate() {
        if let Some(corner) = corners.iter().find(|corner| **corner as usize >= count) {
            return Err(format!("triangle {i} (from 0) has a vertex {corner}, but there are {count} (from 0)"));
        }
    }
    Ok(())
}

/// Into the world. In a mirror Mitsuba's triangles turn over and normals that were given do not; those decide, so
/// triangles then follow them.
fn place(mesh: &mut Mesh, to_world: &DAffine3) {
    for position in &mut mesh.positions {
        *position = to_world.transform_point3(position.as_dvec3()).as_vec3();
    }
    let of_normals = planted!("normals_inverse": to_world.matrix3.inverse().transpose(), to_world.matrix3);
    for normal in &mut mesh.normals {
        *normal = (of_normals * normal.as_dvec3()).normalize().as_vec3();
    }
    if !mesh.normals.is_empty() && planted!("mirrored_mesh": to_world.matrix3.determinant() < 0.0, false) {
        mesh.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    }
}

/// Of a triangle, unless it has no area.
fn normal(positions: &[Vec3], corners: &[u32; 3]) -> Option<DVec3> {
    let [a, b, c] = corners.map(|corner| positions[corner as usize].as_dvec3());
    (b - a).cross(c - a).try_normalize()
}

/// Those of the triangles, weighted by their angles at the vertex (Thürmer and Wüthrich 1998).
fn smooth_normals(mesh: &Mesh) -> Result<Vec<Vec3>, String> {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    let mut is_used = vec![false; mesh.positions.len()];
    for corners in &mesh.triangles {
        let Some(normal) = normal(&mesh.positions, corners) else { continue };
        for k in 0..3 {
            let [at, next, last] = [0, 1, 2].map(|step| mesh.positions[corners[(k + step) % 3] as usize].as_dvec3());
            let cosine = (next - at).normalize().dot((last - at).normalize());
            sums[corners[k] as usize] +=
                normal * planted!("normals_by_angle": libm::acos(cosine.clamp(-1.0, 1.0)), 1.0);
            is_used[corners[k] as usize] = true;
        }
    }
    let mut normals = Vec::with_capacity(sums.len());
    for (i, (sum, is_used)) in sums.iter().zip(is_used).enumerate() {
        match sum.try_normalize() {
            Some(normal) if sum.length() > 1e-6 || !is_used => normals.push(normal.as_vec3()),
            _ if !is_used => normals.push(Vec3::Z),
            _ => {
                return Err(format!(
                    "the triangles about vertex {i} (from 0) face opposite ways; give normals, or \
                     <boolean name=\"face_normals\" value=\"true\"/>"
                ));
            }
        }
    }
    Ok(normals)
}
