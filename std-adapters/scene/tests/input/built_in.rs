//! Every built-in scene, against numbers written down from its specification.

use glam::Vec3;
use ratiocv_scene::{BuiltIn, Description, Filter, Geometry, Light, Material, Medium, Roughness, Shape};

fn v(x: f32, y: f32, z: f32) -> Vec3 {
    Vec3::new(x, y, z)
}

/// Reads `name` and checks its camera by rays: those of the centre and of the right edge, halfway up.
fn read(name: &str, eye: Vec3, target: Vec3, fov: f32, max_depth: Option<u32>) -> Description {
    let scene = Description::built_in(name).unwrap();
    assert_eq!(scene.size, [128, 128]);
    assert_eq!((scene.filter, scene.samples), (Filter::Box, 64));
    assert_eq!((scene.max_depth, scene.roulette_depth), (max_depth, None));
    assert_eq!(scene.camera.fov, fov);
    let to_world = scene.camera.to_world;
    assert_eq!(to_world.transform_point3(Vec3::ZERO), eye);
    let ahead = (target - eye).normalize();
    assert!(to_world.transform_vector3(Vec3::Z).distance(ahead) <= 1e-6, "{name}");
    let right = ahead.cross(Vec3::Y).normalize();
    assert!(to_world.transform_vector3(Vec3::NEG_X).distance(right) <= 1e-6, "{name}");
    assert!(to_world.transform_vector3(Vec3::Y).distance(right.cross(ahead)) <= 1e-6, "{name}");
    scene
}

fn sphere(shape: &Shape) -> (Vec3, f32) {
    let Geometry::Sphere { center, radius } = shape.geometry else { panic!("{shape:?}") };
    (center, radius)
}

fn diffuse(shape: &Shape) -> Vec3 {
    let Material::Diffuse { reflectance } = shape.surface.material else { panic!("{shape:?}") };
    reflectance
}

/// The corner of least x, y, z and its opposite, and the normal, of a rectangle along the axes.
fn rectangle(shape: &Shape) -> (Vec3, Vec3, Vec3) {
    let Geometry::Rectangle(to_world) = shape.geometry else { panic!("{shape:?}") };
    let [a, b] = [v(-1.0, -1.0, 0.0), v(1.0, 1.0, 0.0)].map(|corner| to_world.transform_point3(corner));
    (a.min(b), a.max(b), to_world.transform_vector3(Vec3::Z).normalize())
}

fn is_plain(shape: &Shape, two_sided: bool) {
    assert!(shape.visible_to_camera && !shape.flip_normals && shape.medium.is_none());
    assert_eq!(shape.surface.two_sided, two_sided);
}

fn check_floor(shape: &Shape, y: f32) {
    is_plain(shape, true);
    assert_eq!(rectangle(shape), (v(-20.0, y, -20.0), v(20.0, y, 20.0), Vec3::Y));
    assert_eq!((diffuse(shape), shape.emission), (Vec3::splat(0.5), None));
}

fn check_light(shape: &Shape, center: Vec3, radius: f32, radiance: Vec3) {
    assert_eq!(sphere(shape), (center, radius));
    assert_eq!((diffuse(shape), shape.emission), (Vec3::ZERO, Some(radiance)));
    assert!(!shape.flip_normals && shape.medium.is_none() && !shape.surface.two_sided);
}

fn read_s1(name: &str) -> Description {
    read(name, v(0.0, 5.0, 6.0), v(0.0, 0.6, 0.0), 36.0, Some(2))
}

#[test]
fn s1_s1b_and_s4f() {
    let small = [v(3000.0, 5.0, 6.0), v(3.0, 3000.0, 4.0), v(4.8, 5.8, 3000.0)];
    let large = [v(120.0, 0.2, 0.24), v(0.12, 120.0, 0.16), v(0.192, 0.232, 120.0)];
    for (name, radius, radiances, has_ball) in
        [("S1", 0.1, small, true), ("S1b", 0.5, large, true), ("S4f", 0.1, small, false)]
    {
        let mut shapes = read_s1(name).shapes;
        check_floor(&shapes.remove(0), 0.0);
        if has_ball {
            let ball = shapes.remove(0);
            is_plain(&ball, false);
            assert_eq!((sphere(&ball), diffuse(&ball), ball.emission), ((Vec3::Y, 1.0), Vec3::splat(0.7), None));
        }
        assert_eq!(shapes.len(), 3);
        let centers = [v(-3.0, 4.0, 2.0), v(3.0, 4.0, 2.0), v(0.0, 5.0, -3.0)];
        for ((light, center), radiance) in shapes.iter().zip(centers).zip(radiances) {
            check_light(light, center, radius, radiance);
            assert!(light.visible_to_camera);
        }
    }
}

#[test]
fn s1k() {
    let scene = read_s1("S1k");
    assert_eq!(scene.shapes.len(), 26);
    check_floor(&scene.shapes[0], 0.0);
    assert_eq!(sphere(&scene.shapes[1]), (Vec3::Y, 1.0));
    for (i, light) in scene.shapes[2..].iter().enumerate() {
        let turn = core::f64::consts::TAU;
        let (i, w, q) = (i as f64, turn * i as f64 / 24.0, 3.0 + 2.0 * (i % 2) as f64);
        let center = v((q * libm::cos(w)) as f32, (3.0 + i % 3.0) as f32, (q * libm::sin(w)) as f32);
        let radiance = [0.0, 1.0, 2.0].map(|j| {
            let lobe = libm::cos(turn * (0.381966 * i - j / 3.0)).max(0.0);
            (500.0 * (0.02 + lobe * lobe)) as f32
        });
        let (at, radius) = sphere(light);
        assert!(at.distance(center) <= 1e-6 && radius == 0.1, "{i}: {at}");
        let emission = light.emission.unwrap();
        let error = (emission - Vec3::from(radiance)).abs().max_element();
        assert!(error <= 1e-4, "{i}: {emission} instead of {radiance:?}");
        assert!(!light.visible_to_camera);
        check_light(light, at, 0.1, emission);
    }
}

#[test]
fn s2_and_s2w() {
    for (name, half, radiance) in [("S2", 0.25, v(17.0, 12.0, 4.0)), ("S2w", 0.9, v(1.3, 0.93, 0.31))] {
        let scene = read(name, v(0.0, 0.1, 3.9), v(0.0, -0.45, 0.0), 30.0, Some(4));
        let (white, red, green) = (Vec3::splat(0.73), v(0.63, 0.065, 0.05), v(0.14, 0.45, 0.091));
        let walls = [
            (v(-1.0, -1.0, -1.0), v(1.0, -1.0, 1.5), Vec3::Y, white),
            (v(-1.0, 1.0, -1.0), v(1.0, 1.0, 1.5), Vec3::NEG_Y, white),
            (v(-1.0, -1.0, -1.0), v(-1.0, 1.0, 1.5), Vec3::X, red),
            (v(1.0, -1.0, -1.0), v(1.0, 1.0, 1.5), Vec3::NEG_X, green),
            (v(-1.0, -1.0, -1.0), v(1.0, 1.0, -1.0), Vec3::Z, white),
        ];
        assert_eq!(scene.shapes.len(), 8);
        for (wall, (least, most, normal, color)) in scene.shapes.iter().zip(walls) {
            is_plain(wall, true);
            assert_eq!(rectangle(wall), (least, most, normal));
            assert_eq!((diffuse(wall), wall.emission), (color, None));
        }
        let light = &scene.shapes[5];
        is_plain(light, false);
        assert_eq!(rectangle(light), (v(-half, 0.99, -half), v(half, 0.99, half), Vec3::NEG_Y));
        assert_eq!((diffuse(light), light.emission), (Vec3::ZERO, Some(radiance)));
        let balls =
            [(v(-0.42, -0.55, -0.25), 0.45, v(0.05, 0.20, 0.50)), (v(0.50, -0.60, 0.45), 0.40, v(0.40, 0.15, 0.05))];
        for (ball, (center, radius, alpha)) in scene.shapes[6..].iter().zip(balls) {
            is_plain(ball, false);
            assert_eq!(sphere(ball), (center, radius));
            let roughness = Roughness::Chromatic(alpha);
            assert_eq!(ball.surface.material, Material::Conductor { roughness, reflectance: Vec3::splat(0.9) });
        }
    }
}

#[test]
fn s3_and_s3m() {
    for (name, depth) in [("S3", 2), ("S3m", 6)] {
        let scene = read(name, v(0.0, 2.5, 5.0), v(0.0, -0.3, 0.0), 36.0, Some(depth));
        assert_eq!(scene.shapes.len(), 3);
        check_floor(&scene.shapes[0], -1.5);
        let fog = &scene.shapes[1];
        let Geometry::Cube(to_world) = fog.geometry else { panic!("{fog:?}") };
        assert_eq!(to_world, glam::Affine3A::IDENTITY);
        assert_eq!(fog.surface.material, Material::Null);
        assert_eq!(fog.medium, Some(Medium { extinction: v(0.2, 1.0, 5.0), albedo: Vec3::splat(0.9) }));
        check_light(&scene.shapes[2], v(1.5, 3.0, 2.0), 0.5, Vec3::splat(40.0));
    }
}

fn read_s4(name: &str, max_depth: Option<u32>) -> (Shape, Vec<Light>) {
    let mut scene = read(name, v(0.0, 0.0, 4.0), Vec3::ZERO, 40.0, max_depth);
    assert_eq!(scene.shapes.len(), 1);
    (scene.shapes.remove(0), scene.lights)
}

#[test]
fn s4a_to_s4g() {
    let white = [Light::Environment(Vec3::ONE)];
    let (ball, lights) = read_s4("S4a", Some(2));
    assert_eq!((sphere(&ball), diffuse(&ball), &lights[..]), ((Vec3::ZERO, 1.0), Vec3::ONE, &white[..]));
    let (ball, lights) = read_s4("S4b", Some(2));
    assert_eq!((sphere(&ball), diffuse(&ball)), ((Vec3::ZERO, 1.0), v(0.2, 0.5, 0.8)));
    assert_eq!(lights, [Light::Environment(v(1.0, 0.5, 2.0))]);
    let (hall, lights) = read_s4("S4c", Some(5));
    assert_eq!((sphere(&hall), diffuse(&hall)), ((Vec3::ZERO, 10.0), v(0.2, 0.5, 0.8)));
    assert!(hall.flip_normals && hall.emission == Some(Vec3::ONE) && lights.is_empty());
    for (name, depth, albedo) in [("S4d", Some(2), Vec3::ZERO), ("S4e", None, Vec3::ONE)] {
        let (ball, lights) = read_s4(name, depth);
        assert_eq!((sphere(&ball), ball.surface.material), ((Vec3::ZERO, 1.0), Material::Null));
        assert_eq!(ball.medium, Some(Medium { extinction: v(0.2, 1.0, 5.0), albedo }));
        assert_eq!(lights, white);
    }
    let (ball, lights) = read_s4("S4g", Some(2));
    let roughness = Roughness::Chromatic(v(0.05, 0.2, 0.5));
    assert_eq!(ball.surface.material, Material::Conductor { roughness, reflectance: Vec3::ONE });
    assert_eq!((sphere(&ball), &lights[..]), ((Vec3::ZERO, 1.0), &white[..]));
}

#[test]
fn the_list_names_each_scene_once() {
    let names: Vec<&str> = BuiltIn::ALL.iter().map(|scene| scene.name).collect();
    let all = ["S1", "S1b", "S1k", "S2", "S2w", "S3", "S3m", "S4a", "S4b", "S4c", "S4d", "S4e", "S4f", "S4g"];
    assert_eq!(names, all);
    assert_eq!(BuiltIn::named("s4G"), BuiltIn::ALL.last());
    assert!(BuiltIn::named("S4").is_none());
}
