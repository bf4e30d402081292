//! Lenient readings: what is left out, and what is said of it.

use super::{error, scene};
use glam::Vec3;
use ratiocv_scene::{Description, Leniency, Material, Warning};

fn lenient(body: &str) -> (Description, Vec<Warning>) {
    Description::parse(&scene(body), "scene.xml", Leniency::Lenient).unwrap_or_else(|error| panic!("{error}\n{body}"))
}

#[test]
fn each_warning_says_what_was_done_instead() {
    let cases = [
        ("<shape type='torus'/>", "left out", 0),
        ("<shape type='sphere'><bsdf type='plastic'/></shape>", "grey of reflectance 0.5 instead", 1),
        ("<shape type='sphere'><float name='foo' value='1'/></shape>", "left out", 1),
        ("<shape type='sphere'><emitter type='spot'/></shape>", "left out", 1),
        ("<shape type='sphere'><medium name='interior' type='heterogeneous'/></shape>", "left out", 0),
        ("<emitter type='envmap'/>", "left out", 0),
        ("<integrator type='ptracer'/>", "left out; paths have any length", 0),
        ("<sensor type='thinlens'/>", "left out", 0),
        ("<foo/>", "left out", 0),
    ];
    for (body, instead, shapes) in cases {
        let (scene, warnings) = lenient(body);
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        let text = warnings[0].to_string();
        assert!(text.starts_with("scene.xml, line 2, column ") && text.ends_with(&format!(": {instead}")), "{text}");
        assert_eq!(warnings[0].instead(), instead);
        assert!(warnings[0].error().is_unsupported());
        assert_eq!(scene.shapes.len(), shapes, "{body}");
        assert_eq!(error(&super::scene(body)), *warnings[0].error());
    }
}

#[test]
fn a_surface_that_is_shared_is_warned_of_once_and_grey() {
    let (scene, warnings) = lenient(
        "<bsdf type='plastic' id='a'/><shape type='sphere'><ref id='a'/></shape><shape type='cube'><ref id='a'/></shape>",
    );
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    for shape in &scene.shapes {
        assert_eq!(shape.surface.material, Material::Diffuse { reflectance: Vec3::splat(0.5) });
    }
}

#[test]
fn wrong_values_are_errors_all_the_same() {
    for body in
        ["<shape type='sphere'><float name='radius' value='-1'/></shape>", "<shape type='sphere'><ref id='a'/></shape>"]
    {
        let text = scene(body);
        assert_eq!(Description::parse(&text, "scene.xml", Leniency::Lenient).unwrap_err(), error(&text));
    }
}

#[test]
fn a_filter_that_is_not_there_is_a_box_with_a_warning_in_any_reading() {
    for film in ["", "<film type='hdrfilm'/>"] {
        let text = format!(
            "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='40'/>{film}</sensor><emitter type='constant'/></scene>"
        );
        let (scene, warnings) = Description::parse(&text, "scene.xml", Leniency::Strict).unwrap();
        assert_eq!((scene.size, scene.filter), ([768, 576], ratiocv_scene::Filter::Box));
        assert!(
            warnings.len() == 1 && warnings[0].to_string().contains("instead of Mitsuba's Gaussian"),
            "{warnings:?}"
        );
    }
}
