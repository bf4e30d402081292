//! Stanford PLY, as text or binary: positions, normals and faces; other properties are passed over.

use crate::Mesh;
use glam::Vec3;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

struct Vertex {
    position: Vec3,
    normal: Vec3,
}

impl PropertyAccess for Vertex {
    /// What a file does not give stays NaN.
    fn new() -> Self {
        Self { position: Vec3::NAN, normal: Vec3::NAN }
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        let number = match name {
            "x" => &mut self.position.x,
            "y" => &mut self.position.y,
            "z" => &mut self.position.z,
            "nx" => &mut self.normal.x,
            "ny" => &mut self.normal.y,
            "nz" => &mut self.normal.z,
            _ => return PropertyAccessResult::Ignored,
        };
        let Some(given) = value.to_f32_lossy() else { return PropertyAccessResult::UnsupportedType };
        *number = given;
        PropertyAccessResult::Set
    }
}

#[derive(Default)]
struct Face(Vec<u32>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if name != "vertex_indices" && name != "vertex_index" {
            return PropertyAccessResult::Ignored;
        }
        // A negative index is no `u32` either.
        let Some(corners) = value.to_u32_list() else { return PropertyAccessResult::UnsupportedType };
        self.0 = corners;
        PropertyAccessResult::Set
    }
}

struct Other;

impl PropertyAccess for Other {
    fn new() -> Self {
        Self
    }
}

/// The mesh in `bytes`.
pub(super) fn read(bytes: &[u8]) -> Result<Mesh, String> {
    // The first line of a message; the rest may repeat all of the file.
    let bad = |error: ply_rs_bw::parser::ParseError| {
        let text = error.to_string();
        format!("not a good PLY file: {}", super::file::shortened(text.lines().next().unwrap_or_default()))
    };
    let mut reader = Reader::new(bytes);
    let header = Parser::<Other>::new().read_header(&mut reader).map_err(bad)?;
    let mut mesh = Mesh::default();
    let mut has_normals = false;
    for (name, element) in &header.elements {
        if element.count > bytes.len() {
            return Err(format!("announces {} elements \"{name}\" and is shorter than that", element.count));
        }
        match name.as_str() {
            "vertex" => {
                has_normals = element.properties.contains_key("nx");
                let read = Parser::<Vertex>::new().read_payload_for_element(&mut reader, element, &header);
                for vertex in read.map_err(bad)? {
                    mesh.positions.push(vertex.position);
                    mesh.normals.push(vertex.normal);
                }
            }
            "face" => {
                let read = Parser::<Face>::new().read_payload_for_element(&mut reader, element, &header);
                for Face(corners) in read.map_err(bad)? {
                    // A polygon is a fan about its first corner.
                    let pairs = corners.windows(2).skip(1);
                    mesh.triangles.extend(pairs.map(|pair| [corners[0], pair[0], pair[1]]));
                }
            }
            _ => {
                Parser::<Other>::new().read_payload_for_element(&mut reader, element, &header).map_err(bad)?;
            }
        }
    }
    if !has_normals {
        mesh.normals.clear();
    }
    Ok(mesh)
}
