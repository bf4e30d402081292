//! Wavefront OBJ: all objects of a file as one mesh; materials are passed over.

use crate::Mesh;
use glam::Vec3;
use tobj::{LoadError, LoadOptions};

/// The mesh in `bytes`.
pub(super) fn read(bytes: &[u8]) -> Result<Mesh, String> {
    let text = core::str::from_utf8(bytes).map_err(|error| format!("is not text: {error}"))?;
    check_indices(text)?;
    let options = LoadOptions { single_index: true, triangulate: true, ignore_points: true, ignore_lines: true };
    let no_materials = |_: &std::path::Path| Err(LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, no_materials)
        .map_err(|error| format!("not a good OBJ file: {error}"))?;
    let mut mesh = Mesh::default();
    let vectors = |numbers: &[f32]| numbers.chunks_exact(3).map(Vec3::from_slice).collect::<Vec<_>>();
    for model in models {
        let first = mesh.positions.len() as u32;
        let (positions, normals) = (vectors(&model.mesh.positions), vectors(&model.mesh.normals));
        if !normals.is_empty() && normals.len() != positions.len() {
            return Err("some corners of a face have normals and some have none".into());
        }
        mesh.positions.extend(positions);
        mesh.normals.extend(normals);
        let corners = |corners: &[u32]| [first + corners[0], first + corners[1], first + corners[2]];
        mesh.triangles.extend(model.mesh.indices.chunks_exact(3).map(corners));
    }
    Ok(mesh)
}

/// That the indices of faces are in range: tobj does not say in which line one is not, and its arithmetic
/// overflows on some.
fn check_indices(text: &str) -> Result<(), String> {
    let words = || text.lines().map(str::split_whitespace).enumerate();
    let kinds = ["v", "vt", "vn"];
    let mut totals = [0_i64; 3];
    for (_, mut line) in words() {
        if let Some(k) = line.next().and_then(|word| kinds.iter().position(|kind| *kind == word)) {
            totals[k] += 1;
        }
    }
    let mut so_far = [0_i64; 3];
    for (number, mut line) in words() {
        let first = line.next().unwrap_or_default();
        if let Some(k) = kinds.iter().position(|kind| *kind == first) {
            so_far[k] += 1;
        }
        if first != "f" && first != "l" {
            continue;
        }
        for word in line {
            for (k, index) in word.split('/').enumerate().filter(|(_, index)| !index.is_empty()) {
                // Those below 0 count back from here.
                let is_right = match (index.parse::<i64>(), totals.get(k)) {
                    (Ok(index), Some(total)) => (1..=*total).contains(&index) || (-so_far[k]..0).contains(&index),
                    _ => false,
                };
                if !is_right {
                    return Err(format!(
                        "line {}: the face has an index \"{}\", but there are {} vertices, {} texture coordinates \
                         and {} normals (from 1)",
                        number + 1,
                        super::file::shortened(word),
                        totals[0],
                        totals[1],
                        totals[2]
                    ));
                }
            }
        }
    }
    Ok(())
}
