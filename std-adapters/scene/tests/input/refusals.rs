//! Bad files: the line, and what the message says.

use super::{LIGHT, SENSOR, error, scene};
use ratiocv_scene::{Description, Leniency};

/// Bodies that begin on line 2, the line that is at fault, a part of the message, and whether a lenient reading
/// would leave the fault out.
const BODIES: &[(&str, usize, &str, bool)] = &[
    // What is not supported.
    (
        "\n<shape type='torus'/>",
        3,
        "<shape type=\"torus\">: not supported; supported are sphere, rectangle, cube, obj, ply",
        true,
    ),
    (
        "<shape type='sphere'>\n<bsdf type='plastic'/></shape>",
        3,
        "<shape type=\"sphere\">/<bsdf type=\"plastic\">: not supported; supported are diffuse, twosided, roughconductor, blendbsdf (of three conductors, one per channel), null",
        true,
    ),
    ("<bsdf type='plastic' id='unused'/>", 2, "not supported; supported are diffuse", true),
    ("<emitter type='envmap'/>", 2, "supported are point, constant, and area within a shape", true),
    ("<integrator type='ptracer'/>", 2, "supported are path, volpath, volpathmis", true),
    (
        "<shape type='sphere'>\n<float name='foo' value='1'/></shape>",
        3,
        "<float name=\"foo\">: unknown here; known are to_world, center, radius, emitter, medium, bsdf, flip_normals, visible_to_camera",
        true,
    ),
    (
        "<float name='foo' value='1'/>",
        2,
        "unknown here; known are bsdf, medium, emitter, shape, integrator, sensor",
        true,
    ),
    ("<include filename='other.xml'/>", 2, "<include>: unknown here", true),
    ("<sensor type='perspective'/>", 2, "a second <sensor>; one is supported", true),
    (
        "<shape type='sphere'><bsdf type='diffuse'><texture name='reflectance' type='bitmap'/></bsdf></shape>",
        2,
        "must be given by <rgb>, <float>",
        true,
    ),
    (
        "<shape type='sphere'><bsdf type='diffuse'><string name='reflectance' value='red'/></bsdf></shape>",
        2,
        "\"reflectance\" must be given by <rgb> or <float>",
        true,
    ),
    (
        "<shape type='sphere'><transform name='to_world'>\n<scale x='2'/></transform></shape>",
        2,
        "to_world of a sphere may scale uniformly",
        true,
    ),
    (
        "<shape type='sphere'><transform name='to_world'>\n<shear x='2'/></transform></shape>",
        3,
        "<shear>: not supported; supported are translate, scale, rotate, lookat, matrix",
        true,
    ),
    (
        "<shape type='cube'><transform name='to_world'><matrix value='1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1'/></transform></shape>",
        2,
        "the last row must be 0 0 0 1",
        true,
    ),
    // Media.
    (
        "<shape type='sphere'><medium name='interior' type='homogeneous'/></shape>",
        2,
        "bsdf must be <bsdf type=\"null\"/>",
        true,
    ),
    (
        "<shape type='rectangle'><bsdf type='null'/><medium name='interior' type='homogeneous'/></shape>",
        2,
        "supported are media in a sphere or a cube",
        true,
    ),
    (
        "<shape type='cube'><bsdf type='null'/>\n<medium name='exterior' type='homogeneous'/></shape>",
        3,
        "must be named \"interior\"",
        true,
    ),
    (
        "<shape type='cube'><bsdf type='null'/>\n<medium name='interior' type='heterogeneous'/></shape>",
        3,
        "supported are homogeneous",
        true,
    ),
    (
        "<shape type='cube'><bsdf type='null'/><medium name='interior' type='homogeneous'>\n<phase type='hg'/></medium></shape>",
        3,
        "<phase type=\"hg\">: not supported; supported are isotropic",
        true,
    ),
    (
        "<shape type='cube'><bsdf type='null'/><medium name='interior' type='homogeneous'>\n<rgb name='albedo' value='0.5 1.5 0.5'/></medium></shape>",
        3,
        "no channel may be above 1",
        false,
    ),
    (
        "<shape type='cube'><bsdf type='null'/><medium name='interior' type='homogeneous'>\n<rgb name='sigma_t' value='-1'/></medium></shape>",
        3,
        "no channel may be negative",
        false,
    ),
    (
        "<shape type='cube'><bsdf type='null'/><emitter type='area'/></shape>",
        2,
        "emits, so its bsdf must not be null",
        true,
    ),
    // Wrong values.
    (
        "<emitter type='point'>\n<rgb name='intensity' value='nan'/></emitter>",
        3,
        "\"nan\" must be a finite number",
        false,
    ),
    ("<emitter type='point'>\n<rgb name='intensity' value='1e39'/></emitter>", 3, "must be a finite number", false),
    (
        "<shape type='sphere'><emitter type='area'>\n<rgb name='radiance' value='1 -0.5 1'/></emitter></shape>",
        3,
        "no channel may be negative",
        false,
    ),
    (
        "<shape type='sphere'><bsdf type='diffuse'>\n<rgb name='reflectance' value='1.1'/></bsdf></shape>",
        3,
        "no channel may be above 1",
        false,
    ),
    (
        "<shape type='sphere'><bsdf type='diffuse'>\n<rgb name='reflectance' value='#808080'/></bsdf></shape>",
        3,
        "sRGB codes are not read",
        false,
    ),
    (
        "<shape type='sphere'><bsdf type='diffuse'>\n<rgb name='reflectance' value='0.1 0.2'/></bsdf></shape>",
        3,
        "must be one number or three",
        false,
    ),
    (
        "<shape type='sphere'><bsdf type='diffuse'>\n<rgb name='reflectance' r='0' g='0' b='0'/></bsdf></shape>",
        3,
        "unknown attribute \"r\"; known are name, value",
        false,
    ),
    ("<shape type='sphere'>\n<float name='radius' value='0'/></shape>", 3, "0 must be above 0", false),
    ("<shape type='sphere'>\n<float name='radius' value='1f'/></shape>", 3, "\"1f\" must be a finite number", false),
    ("<shape type='sphere'>\n<float name='radius'/></shape>", 3, "has no attribute value", false),
    (
        "<shape type='sphere'><float name='radius' value='1'/>\n<float name='radius' value='2'/></shape>",
        3,
        "a second \"radius\"",
        false,
    ),
    (
        "<shape type='sphere'>\n<boolean name='flip_normals' value='1'/></shape>",
        3,
        "\"1\" must be true or false",
        false,
    ),
    ("<shape type='sphere'>\n<point name='center' x='1' y='2'/></shape>", 3, "needs x, y and z", false),
    ("<shape/>", 2, "has no attribute type", false),
    ("<shape type='sphere' radius='2'/>", 2, "unknown attribute \"radius\"", false),
    (
        "<integrator type='path'>\n<integer name='max_depth' value='2.5'/></integrator>",
        3,
        "must be a whole number from -1",
        false,
    ),
    ("<integrator type='path'>\n<integer name='max_depth' value='0'/></integrator>", 2, "leaves a black image", false),
    (
        "<integrator type='path'>\n<integer name='rr_depth' value='0'/></integrator>",
        3,
        "must be a whole number from 1",
        false,
    ),
    ("<emitter type='constant'/>", 2, "a second constant emitter", false),
    ("<emitter type='area'/>", 2, "belongs into a <shape>", false),
    ("<shape type='sphere'>\n<emitter type='constant'/></shape>", 3, "belongs into <scene>", false),
    (
        "<emitter type='point'><point name='position' value='1'/><transform name='to_world'/></emitter>",
        2,
        "both position and to_world",
        false,
    ),
    // Transforms.
    (
        "<shape type='rectangle'><transform name='to_world'><scale x='0'/></transform></shape>",
        2,
        "to_world is singular",
        false,
    ),
    (
        "<shape type='rectangle'><transform name='to_world'><matrix value='1 2 0 2 4 0 0 0 1'/></transform></shape>",
        2,
        "to_world is singular",
        false,
    ),
    (
        "<shape type='cube'><transform name='to_world'><scale value='1e-20'/></transform></shape>",
        2,
        "to_world is singular",
        false,
    ),
    (
        "<shape type='cube'><transform name='to_world'>\n<matrix value='1 2 3'/></transform></shape>",
        3,
        "needs 9 or 16 numbers and has 3",
        false,
    ),
    (
        "<shape type='cube'><transform name='to_world'>\n<rotate x='1' y='1' angle='3'/></transform></shape>",
        3,
        "must have length 1",
        false,
    ),
    (
        "<shape type='cube'><transform name='to_world'>\n<rotate x='1'/></transform></shape>",
        3,
        "has no attribute angle",
        false,
    ),
    (
        "<shape type='cube'><transform name='to_world'>\n<lookat origin='1' target='1' up='0 1 0'/></transform></shape>",
        3,
        "the same point",
        false,
    ),
    (
        "<shape type='cube'><transform name='to_world'>\n<lookat origin='0' target='0 1 0' up='0 1 0'/></transform></shape>",
        3,
        "up must not be 0 or along",
        false,
    ),
    (
        "<shape type='cube'><transform name='to_world'>\n<translate value='1' x='1'/></transform></shape>",
        3,
        "both value and x, y, z",
        false,
    ),
    // Ids and references.
    (
        "<bsdf type='diffuse' id='a'/>\n<bsdf type='diffuse' id='a'/>",
        3,
        "the id \"a\" is that of line 2 already",
        false,
    ),
    ("<shape type='sphere'>\n<ref id='a'/></shape>", 3, "there is no element with the id \"a\"", false),
    (
        "<bsdf type='twosided' id='a'><ref id='b'/></bsdf>\n<bsdf type='twosided' id='b'><ref id='a'/></bsdf>",
        2,
        "references go in a circle: a -> b -> a",
        false,
    ),
    (
        "<bsdf type='diffuse' id='z'/>\n<bsdf type='twosided' id='a'><ref id='z'/><ref id='a'/></bsdf>",
        3,
        "references go in a circle: a -> a",
        false,
    ),
    ("<emitter type='point' id='e'/><shape type='sphere'>\n<ref id='e'/></shape>", 2, "belongs into <scene>", false),
    (
        "<shape type='sphere'>\n<float name='radius' value='$r'/></shape>\n<default name='r' value='1'/>",
        3,
        "nothing before this line defines $r",
        false,
    ),
    // Surfaces.
    ("<shape type='sphere'>\n<bsdf type='twosided'/></shape>", 3, "holds no <bsdf>", false),
    (
        "<shape type='sphere'><bsdf type='twosided'>\n<bsdf type='twosided'/></bsdf></shape>",
        3,
        "a twosided within a twosided",
        true,
    ),
    (
        "<shape type='sphere'><bsdf type='twosided'>\n<bsdf type='null'/></bsdf></shape>",
        3,
        "nothing to have two sides",
        false,
    ),
    ("<bsdf type='roughconductor'/>", 2, "distribution must be given, and be \"ggx\"", true),
    (
        "<bsdf type='roughconductor'><string name='distribution' value='ggx'/><string name='material' value='Au'/></bsdf>",
        2,
        "material must be \"none\"",
        true,
    ),
    (
        "<bsdf type='roughconductor'><string name='distribution' value='ggx'/>\n<rgb name='eta' value='1'/></bsdf>",
        3,
        "unknown here; known are distribution, material, sample_visible, alpha, specular_reflectance",
        true,
    ),
    (
        "<bsdf type='roughconductor'><string name='distribution' value='ggx'/><boolean name='sample_visible' value='false'/></bsdf>",
        2,
        "sample_visible must be true",
        true,
    ),
    (
        "<bsdf type='roughconductor'><string name='distribution' value='ggx'/>\n<float name='alpha' value='0'/></bsdf>",
        3,
        "0 must be from 0.0001 to 10",
        false,
    ),
    (
        "<bsdf type='blendbsdf'><bsdf type='diffuse'/><bsdf type='diffuse'/></bsdf>",
        2,
        "has no <float name=\"weight\"",
        false,
    ),
    (
        "<bsdf type='blendbsdf'><float name='weight' value='0.5'/><bsdf type='diffuse'/></bsdf>",
        2,
        "must hold two <bsdf>",
        false,
    ),
    (
        "<bsdf type='blendbsdf'><float name='weight' value='0.5'/><bsdf type='diffuse'/><bsdf type='diffuse'/></bsdf>",
        2,
        "must be one third each of three roughconductors",
        true,
    ),
];

#[test]
fn each_names_its_line_and_the_fault() {
    for (body, line, part, is_unsupported) in BODIES {
        let error = error(&scene(body));
        let text = error.to_string();
        assert_eq!(error.line(), Some(*line), "{text}\n{body}");
        assert!(text.starts_with(&format!("scene.xml, line {line}, column ")), "{text}");
        assert!(text.contains(part), "{text}\ninstead of: {part}");
        assert_eq!(error.is_unsupported(), *is_unsupported, "{text}\n{body}");
    }
}

#[test]
fn the_column_is_that_of_the_element() {
    let error = error(&scene("  <shape type='torus'/>"));
    assert_eq!((error.line(), error.column()), (Some(2), Some(3)));
}

/// Whole files.
#[test]
fn files_without_what_a_scene_needs() {
    let files = [
        ("", 1, "not well-formed XML"),
        ("<scene version='3.0.0'>\n", 1, "not well-formed XML"),
        ("<scene version='3.0.0'>\n</shape>", 2, "not well-formed XML"),
        ("<!DOCTYPE s [<!ENTITY a 'aaaa'>]>\n<scene version='3.0.0'>&a;</scene>", 1, "not well-formed XML"),
        ("<bsdf type='diffuse'/>", 1, "the outermost element must be <scene"),
        ("<scene/>", 1, "has no attribute version"),
        ("<scene version='0.6.0'/>", 1, "version 0.6.0 is not supported"),
        ("<scene version='3.0.0'/>", 1, "has no <sensor type=\"perspective\">"),
        ("<scene version='3.0.0'>\n<sensor type='thinlens'/></scene>", 2, "supported are perspective"),
        ("<scene version='3.0.0'>\n<sensor type='perspective'/></scene>", 2, "needs <float name=\"fov\" …>"),
    ];
    for (text, line, part) in files {
        let error = error(text);
        assert_eq!(error.line(), Some(line), "{error}");
        assert!(error.to_string().contains(part), "{error}\ninstead of: {part}");
    }
}

#[test]
fn a_scene_without_light_is_refused() {
    for light in ["", "<shape type='sphere'><emitter type='area'><rgb name='radiance' value='0'/></emitter></shape>"] {
        let error = error(&format!("\n<scene version='3.0.0'>{SENSOR}{light}</scene>"));
        assert!(error.to_string().contains("nothing emits light"), "{error}");
        assert_eq!(error.line(), Some(2));
    }
}

#[test]
fn nesting_is_bounded() {
    for depth in [33, 100_000] {
        let body = format!("{}{}", "<bsdf type='twosided'>".repeat(depth), "</bsdf>".repeat(depth));
        let error = error(&scene(&body));
        assert!(error.to_string().contains("nested more than 32 deep"), "{error}");
    }
}

/// Without a check for circles this would take 2³⁰ steps, or all of the stack.
#[test]
fn references_are_not_followed_without_end() {
    let mut body = String::new();
    for i in 0..30 {
        let next = i + 1;
        body += &format!(
            "<bsdf type='blendbsdf' id='b{i}'><float name='weight' value='0.5'/><ref id='b{next}'/><ref id='b{next}'/></bsdf>"
        );
    }
    body += "<bsdf type='diffuse' id='b30'/>";
    let error = error(&scene(&body));
    assert!(error.to_string().contains("one third each"), "{error}");
}

#[test]
fn a_file_that_is_not_there_or_not_text() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.xml");
    let text = Description::read(&path, Leniency::Lenient).unwrap_err().to_string();
    assert!(text.starts_with(&*path.to_string_lossy()) && text.contains("cannot be read"), "{text}");
    std::fs::write(&path, b"<scene version='3.0.0'>\n\xff</scene>").unwrap();
    let text = Description::read(&path, Leniency::Lenient).unwrap_err().to_string();
    assert!(text.contains("line 2 is not UTF-8"), "{text}");
    std::fs::write(&path, format!("<scene version='3.0.0'>{SENSOR}{LIGHT}</scene>")).unwrap();
    assert!(Description::read(&path, Leniency::Strict).is_ok());
}

#[test]
fn a_large_circle_is_found_at_once_and_told_in_short() {
    let link = |i: usize| format!("<bsdf type='twosided' id='b{i}'><ref id='b{}'/></bsdf>", (i + 1) % 100_000);
    let error = error(&scene(&(0..100_000).map(link).collect::<String>()));
    assert!(error.to_string().contains("b3 -> … -> b99997"), "{error}");
}
