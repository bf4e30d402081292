//! `scene.csv` and `scene.json`.

use crate::Provenance;
use crate::scene::SceneReport;
use serde::Serialize;
use std::io;

/// A row of `scene.csv`, and a point of `scene.json`.
#[derive(Serialize)]
struct Row {
    scene: String,
    estimator: &'static str,
    samples: u64,
    replicates: u64,
    mse: f64,
    mse_std_error: Option<f64>,
    relative_mse: f64,
    seconds: f64,
    samples_per_second: f64,
    gain: f64,
    efficiency: f64,
}

#[derive(Serialize)]
struct File<'a> {
    provenance: &'a Provenance,
    scene: &'a str,
    width: u32,
    height: u32,
    reference_samples: u64,
    reference_mse: f64,
    left_out: Vec<&'static str>,
    points: Vec<Row>,
}

fn rows(report: &SceneReport) -> Vec<Row> {
    let pixels = f64::from(report.size[0]) * f64::from(report.size[1]);
    let mut rows = Vec::new();
    for curve in &report.curves {
        rows.extend(curve.points.iter().map(|point| Row {
            scene: report.name.clone(),
            estimator: curve.method.name(),
            samples: point.samples,
            replicates: point.replicates,
            mse: point.mse,
            mse_std_error: Some(point.mse_std_error).filter(|error| error.is_finite()),
            relative_mse: point.relative_mse,
            seconds: point.seconds,
            samples_per_second: pixels * point.samples as f64 / point.seconds,
            gain: point.gain,
            efficiency: point.efficiency,
        }));
    }
    rows
}

pub(super) fn csv(report: &SceneReport) -> io::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows(report) {
        writer.serialize(row).map_err(io::Error::other)?;
    }
    let bytes = writer.into_inner().map_err(|error| io::Error::other(error.to_string()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

pub(super) fn json(report: &SceneReport) -> io::Result<String> {
    let file = File {
        provenance: &report.provenance,
        scene: &report.name,
        width: report.size[0],
        height: report.size[1],
        reference_samples: report.reference.samples,
        reference_mse: report.reference.mse,
        left_out: report.needs.explain(),
        points: rows(report),
    };
    Ok(serde_json::to_string_pretty(&file)?)
}
