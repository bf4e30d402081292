//! Scene files of any bytes.

use ratiocv_core::Spectrum;
use ratiocv_scene::{Description, Leniency, Scene};

/// A scene file, read strictly and leniently: a description, from which a scene can be made or is refused; or an error
/// that names the file, and is short. What is read strictly is read leniently too.
pub fn scene(bytes: &[u8]) {
    let Ok(text) = core::str::from_utf8(bytes) else { return };
    let read =
        [Leniency::Strict, Leniency::Lenient].map(|leniency| match Description::parse(text, "scene.xml", leniency) {
            Ok((description, warnings)) => {
                let _ = Scene::<Spectrum<f32, 3>>::new(&description, &Default::default());
                assert!(
                    (0.0..=180.0).contains(&description.camera.fov),
                    "a field of view of {}°",
                    description.camera.fov
                );
                for warning in &warnings {
                    is_short(&warning.to_string());
                }
                true
            }
            Err(error) => {
                is_short(&error.to_string());
                assert!(error.line().is_none_or(|line| line <= 1 + text.matches('\n').count()), "{error}");
                false
            }
        });
    assert!(!read[0] || read[1], "read strictly, but not leniently");
}

fn is_short(message: &str) {
    assert!(message.starts_with("scene.xml") && message.len() < 2000, "{message}");
}
