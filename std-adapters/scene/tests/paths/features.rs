//! What no built-in scene has, or not alone, against closed forms.

use crate::support::{built, grey, lit, look_at, quad, scene as description, shape, sphere};
use crate::{PLAIN, RATIO, Rgb, agree, means_of_h_in, plain_image, plain_pixel, ratio_pixel};
use core::f64::consts::PI;
use glam::{Affine3A, DVec3, Vec3, vec3};
use ratiocv_scene::{BLOCK, Description, Filter, Geometry, Light, Mesh, Options, Scene, Shape};

fn prepared(description: &Description, options: Options) -> Scene<Rgb> {
    Scene::new(description, &options).expect("a sound scene")
}

/// One pixel that sees the origin from a slant, and of it a thousandth of a degree.
fn spot(shapes: Vec<Shape>) -> Description {
    let camera = look_at(vec3(1.0, 1.5, 4.0), Vec3::ZERO, 1e-3);
    Description { size: [1, 1], shapes, ..description(camera, Some(2)) }
}

const REFLECTANCE: f64 = 0.5;

/// A small piece of floor about the origin.
fn ground() -> Shape {
    shape(quad(Vec3::ZERO, Vec3::Z * 0.1, Vec3::X * 0.1), grey(REFLECTANCE as f32), true)
}

/// With plain Monte Carlo and with the ratio, in the kernel that the scene needs and in that which has everything.
#[track_caller]
fn is_seen(description: &Description, right: [f64; 3], what: &str) {
    for options in [PLAIN, RATIO] {
        for scene in [prepared(description, options), prepared(description, options).with_everything()] {
            agree(plain_pixel(&scene, [0, 0], 256, BLOCK, 21), right, [0.0; 3], what);
            if options.auxiliary {
                agree(ratio_pixel(&scene, [0, 0], 256, 22), right, [0.0; 3], what);
            }
        }
    }
}

/// What a diffuse surface of normal `normal` at `place` reflects of a point light: albedo/π·I·cos/distance².
fn of_point(position: Vec3, intensity: Vec3, (place, normal): (DVec3, DVec3)) -> [f64; 3] {
    let to = position.as_dvec3() - place;
    let cos = normal.dot(to.normalize()).max(0.0);
    (intensity.as_dvec3() * (REFLECTANCE / PI * cos / to.length_squared())).to_array()
}

#[test]
fn point_lights() {
    let lights = [(vec3(1.0, 2.0, 0.5), vec3(3.0, 1.0, 0.2)), (vec3(-2.0, 1.0, 1.0), vec3(0.1, 2.0, 6.0))];
    let of = |lights: &[(Vec3, Vec3)], shapes| Description {
        lights: lights
            .iter()
            .map(|(position, intensity)| Light::Point { position: *position, intensity: *intensity })
            .collect(),
        ..spot(shapes)
    };
    let each = lights.map(|(position, intensity)| of_point(position, intensity, (DVec3::ZERO, DVec3::Y)));
    let both = core::array::from_fn(|j| each[0][j] + each[1][j]);
    for (light, right) in lights.iter().zip(each) {
        is_seen(&of(&[*light], vec![ground()]), right, "one light");
    }
    is_seen(&of(&lights, vec![ground()]), both, "two lights");
    // One is hidden, by a ball half way, and one is below the floor.
    let ball = shape(sphere(lights[1].0 * 0.5, 0.2), grey(0.0), false);
    let below = (vec3(0.0, -1.0, 0.0), Vec3::ONE);
    is_seen(&of(&[lights[0], lights[1], below], vec![ground(), ball]), each[0], "one of three lights");
}

/// A square light of half-width 1 one unit above the origin: albedo·radiance·(form factor), which is 4 times
/// that of a quarter, (1/π)·(1/√2)·atan(1/√2). A ball of radius r at a distance d: (r/d)²·cos.
#[test]
fn lights_of_every_shape() {
    let radiance = vec3(4.0, 1.0, 0.25);
    let reflected = |factor: f64| (radiance.as_dvec3() * (REFLECTANCE * factor)).to_array();
    let square = 4.0 / PI * (0.5_f64).sqrt() * libm::atan((0.5_f64).sqrt());
    let rectangle = quad(Vec3::Y, Vec3::X, Vec3::Z);
    let positions = [vec3(-1.0, 1.0, -1.0), vec3(1.0, 1.0, -1.0), vec3(1.0, 1.0, 1.0), vec3(-1.0, 1.0, 1.0)];
    // Areas 2, 1 and 1, and normals that look down.
    let part = vec3(-1.0, 1.0, 0.0);
    let triangles = vec![[0, 1, 2], [0, 2, 4], [4, 2, 3]];
    let mesh = Mesh { positions: [&positions[..], &[part]].concat(), normals: Vec::new(), triangles };
    let cube = Geometry::Cube(Affine3A::from_translation(Vec3::Y * 2.0));
    for (geometry, factor, what) in [
        (rectangle, square, "rectangle"),
        (Geometry::Mesh(mesh), square, "mesh"),
        (cube, square, "cube"),
        (sphere(vec3(0.0, 3.0, 4.0), 0.5), 0.01 * 3.0 / 5.0, "sphere"),
    ] {
        // What the camera sees must not be the light itself.
        let light = Shape { visible_to_camera: false, ..lit(geometry, radiance) };
        is_seen(&spot(vec![ground(), light]), reflected(factor), what);
    }
}

/// The left half of an image of four columns is lit: each column is the filter's distribution function at the edge.
#[test]
fn filters() {
    let tent = |s: f64| if s < 0.0 { 0.5 * (1.0 + s).max(0.0).powi(2) } else { 1.0 - 0.5 * (1.0 - s).max(0.0).powi(2) };
    let camera = look_at(Vec3::Z, Vec3::ZERO, 90.0);
    let light = lit(quad(vec3(-10.0, 0.0, 0.0), Vec3::X * 10.0, Vec3::Y * 10.0), vec3(1.0, 2.0, 0.5));
    for (filter, width) in
        [(Filter::Box, 0.0), (Filter::Tent { radius: 1.0 }, 1.0), (Filter::Tent { radius: 1.5 }, 1.5)]
    {
        let scene = Description { size: [4, 1], filter, shapes: vec![light.clone()], ..description(camera, Some(1)) };
        let scene = prepared(&scene, PLAIN);
        for column in 0..4 {
            let edge = 1.5 - f64::from(column);
            let lit = if width > 0.0 { tent(edge / width) } else { f64::from(u8::from(edge > 0.0)) };
            let right = [lit, 2.0 * lit, 0.5 * lit];
            agree(plain_pixel(&scene, [column, 0], 256, BLOCK, 23), right, [0.0; 3], &format!("{filter:?} {column}"));
        }
    }
}

/// Ending paths by chance changes no mean: of a furnace without a limit of depth 1/(1 − albedo), and of scenes whose
/// paths have pairs; nor that of h.
#[test]
fn roulette() {
    let with = |name, depth, max_depth| Description { roulette_depth: Some(depth), max_depth, ..built(name) };
    for depth in [1, 2, 4] {
        let furnace = prepared(&with("S4c", depth, None), PLAIN);
        agree(plain_image(&furnace, 8, 24), [1.25, 2.0, 5.0], [0.0; 3], "furnace");
    }
    let limited = prepared(&with("S4c", 2, Some(5)), PLAIN);
    agree(plain_image(&limited, 8, 25), [1.2496, 1.9375, 3.3616], [0.0; 3], "furnace of depth 5");
    for (name, max_depth, mean) in
        [("S4e", None, [1.0; 3]), ("S4g", Some(2), [0.996_383_21, 0.965_560_04, 0.877_399_12])]
    {
        let scene = prepared(&with(name, 2, max_depth), RATIO);
        agree(plain_image(&scene, 8, 26), mean, [0.0; 3], name);
        means_of_h_in(&scene, 8, name);
    }
}

/// The middle of a triangle whose corners have normals of their own scatters by their mean, made a unit vector.
#[test]
fn interpolated_normals() {
    let positions = vec![vec3(-0.2, 0.0, 0.1), vec3(0.2, 0.0, 0.1), vec3(0.0, 0.0, -0.2)];
    let normals = [vec3(1.0, 1.0, 0.0), vec3(0.0, 1.0, 1.0), vec3(0.5, 1.0, 0.0)].map(Vec3::normalize);
    let mean = (normals[0] + normals[1] + normals[2]).normalize();
    let light = (vec3(2.0, 1.0, 0.5), vec3(5.0, 2.0, 1.0));
    let of = |normals: &[Vec3], flip_normals| {
        let mesh = Mesh { positions: positions.clone(), normals: normals.to_vec(), triangles: vec![[0, 1, 2]] };
        let triangle = Shape { flip_normals, ..shape(Geometry::Mesh(mesh), grey(REFLECTANCE as f32), true) };
        let lights = vec![Light::Point { position: light.0, intensity: light.1 }];
        Description { lights, ..spot(vec![triangle]) }
    };
    for flip in [false, true] {
        let flat = of_point(light.0, light.1, (DVec3::ZERO, DVec3::Y));
        is_seen(&of(&[], flip), flat, "flat");
        let smooth = of_point(light.0, light.1, (DVec3::ZERO, mean.as_dvec3()));
        assert!(smooth[0] > 1.2 * flat[0]);
        is_seen(&of(&normals, flip), smooth, "smooth");
    }
}
