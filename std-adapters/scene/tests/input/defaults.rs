//! `<default>` and `$name`, ids and references.

use super::{error, read, scene};
use glam::Vec3;
use ratiocv_scene::{Geometry, Material};

fn sphere(body: &str) -> (Vec3, f32) {
    let Geometry::Sphere { center, radius } = read(&scene(body)).shapes[0].geometry else { panic!("{body}") };
    (center, radius)
}

/// Mitsuba 3.9.1 gives the same on each.
#[test]
fn names_are_replaced_in_any_attribute_after_them() {
    let with = |defaults: &str, value: &str| {
        sphere(&format!("{defaults}<shape type='sphere'><float name='radius' value='{value}'/></shape>")).1
    };
    let a = "<default name='a' value='0.25'/>";
    assert_eq!(with(a, "$a"), 0.25);
    assert_eq!(with(a, "1$a"), 10.25);
    assert_eq!(with(&format!("{a}<default name='ab' value='0.75'/>"), "$ab"), 0.75);
    assert_eq!(with(&format!("{a}<default name='a' value='0.5'/>"), "$a"), 0.25);
    assert_eq!(with(&format!("{a}<default name='b' value='$a'/>"), "$b"), 0.25);
    let center = sphere(&format!("{a}<shape type='sphere'><point name='center' value='$a, 1$a, 0'/></shape>")).0;
    assert_eq!(center, Vec3::new(0.25, 10.25, 0.0));
    assert_eq!(sphere("<default name='kind' value='sphere'/><shape type='$kind'/>"), (Vec3::ZERO, 1.0));
}

/// A name ends where a letter does, however many bytes that has.
#[test]
fn names_may_be_followed_by_any_letters() {
    let sphere = "<shape type='sphere'><float name='radius' value='$aéß'/></shape>";
    let error = error(&scene(&format!("<default name='a' value='0.25'/>{sphere}"))).to_string();
    assert!(error.contains("0.25éß"), "{error}");
}

#[test]
fn references_may_come_before_what_they_refer_to() {
    let surface = "<bsdf type='diffuse' id='a'><rgb name='reflectance' value='0.125'/></bsdf>";
    let shape = "<shape type='sphere'><ref id='a'/></shape>";
    for body in [format!("{surface}{shape}"), format!("{shape}{surface}")] {
        let material = read(&scene(&body)).shapes[0].surface.material;
        assert_eq!(material, Material::Diffuse { reflectance: Vec3::splat(0.125) });
    }
}

#[test]
fn a_medium_is_interior_by_the_name_of_its_reference() {
    let medium = "<medium type='homogeneous' id='fog'><rgb name='sigma_t' value='0.5 1 0.25'/><float name='scale' value='2'/></medium>";
    let body = format!("{medium}<shape type='cube'><bsdf type='null'/><ref name='interior' id='fog'/></shape>");
    let medium = read(&scene(&body)).shapes[0].medium.unwrap();
    assert_eq!((medium.extinction, medium.albedo), (Vec3::new(1.0, 2.0, 0.5), Vec3::splat(0.75)));
}
