//! Transforms against matrices that Mitsuba 3.9.1 prints, or worked by hand.

use super::{read, scene};
use glam::{Affine3A, Vec3};
use ratiocv_scene::{Geometry, Light};

const HALF: f32 = core::f32::consts::FRAC_1_SQRT_2;

fn to_world(operations: &str) -> Affine3A {
    let body = format!("<shape type='cube'><transform name='to_world'>{operations}</transform></shape>");
    let Geometry::Cube(to_world) = read(&scene(&body)).shapes[0].geometry else { panic!("{operations}") };
    to_world
}

/// The rows of `to_world`.
fn check(operations: &str, rows: [[f32; 4]; 3]) {
    let to_world = to_world(operations);
    for (i, row) in rows.iter().enumerate() {
        let got = [to_world.x_axis[i], to_world.y_axis[i], to_world.z_axis[i], to_world.translation[i]];
        let error = got.iter().zip(row).map(|(got, right)| (got - right).abs()).fold(0.0, f32::max);
        assert!(error <= 1e-6, "{operations}: row {i} is {got:?} instead of {row:?}");
    }
}

#[test]
fn each_operation() {
    check("", [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);
    let moved = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 2.0], [0.0, 0.0, 1.0, 3.0]];
    for operation in ["<translate value='1 2 3'/>", "<translate value='1,2,3'/>", "<translate x='1' y='2' z='3'/>"] {
        check(operation, moved);
    }
    check("<translate y='2'/>", [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 2.0], [0.0, 0.0, 1.0, 0.0]]);
    check("<scale value='2'/>", [[2.0, 0.0, 0.0, 0.0], [0.0, 2.0, 0.0, 0.0], [0.0, 0.0, 2.0, 0.0]]);
    check("<scale x='2'/>", [[2.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);
    check("<rotate x='1' angle='90'/>", [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0]]);
    check("<rotate value='0 0 1' angle='90'/>", [[0.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);
    // Half a turn about (0.6, 0, 0.8) is 2aaᵀ − 1.
    check(
        "<rotate x='0.6' z='0.8' angle='180'/>",
        [[-0.28, 0.0, 0.96, 0.0], [0.0, -1.0, 0.0, 0.0], [0.96, 0.0, 0.28, 0.0]],
    );
    check(
        "<rotate y='1' angle='30'/>",
        [[0.8660254, 0.0, 0.5, 0.0], [0.0, 1.0, 0.0, 0.0], [-0.5, 0.0, 0.8660254, 0.0]],
    );
    check(
        "<lookat origin='1,2,3' target='4 5 6' up='0 1 0'/>",
        [[HALF, -0.408248, 0.57735, 1.0], [0.0, 0.816497, 0.57735, 2.0], [-HALF, -0.408248, 0.57735, 3.0]],
    );
    check(
        "<matrix value='1 2 3 4  5 6 7 8  9 10 12 12  0 0 0 1'/>",
        [[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0], [9.0, 10.0, 12.0, 12.0]],
    );
    check("<matrix value='1 2 3 4 5 6 7 8 10'/>", [[1.0, 2.0, 3.0, 0.0], [4.0, 5.0, 6.0, 0.0], [7.0, 8.0, 10.0, 0.0]]);
}

#[test]
fn quarter_turns_are_exact() {
    for angle in [-450, -270, -180, -90, 0, 90, 180, 270, 360, 450] {
        let turned = to_world(&format!("<rotate x='1' angle='{angle}'/>"));
        let back = to_world(&format!("<rotate x='1' angle='{angle}'/><rotate x='1' angle='{}'/>", -angle));
        assert!([turned.y_axis.y, turned.y_axis.z].iter().all(|entry| [-1.0, 0.0, 1.0].contains(entry)), "{turned}");
        assert_eq!(back, Affine3A::IDENTITY);
    }
}

#[test]
fn later_operations_apply_after_earlier_ones() {
    check("<scale value='2'/><translate x='1'/>", [[2.0, 0.0, 0.0, 1.0], [0.0, 2.0, 0.0, 0.0], [0.0, 0.0, 2.0, 0.0]]);
    check(
        "<translate x='1'/><scale value='2'/><rotate z='1' angle='90'/>",
        [[0.0, -2.0, 0.0, 0.0], [2.0, 0.0, 0.0, 2.0], [0.0, 0.0, 2.0, 0.0]],
    );
}

#[test]
fn spheres_move_turn_and_grow() {
    let body = "<shape type='sphere'><point name='center' x='1' y='0' z='0'/><float name='radius' value='0.5'/>\
                <transform name='to_world'><rotate z='1' angle='90'/><scale value='3'/><translate z='1'/></transform></shape>";
    let shape = &read(&scene(body)).shapes[0];
    let Geometry::Sphere { center, radius } = shape.geometry else { panic!() };
    assert!(center.distance(Vec3::new(0.0, 3.0, 1.0)) <= 1e-6 && radius == 1.5, "{center} {radius}");
    assert!(!shape.flip_normals);
}

/// As Mitsuba 3.9.1 shades them: the normals of spheres turn over, those of rectangles and cubes do not.
#[test]
fn only_spheres_turn_inside_out_in_a_mirror() {
    for (kind, mirrored) in [("sphere", true), ("cube", false), ("rectangle", false)] {
        for (operation, is_mirror) in
            [("<scale x='-1'/>", true), ("<scale value='-1'/>", true), ("<scale x='-1' y='-1'/>", false)]
        {
            for flip in [false, true] {
                let body = format!(
                    "<shape type='{kind}'><boolean name='flip_normals' value='{flip}'/><transform name='to_world'>{operation}</transform></shape>"
                );
                let flipped = read(&scene(&body)).shapes[0].flip_normals;
                assert_eq!(flipped, flip != (mirrored && is_mirror), "{body}");
            }
        }
    }
}

#[test]
fn points_are_placed_by_either() {
    for position in [
        "<point name='position' value='1 2 3'/>",
        "<point name='position' x='1' y='2' z='3'/>",
        "<transform name='to_world'><translate value='1 2 3'/></transform>",
    ] {
        let scene =
            read(&scene(&format!("<emitter type='point'>{position}<rgb name='intensity' value='4 5 6'/></emitter>")));
        let point = Light::Point { position: Vec3::new(1.0, 2.0, 3.0), intensity: Vec3::new(4.0, 5.0, 6.0) };
        assert_eq!(scene.lights[1], point);
    }
}
