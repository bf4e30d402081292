//! Meshes in files.

use super::{LIGHT, SENSOR};
use glam::Vec3;
use ratiocv_scene::{Description, Error, Geometry, Leniency, Mesh};

const POSITIONS: [[f32; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];
/// Counterclockwise seen from outside.
const FACES: [[u32; 4]; 6] = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

fn obj() -> Vec<u8> {
    let mut text = "# A cube.\nmtllib none.mtl\no cube\n".to_owned();
    for [x, y, z] in POSITIONS {
        text += &format!("v {x} {y} {z}\n");
    }
    for (i, face) in FACES.iter().enumerate() {
        // Half of them by relative indices.
        let corner = |c: &u32| if i % 2 == 0 { i64::from(*c) + 1 } else { i64::from(*c) - 8 };
        text += &format!("f {}\n", face.iter().map(|c| corner(c).to_string()).collect::<Vec<_>>().join(" "));
    }
    text.into_bytes()
}

fn ply_header(format: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

fn ply_as_text() -> Vec<u8> {
    let mut text = ply_header("ascii");
    for [x, y, z] in POSITIONS {
        text += &format!("{x} {y} {z} 7\n");
    }
    for [a, b, c, d] in FACES {
        text += &format!("4 {a} {b} {c} {d}\n");
    }
    text.into_bytes()
}

fn ply_as_bytes(is_little: bool) -> Vec<u8> {
    let mut bytes = ply_header(if is_little { "binary_little_endian" } else { "binary_big_endian" }).into_bytes();
    let order = |word: [u8; 4]| if is_little { word } else { [word[3], word[2], word[1], word[0]] };
    for position in POSITIONS {
        position.iter().for_each(|x| bytes.extend(order(x.to_le_bytes())));
        bytes.push(7);
    }
    for face in FACES {
        bytes.push(4);
        face.iter().for_each(|corner| bytes.extend(order(corner.to_le_bytes())));
    }
    bytes
}

/// The mesh in `bytes`, in a shape with further parameters `inner`. The shape is on line 2.
fn load(kind: &str, bytes: &[u8], inner: &str) -> Result<Mesh, Error> {
    let folder = tempfile::tempdir().unwrap();
    let (scene, mesh) = (folder.path().join("scene.xml"), format!("mesh.{kind}"));
    std::fs::write(folder.path().join(&mesh), bytes).unwrap();
    let shape = format!("<shape type='{kind}'><string name='filename' value='{mesh}'/>{inner}</shape>");
    std::fs::write(&scene, format!("<scene version='3.0.0'>{SENSOR}{LIGHT}\n{shape}</scene>")).unwrap();
    let (mut description, _) = Description::read(&scene, Leniency::Strict)?;
    let Geometry::Mesh(mesh) = description.shapes.remove(0).geometry else { panic!("{kind}") };
    Ok(mesh)
}

/// The corners of each triangle in space.
fn corners(mesh: &Mesh) -> Vec<[Vec3; 3]> {
    mesh.triangles.iter().map(|triangle| triangle.map(|corner| mesh.positions[corner as usize])).collect()
}

const FLAT: &str = "<boolean name='face_normals' value='true'/>";

#[test]
fn all_formats_give_the_same_cube() {
    let fan = |face: [u32; 4]| {
        let at = |corner: usize| Vec3::from(POSITIONS[face[corner] as usize]);
        [[at(0), at(1), at(2)], [at(0), at(2), at(3)]]
    };
    let right: Vec<[Vec3; 3]> = FACES.into_iter().flat_map(fan).collect();
    for (kind, bytes) in
        [("obj", obj()), ("ply", ply_as_text()), ("ply", ply_as_bytes(true)), ("ply", ply_as_bytes(false))]
    {
        let mesh = load(kind, &bytes, FLAT).unwrap();
        assert_eq!((corners(&mesh), mesh.normals.len()), (right.clone(), 0));
        for [a, b, c] in corners(&mesh) {
            assert!((b - a).cross(c - a).dot(a) > 0.0, "the normal points inwards");
        }
        // Without face_normals, Mitsuba makes them smooth: towards the corners, here.
        let mesh = load(kind, &bytes, "").unwrap();
        for (normal, position) in mesh.normals.iter().zip(&mesh.positions) {
            assert!(normal.distance(position.normalize()) <= 1e-6, "{normal} at {position}");
        }
        assert_eq!(mesh.normals.len(), 8);
    }
}

#[test]
fn meshes_are_put_into_the_world() {
    let to_world = "<transform name='to_world'><scale x='2' y='-1'/><translate z='5'/></transform>";
    let mesh = load("ply", &ply_as_text(), &format!("{FLAT}{to_world}")).unwrap();
    let right: Vec<Vec3> = POSITIONS.iter().map(|[x, y, z]| Vec3::new(2.0 * x, -y, z + 5.0)).collect();
    assert_eq!(mesh.positions, right);
}

/// Mitsuba 3.9.1 gives these for this mesh: weights by angle, here 90° each.
#[test]
fn smooth_normals_are_weighted_by_angle() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n";
    let mesh = load("obj", text, "").unwrap();
    let half = core::f32::consts::FRAC_1_SQRT_2;
    let at = |position: [f32; 3]| mesh.normals[mesh.positions.iter().position(|p| *p == Vec3::from(position)).unwrap()];
    for (position, normal) in [
        ([0.0, 0.0, 0.0], [0.0, half, half]),
        ([1.0, 0.0, 0.0], [0.0, half, half]),
        ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
        ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]),
    ] {
        assert!(at(position).distance(Vec3::from(normal)) <= 1e-6, "{}", at(position));
    }
    // 90° of one triangle and 45° of another: (0, 1, 2)/√5.
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 1\nf 1 2 3\nf 1 4 2\n";
    let mesh = load("obj", text, "").unwrap();
    assert!(mesh.normals[0].distance(Vec3::new(0.0, 1.0, 2.0) / libm::sqrtf(5.0)) <= 1e-6, "{}", mesh.normals[0]);
}

#[test]
fn given_normals_turn_with_the_mesh_and_decide_its_sides() {
    let text = b"v -1 -1 0\nv 1 -1 0\nv 1 1 0\nvn 0 3 4\nf 1//1 2//1 3//1\n";
    let mesh = load("obj", text, "<transform name='to_world'><scale z='2'/></transform>").unwrap();
    // As normals do: by the inverse transposed, (0, 3, 2)/√13.
    assert!(mesh.normals[0].distance(Vec3::new(0.0, 3.0, 2.0) / libm::sqrtf(13.0)) <= 1e-6, "{}", mesh.normals[0]);
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    let mirror = "<transform name='to_world'><scale x='-1'/></transform>";
    let mesh = load("obj", text, mirror).unwrap();
    let [a, b, c] = corners(&mesh)[0];
    assert!((b - a).cross(c - a).dot(mesh.normals[0]) > 0.0);
    // Without normals, the triangle turns over.
    let mesh = load("obj", b"v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n", mirror).unwrap();
    assert_eq!(mesh.normals, [Vec3::NEG_Z; 3]);
}

#[test]
fn triangles_without_area_are_left_out() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 4\nf 1 2 3\nf 2 2 3\n";
    assert_eq!(load("obj", text, FLAT).unwrap().triangles.len(), 1);
}

#[test]
fn bad_meshes() {
    let ply = |header: &str, body: &str| format!("ply\nformat ascii 1.0\n{header}end_header\n{body}").into_bytes();
    let vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    let faces = "element face 1\nproperty list uchar int vertex_indices\n";
    let corners = "0 0 0\n1 0 0\n0 1 0\n";
    let (both, xyz) = (format!("{vertices}{faces}"), "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    let binary = |word: [u8; 4]| {
        let mut bytes = ply_as_bytes(true);
        let at = ply_header("binary_little_endian").len();
        bytes[at..at + 4].copy_from_slice(&word);
        bytes
    };
    let obj = |rest: &str| format!("{xyz}{rest}").into_bytes();
    let cases: Vec<(&str, Vec<u8>, &str)> = vec![
        ("obj", obj("f 1 2 4\n"), "line 4: the face has an index \"4\", but there are 3 vertices"),
        ("obj", obj("f 1 2 -4\n"), "line 4: the face has an index \"-4\""),
        ("obj", obj("f 0 1 2\n"), "line 4: the face has an index \"0\""),
        // tobj's arithmetic would overflow on these.
        ("obj", obj("vn 0 0 1\nf 1//6148914691236517206 2//1 3//1\n"), "line 5: the face has an index"),
        ("obj", obj("vn 0 0 1\nf 1//-3 2//1 3//1\n"), "line 5: the face has an index"),
        ("obj", obj("f 1/2/3/4 2 3\n"), "line 4: the face has an index"),
        ("obj", obj("f\n"), "not a good OBJ file"),
        ("obj", obj("vn 0 0 1\nf 1//1 2 3\n"), "some corners of a face have normals"),
        ("obj", obj("vn 0 0 0\nf 1//1 2//1 3//1\n"), "the normal [0, 0, 0] of vertex 0"),
        ("obj", obj("v nan 0 0\nf 1 2 4\n"), "which is not finite"),
        ("obj", obj("v 1 inf 0\nf 1 2 4\n"), "which is not finite"),
        ("obj", obj("v 1 x 0\n"), "not a good OBJ file: position parse error"),
        ("obj", obj("f 1 2 2\n"), "has no triangle with an area"),
        ("obj", obj("f 1 2 3\nf 1 3 2\n"), "face opposite ways"),
        ("obj", Vec::new(), "has no triangle with an area"),
        ("obj", b"\xff\xfe".to_vec(), "is not text"),
        ("ply", ply(&both, &format!("{corners}3 0 1 3\n")), "triangle 0 (from 0) has a vertex 3, but there are 3"),
        ("ply", ply(&both, &format!("{corners}3 0 1 -1\n")), "not a good PLY file"),
        ("ply", ply(&both, &format!("{corners}2 0 1\n")), "has no triangle with an area"),
        ("ply", ply(&both, corners), "not a good PLY file"),
        ("ply", ply(&both.replace("vertex 3", "vertex 4000000000000"), corners), "announces 4000000000000 elements"),
        ("ply", ply("element air 4000000000000\n", ""), "announces 4000000000000 elements"),
        ("ply", ply(&both.replace("property float z\n", ""), "0 0\n1 0\n0 1\n3 0 1 2\n"), "which is not finite"),
        ("ply", binary(f32::NAN.to_le_bytes()), "vertex 0 (from 0) is at [NaN, -1, -1], which is not finite"),
        ("ply", Vec::new(), "not a good PLY file"),
        ("ply", b"ply\xff".to_vec(), "not a good PLY file"),
    ];
    for (kind, bytes, part) in cases {
        let error = load(kind, &bytes, "").expect_err(part);
        let text = error.to_string();
        assert_eq!(error.line(), Some(2), "{text}");
        assert!(text.contains(&format!("mesh.{kind}: ")) && text.contains(part), "{text}\ninstead of: {part}");
        assert!(text.len() < 500, "{text}");
    }
}

#[test]
fn a_mesh_that_is_not_there_is_named_with_the_line_of_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.xml");
    let shape = "<shape type='ply'><string name='filename' value='none.ply'/></shape>";
    std::fs::write(&scene, format!("<scene version='3.0.0'>{SENSOR}{LIGHT}\n\n{shape}</scene>")).unwrap();
    let text = Description::read(&scene, Leniency::Strict).unwrap_err().to_string();
    let mesh = folder.path().join("none.ply");
    assert!(text.starts_with(&format!("{}, line 3", scene.display())), "{text}");
    assert!(text.contains(&format!("{}: cannot be read", mesh.display())), "{text}");
}

/// Any prefix, and any byte set to 0, 9 or 255.
#[test]
fn damaged_meshes_do_not_panic() {
    for (kind, bytes) in [("obj", obj()), ("ply", ply_as_text()), ("ply", ply_as_bytes(true))] {
        for end in (0..bytes.len()).step_by(7) {
            let _ = load(kind, &bytes[..end], "");
        }
        for at in (0..bytes.len()).step_by(3) {
            for byte in [0, b'9', b'-', 255] {
                let mut bytes = bytes.clone();
                bytes[at] = byte;
                let _ = load(kind, &bytes, "");
            }
        }
    }
}
