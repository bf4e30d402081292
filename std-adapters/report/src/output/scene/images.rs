//! Images and maps of their errors.

use crate::output::picture::{Picture, red_or_blue, srgb};
use crate::scene::SceneReport;

/// Errors of this many times the root of plain's mean squared error are the full colour.
const FULL: f64 = 2.0;

/// Pictures and what is written below each: images at equal time, the reference, and the error of each image.
pub(super) fn pictures(report: &SceneReport) -> Vec<(Picture, String)> {
    let width = report.size[0] as usize;
    let reference = &report.reference.radiance;
    let colours = |radiance: &[[f32; 3]]| {
        radiance.iter().map(|rgb| rgb.map(|x| srgb(f64::from(x)))).collect::<Vec<_>>().into_iter()
    };
    let mut pictures = Vec::new();
    for shown in &report.shown {
        let (name, method) = (format!("image-{}", shown.method.name()), shown.method.name());
        let picture = Picture::new(name, method, width, colours(&shown.image.radiance));
        let caption = format!("<code>{method}</code>, {} samples, MSE {:.3e}", shown.samples, shown.mse);
        pictures.push((picture, caption));
    }
    let caption = format!("reference, {} samples", report.reference.samples);
    pictures.push((Picture::new("image-reference", "reference", width, colours(reference)), caption));
    let full = FULL * libm::sqrt(report.shown.first().map_or(1.0, |plain| plain.mse.max(f64::MIN_POSITIVE)));
    for shown in &report.shown {
        let errors = shown.image.radiance.iter().zip(reference).map(|(rgb, right)| {
            let error: f64 = rgb.iter().zip(right).map(|(x, right)| f64::from(*x) - f64::from(*right)).sum();
            red_or_blue(error / 3.0 / full)
        });
        let method = shown.method.name();
        let name = format!("error-{method}");
        let picture = Picture::new(name, format!("error of {method}"), width, errors);
        pictures.push((picture, format!("error of <code>{method}</code>: red too bright, blue too dark")));
    }
    pictures
}
