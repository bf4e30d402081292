//! Scene files: what is read of them, what is refused, and where messages point.

mod built_in;
mod defaults;
mod lenient;
mod meshes;
mod mutations;
mod refusals;
mod sensors;
mod surfaces;
mod transforms;

use ratiocv_scene::{Description, Leniency};

/// A camera, so that a scene has one.
const SENSOR: &str = r#"<sensor type="perspective"><float name="fov" value="40"/><film type="hdrfilm"><rfilter type="box"/></film></sensor>"#;

/// A light likewise.
const LIGHT: &str = r#"<emitter type="constant"/>"#;

/// `body` in a scene with a camera and a light, which are on line 1; `body` begins on line 2.
fn scene(body: &str) -> String {
    format!("<scene version=\"3.0.0\">{SENSOR}{LIGHT}\n{body}\n</scene>")
}

fn read(text: &str) -> Description {
    let (description, warnings) =
        Description::parse(text, "scene.xml", Leniency::Strict).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert!(warnings.is_empty(), "{warnings:?}");
    description
}

fn error(text: &str) -> ratiocv_scene::Error {
    Description::parse(text, "scene.xml", Leniency::Strict).map(|_| ()).expect_err(text)
}
