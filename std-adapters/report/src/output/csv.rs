//! `report.csv`.

use crate::{Coverage, Figures, Report};
use std::io;

const HEADER: [&str; 23] = [
    "problem",
    "estimator",
    "draws",
    "channel",
    "replicates",
    "bias",
    "bias_std_error",
    "mse",
    "mse_std_error",
    "predicted_bias",
    "predicted_mse",
    "coverage",
    "coverage_std_error",
    "without_interval",
    "flagged",
    "missed_flagged",
    "seconds_median",
    "seconds_lower_quartile",
    "seconds_upper_quartile",
    "seed",
    "version",
    "cpu",
    "compiler",
];

/// One row per problem, estimator, number of draws and channel; the mean over channels is called `all`.
pub(super) fn csv(report: &Report) -> io::Result<String> {
    let mut file = csv::Writer::from_writer(Vec::new());
    file.write_record(HEADER)?;
    for problem in &report.problems {
        let channels = problem.problem.channels();
        for method in &problem.methods {
            for point in &method.points {
                let all = core::iter::once(("all", (&point.relative, point.coverage)));
                // The one channel of a scalar problem is the mean over channels.
                let each =
                    channels.iter().map(String::as_str).zip(&point.channels).filter(|(name, _)| !name.is_empty());
                let each = each.map(|(name, channel)| (name, (&channel.relative, channel.coverage)));
                for (channel, (figures, coverage)) in all.chain(each) {
                    let mut row = vec![
                        problem.problem.id().into(),
                        method.method.id().into(),
                        point.draws.to_string(),
                        channel.into(),
                        point.replicates.to_string(),
                    ];
                    let seconds = point.seconds;
                    row.extend(columns(figures).map(number));
                    row.extend(shares(coverage).map(number));
                    row.extend([seconds.median, seconds.lower, seconds.upper].map(number));
                    row.extend([
                        report.provenance.seed.to_string(),
                        report.provenance.version.into(),
                        report.provenance.cpu.clone(),
                        report.provenance.compiler.into(),
                    ]);
                    file.write_record(row)?;
                }
            }
        }
    }
    text(file)
}

/// What was written to `file`.
pub(super) fn text(file: csv::Writer<Vec<u8>>) -> io::Result<String> {
    let bytes = file.into_inner().map_err(csv::IntoInnerError::into_error)?;
    String::from_utf8(bytes).map_err(io::Error::other)
}

fn columns(figures: &Figures) -> [f64; 6] {
    let Figures { bias, bias_std_error, mse, mse_std_error, predicted, .. } = *figures;
    [bias, bias_std_error, mse, mse_std_error, predicted.bias, predicted.mse]
}

/// Nothing where intervals were not judged.
fn shares(coverage: Option<Coverage>) -> [f64; 5] {
    let shares = |Coverage { share, std_error, without, flagged, missed_flagged }| {
        [share, std_error, without, flagged, missed_flagged]
    };
    coverage.map_or([f64::NAN; 5], shares)
}

/// Shortest digits that read back as the same number; nothing for what is not one.
pub(super) fn number(x: f64) -> String {
    if x.is_finite() { format!("{x:e}") } else { String::new() }
}
