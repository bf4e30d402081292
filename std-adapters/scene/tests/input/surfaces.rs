//! Materials, and shapes made of them.

use super::{error, read, scene};
use glam::Vec3;
use ratiocv_scene::{Material, Roughness, Shape, Surface};

fn shape(inner: &str) -> Shape {
    read(&scene(&format!("<shape type='sphere'>{inner}</shape>"))).shapes.remove(0)
}

fn surface(bsdf: &str) -> Surface {
    shape(bsdf).surface
}

fn grey(reflectance: f32) -> Material {
    Material::Diffuse { reflectance: Vec3::splat(reflectance) }
}

/// One lobe of a chromatic conductor, with a colour as Mitsuba takes it.
fn lobe(alpha: f32, color: &str) -> String {
    format!(
        "<bsdf type='roughconductor'><string name='distribution' value='ggx'/><float name='alpha' value='{alpha}'/>\
         <texture type='srgb' name='specular_reflectance'><rgb name='color' value='{color}'/><boolean name='unbounded' value='true'/></texture></bsdf>"
    )
}

fn blend(weight: f64, first: &str, second: &str) -> String {
    format!("<bsdf type='blendbsdf'><float name='weight' value='{weight}'/>{first}{second}</bsdf>")
}

#[test]
fn colors_in_all_their_forms() {
    let diffuse = |color: &str| surface(&format!("<bsdf type='diffuse'>{color}</bsdf>")).material;
    let color = Material::Diffuse { reflectance: Vec3::new(0.1, 0.2, 0.3) };
    for text in ["0.1 0.2 0.3", "0.1, 0.2,0.3", " 0.1,0.2 , 0.3 "] {
        assert_eq!(diffuse(&format!("<rgb name='reflectance' value='{text}'/>")), color);
    }
    assert_eq!(diffuse("<rgb name='reflectance' value='0.25'/>"), grey(0.25));
    assert_eq!(diffuse("<float name='reflectance' value='0.25'/>"), grey(0.25));
    assert_eq!(
        diffuse("<spectrum type='srgb' name='reflectance'><rgb name='color' value='0.25'/></spectrum>"),
        grey(0.25)
    );
    assert_eq!(diffuse(""), grey(0.5));
}

/// As in Mitsuba 3.9.1.
#[test]
fn shapes_without_a_bsdf_are_grey_or_black() {
    assert_eq!(surface("").material, grey(0.5));
    let light = shape("<emitter type='area'/>");
    assert_eq!((light.surface.material, light.emission), (grey(0.0), Some(Vec3::ONE)));
}

#[test]
fn two_sides() {
    assert!(!surface("<bsdf type='diffuse'/>").two_sided);
    let both = surface("<bsdf type='twosided'><bsdf type='diffuse'/></bsdf>");
    assert!(both.two_sided && both.material == grey(0.5));
}

#[test]
fn a_conductor_of_one_roughness() {
    let text = "<bsdf type='roughconductor'><string name='distribution' value='ggx'/><string name='material' value='none'/>\
                <float name='alpha' value='0.25'/><rgb name='specular_reflectance' value='0.5 1 0.75'/></bsdf>";
    let reflectance = Vec3::new(0.5, 1.0, 0.75);
    assert_eq!(surface(text).material, Material::Conductor { roughness: Roughness::Grey(0.25), reflectance });
    let text = "<bsdf type='roughconductor'><string name='distribution' value='ggx'/></bsdf>";
    let default = Material::Conductor { roughness: Roughness::Grey(0.1), reflectance: Vec3::ONE };
    assert_eq!(surface(text).material, default);
}

#[test]
fn a_conductor_rough_by_channel_in_any_nesting() {
    let [r, g, b] = [lobe(0.125, "2.4 0 0"), lobe(0.25, "0 1.5 0"), lobe(0.5, "0 0 3")];
    let third = 1.0 / 3.0;
    let right = Material::Conductor {
        roughness: Roughness::Chromatic(Vec3::new(0.125, 0.25, 0.5)),
        reflectance: Vec3::new(0.8, 0.5, 1.0),
    };
    // The weight is that of the second.
    for text in [
        blend(2.0 * third, &r, &blend(0.5, &g, &b)),
        blend(third, &blend(0.5, &b, &r), &g),
        blend(0.666667, &b, &blend(0.5, &g, &r)),
    ] {
        let (one, both) = (surface(&text), surface(&format!("<bsdf type='twosided'>{text}</bsdf>")));
        assert_eq!((one.material, one.two_sided, both.material, both.two_sided), (right, false, right, true));
    }
    // Beyond Mitsuba: the colour as <rgb>.
    let plain = "<bsdf type='roughconductor'><string name='distribution' value='ggx'/><float name='alpha' value='0.125'/>\
                 <rgb name='specular_reflectance' value='2.4 0 0'/></bsdf>";
    assert_eq!(surface(&blend(2.0 * third, plain, &blend(0.5, &g, &b))).material, right);
}

#[test]
fn other_blends_are_refused() {
    let [r, g, b] = [lobe(0.125, "2.4 0 0"), lobe(0.25, "0 1.5 0"), lobe(0.5, "0 0 3")];
    let third = 1.0 / 3.0;
    let cases = [
        (blend(third, &r, &blend(0.5, &g, &b)), "one third each"),
        (blend(2.0 * third, &r, &blend(0.51, &g, &b)), "one third each"),
        (blend(0.5, &r, &g), "one third each"),
        (blend(0.5, &blend(0.5, &r, &g), &blend(0.5, &b, &r)), "one third each"),
        (blend(2.0 * third, &r, &blend(0.5, &g, &blend(0.5, &b, &b))), "one third each"),
        (blend(2.0 * third, &r, &blend(0.5, &g, "<bsdf type='diffuse'/>")), "one third each"),
        (blend(2.0 * third, &r, &blend(0.5, &g, &g)), "a second conductor for the same channel"),
        (blend(2.0 * third, &r, &blend(0.5, &g, &lobe(0.5, "0 1 2"))), "above 0 in one channel"),
        (blend(2.0 * third, &r, &blend(0.5, &g, &lobe(0.5, "0"))), "above 0 in one channel"),
        (blend(2.0 * third, &r, &blend(0.5, &g, &lobe(0.5, "0 0 3.1"))), "no channel may be above 3"),
    ];
    for (text, part) in cases {
        let error = error(&scene(&text));
        assert!(error.to_string().contains(part), "{error}\ninstead of: {part}");
    }
}

#[test]
fn null_shapes_without_a_medium_are_nothing() {
    assert!(read(&scene("<shape type='sphere'><bsdf type='null'/></shape>")).shapes.is_empty());
}

#[test]
fn shapes_can_be_hidden_from_the_camera() {
    assert!(shape("").visible_to_camera);
    assert!(!shape("<boolean name='visible_to_camera' value='false'/>").visible_to_camera);
}
