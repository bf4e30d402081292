//! Error against run time on a scene.

use crate::output::plots::axis::Scale;
use crate::output::plots::look;
use crate::output::plots::panel::{Panel, Series};
use crate::scene::{Curve, SceneReport};

/// The curves that are drawn: of each method the one on the defensive auxiliary, if there is one.
pub(crate) fn drawn(report: &SceneReport) -> impl Iterator<Item = &Curve> {
    report.curves.iter().filter(|curve| {
        let defensive = format!("defensive_{}", curve.method.name());
        report.curves.iter().all(|other| other.method.name() != defensive)
    })
}

/// RMSE over the time of one image, of every method.
pub(crate) fn scene_error(report: &SceneReport) -> String {
    let series = drawn(report).map(|curve| {
        let mut series = Series::new(look(curve.method.name()));
        for point in curve.points.iter().filter(|point| point.mse > 0.0) {
            series.line.push((point.seconds, libm::sqrt(point.mse)));
            series.points.push((point.seconds, libm::sqrt(point.mse), true));
        }
        series
    });
    Panel {
        title: format!("Error against run time: {}", report.name),
        x: ("run time of one image", Scale::LogSeconds),
        y: ("RMSE", Scale::Log),
        floor: vec![],
        series: series.collect(),
    }
    .svg()
}
