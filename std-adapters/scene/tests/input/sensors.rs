//! Cameras, films, samplers, integrators.

use super::{LIGHT, error, read};
use ratiocv_scene::{Description, Filter};

fn with(integrator: &str, sensor: &str, film: &str) -> String {
    format!(
        "<scene version='3.0.0'>{integrator}<sensor type='perspective'>{sensor}<film type='hdrfilm'>{film}</film></sensor>{LIGHT}</scene>"
    )
}

fn film(sensor: &str, film: &str) -> Description {
    read(&with("", &format!("<float name='fov' value='40'/>{sensor}"), film))
}

/// The values are Mitsuba 3.9.1's `x_fov`.
#[test]
fn fov_along_any_axis() {
    let cases = [
        ("x", 40.0, 40.0),
        ("y", 72.104775, 20.62821),
        ("smaller", 72.104775, 40.0),
        ("larger", 40.0, 20.62821),
        ("diagonal", 36.06479, 18.490187),
    ];
    for (axis, wide, high) in cases {
        for (width, height, right) in [(200, 100, wide), (100, 200, high)] {
            let size = format!(
                "<integer name='width' value='{width}'/><integer name='height' value='{height}'/><rfilter type='box'/>"
            );
            let fov = film(&format!("<string name='fov_axis' value='{axis}'/>"), &size).camera.fov;
            assert!((fov - right).abs() <= 1e-5, "{axis} {width}: {fov} instead of {right}");
        }
    }
}

#[test]
fn bad_sensors() {
    let cases = [
        ("<float name='fov' value='0'/>", "", "0 must be above 0 and below 180"),
        ("<float name='fov' value='180'/>", "", "180 must be above 0 and below 180"),
        ("<float name='fov' value='40'/><string name='fov_axis' value='z'/>", "", "fov_axis \"z\" is unknown"),
        ("<float name='fov' value='40'/>", "<integer name='width' value='0'/>", "must be a whole number from 1"),
        (
            "<float name='fov' value='40'/>",
            "<integer name='width' value='8193'/><integer name='height' value='8192'/>",
            "8193 × 8192 pixels are too many",
        ),
        (
            "<float name='fov' value='40'/>",
            "<integer name='width' value='9999999999'/>",
            "must be a whole number from 1",
        ),
        (
            "<float name='fov' value='40'/><float name='near_clip' value='1'/>",
            "",
            "<float name=\"near_clip\">: unknown here; known are film, sampler, to_world, fov_axis, fov",
        ),
        ("<float name='fov' value='40'/>", "<rfilter type='gaussian'/>", "supported are box, tent"),
        (
            "<float name='fov' value='40'/>",
            "<rfilter type='box'><float name='radius' value='1'/></rfilter>",
            "unknown here, where nothing is read",
        ),
        (
            "<float name='fov' value='40'/><transform name='to_world'><scale value='2'/></transform>",
            "",
            "must not scale or shear",
        ),
        (
            "<float name='fov' value='40'/><sampler type='independent'><integer name='sample_count' value='0'/></sampler>",
            "",
            "must be a whole number from 1",
        ),
    ];
    for (sensor, film, part) in cases {
        let error = error(&with("", sensor, film));
        assert!(error.to_string().contains(part), "{error}\ninstead of: {part}");
    }
    let largest = "<integer name='width' value='8192'/><integer name='height' value='8192'/><rfilter type='box'/>";
    assert_eq!(film("", largest).size, [8192, 8192]);
}

#[test]
fn films_filters_and_samplers() {
    let scene = film("", "<rfilter type='tent'/><string name='pixel_format' value='rgb'/>");
    assert_eq!((scene.filter, scene.samples, scene.size), (Filter::Tent { radius: 1.0 }, 4, [768, 576]));
    let scene = film(
        "<sampler type='multijitter'><integer name='sample_count' value='9'/><integer name='seed' value='1'/></sampler>",
        "<rfilter type='tent'><float name='radius' value='1.5'/></rfilter>",
    );
    assert_eq!((scene.filter, scene.samples), (Filter::Tent { radius: 1.5 }, 9));
}

#[test]
fn depths_and_roulette() {
    let depths = |integrator: &str| {
        let scene = read(&with(integrator, "<float name='fov' value='40'/>", "<rfilter type='box'/>"));
        (scene.max_depth, scene.roulette_depth)
    };
    assert_eq!(depths(""), (None, None));
    assert_eq!(depths("<integrator type='path'/>"), (None, None));
    let with = |kind: &str, longest: i32, roulette: i32| {
        depths(&format!(
            "<integrator type='{kind}'><integer name='max_depth' value='{longest}'/><integer name='rr_depth' value='{roulette}'/></integrator>"
        ))
    };
    assert_eq!(with("volpath", -1, 3), (None, Some(3)));
    assert_eq!(with("volpathmis", 4, 3), (Some(4), Some(3)));
    assert_eq!(with("path", 4, 4), (Some(4), None));
}
