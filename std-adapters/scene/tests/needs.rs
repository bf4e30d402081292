//! What each scene needs.

mod support;

use ratiocv_core::Spectrum;
use ratiocv_scene::{LightChoice, Needs, Options, Scene, SceneError};
use support::built;

#[test]
fn needs_of_each_scene() {
    // channels, auxiliary, coloured lights, conductors, media; light sampling, scattering.
    let right = [
        ("S1", 3, [true, true, false, false], [true, false]),
        ("S1b", 3, [true, true, false, false], [true, false]),
        ("S1k", 3, [true, true, false, false], [true, false]),
        ("S2", 3, [true, false, true, false], [true, true]),
        ("S2w", 3, [true, false, true, false], [true, true]),
        ("S3", 3, [true, false, false, true], [true, false]),
        ("S3m", 3, [true, false, false, true], [true, false]),
        ("S4a", 1, [false; 4], [false, true]),
        ("S4b", 3, [false; 4], [false, true]),
        ("S4c", 3, [false; 4], [true, false]),
        ("S4d", 3, [false; 4], [false, true]),
        ("S4e", 3, [true, false, false, true], [false, true]),
        ("S4f", 3, [true, true, false, false], [true, false]),
        ("S4g", 3, [true, false, true, false], [false, true]),
    ];
    for (name, channels, auxiliaries, techniques) in right {
        let needs = Needs::of(&built(name), &Options::default());
        let ours = [needs.auxiliary, needs.coloured_lights, needs.coloured_conductors, needs.coloured_media];
        assert_eq!((needs.channels, ours), (channels, auxiliaries), "{name}");
        assert_eq!([needs.light_sampling, needs.scattering], techniques, "{name}");
        let plain = Needs::of(&built(name), &Options { auxiliary: false, ..Options::default() });
        assert!(!plain.auxiliary);
        let uniform = Needs::of(&built(name), &Options { choice: LightChoice::Uniform, ..Options::default() });
        assert!(!uniform.coloured_lights);
    }
}

#[test]
fn terms_of_each_scene() {
    let terms = |name| {
        let scene = Scene::<Spectrum<f32, 3>>::new(&built(name), &Options::default()).expect("a sound scene");
        scene.terms().iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(terms("S1"), ["light, depth 2"]);
    assert_eq!(terms("S3"), ["scattering, depth 1", "light, depth 2"]);
    assert_eq!(terms("S4g"), ["scattering, depth 2"]);
    let s2 = ["scattering, depth 2", "light, depth 3", "scattering, depth 3", "light, depth 4", "scattering, depth 4"];
    assert_eq!(terms("S2"), s2);
    assert_eq!(terms("S4e").last().map(String::as_str), Some("scattering, depth 8 and deeper"));
    assert!(terms("S4a").is_empty());
}

#[test]
fn explanations_say_why() {
    let needs = Needs::of(&built("S1"), &Options::default());
    let text = needs.to_string();
    for part in ["media: none", "conductors: all surfaces are diffuse", "no triangles", "products along paths"] {
        assert!(text.contains(part), "{text}");
    }
    assert!(!text.contains("\n  choice of lights"));
    assert!(Needs::of(&built("S4a"), &Options::default()).to_string().contains("one is rendered"));
}

#[test]
fn what_cannot_be_rendered_is_named() {
    use glam::{Affine3A, Vec3};
    use ratiocv_scene::{Description, Filter, Geometry, Light, Material, Medium, Mesh};
    type Spoil = fn(&mut Description);
    let spoils: [(Spoil, SceneError); 15] = [
        (|s| s.camera.fov = 180.0, SceneError::FieldOfView),
        (|s| s.camera.fov = f32::NAN, SceneError::FieldOfView),
        (|s| s.camera.to_world = Affine3A::ZERO, SceneError::Camera),
        (|s| s.size = [0, 5], SceneError::Size),
        (|s| s.filter = Filter::Tent { radius: f32::NAN }, SceneError::Filter),
        (|s| s.max_depth = Some(0), SceneError::Depth),
        (|s| s.shapes.truncate(2), SceneError::NoLight),
        (|s| s.shapes[0].geometry = Geometry::Rectangle(Affine3A::from_scale(Vec3::X)), SceneError::Shape(0)),
        (|s| s.shapes[1].geometry = Geometry::Sphere { center: Vec3::NAN, radius: 1.0 }, SceneError::Shape(1)),
        (|s| s.shapes[2].emission = Some(-Vec3::ONE), SceneError::Value(2)),
        (|s| s.shapes[0].surface.material = Material::Diffuse { reflectance: Vec3::NAN }, SceneError::Value(0)),
        (|s| s.shapes[1].medium = Some(Medium { extinction: Vec3::ONE, albedo: Vec3::ONE }), SceneError::Medium(1)),
        (|s| s.shapes[2].surface.material = Material::Null, SceneError::NullLight(2)),
        (|s| s.lights.push(Light::Environment(Vec3::NAN)), SceneError::Light(0)),
        (
            |s| {
                let positions = vec![Vec3::X, Vec3::Y, Vec3::Z];
                let mesh = Mesh { positions, normals: Vec::new(), triangles: vec![[0, 1, 3]] };
                s.shapes[0].geometry = Geometry::Mesh(mesh);
            },
            SceneError::Mesh(0),
        ),
    ];
    for (spoil, right) in spoils {
        let mut scene = built("S1");
        spoil(&mut scene);
        let error = Scene::<Spectrum<f32, 3>>::new(&scene, &Options::default()).expect_err("an error");
        assert_eq!(error, right);
        assert!(error.to_string().len() > 10);
    }
    assert_eq!(Scene::<f32>::new(&built("S1"), &Options::default()).expect_err("channels"), SceneError::Channels);
}
