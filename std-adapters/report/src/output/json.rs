//! `report.json`.

use crate::exhibits::Exhibits;
use crate::{Coverage, Figures, MethodReport, Point, ProblemReport, Provenance, Report, Seconds, Versus};
use ratiocv_core::predict::Prediction;
use serde::Serialize;
use std::io;

#[derive(Serialize)]
struct File<'a> {
    provenance: &'a Provenance,
    problems: Vec<OfProblem>,
    exhibits: Option<&'a Exhibits>,
}

#[derive(Serialize)]
struct OfProblem {
    problem: &'static str,
    title: &'static str,
    formula: &'static str,
    about: &'static str,
    channels: Vec<Channel>,
    reference_draws: u64,
    estimators: Vec<OfMethod>,
}

#[derive(Serialize)]
struct Channel {
    channel: String,
    f_integral: f64,
    h_integral: f64,
}

#[derive(Serialize)]
struct OfMethod {
    estimator: &'static str,
    error_at_equal_time: OfVersus,
    time_to_equal_error: OfVersus,
    slope_in_draws: f64,
    slope_in_time: f64,
    theory_agrees: bool,
    theory_deviation: f64,
    points: Vec<OfPoint>,
}

#[derive(Serialize)]
struct OfVersus {
    kind: &'static str,
    ratio: Option<f64>,
    std_error: Option<f64>,
}

#[derive(Serialize)]
struct OfPoint {
    draws: u64,
    replicates: u64,
    seconds: OfSeconds,
    all: OfFigures,
    channels: Vec<OfFigures>,
}

#[derive(Serialize)]
struct OfSeconds {
    median: f64,
    lower_quartile: f64,
    upper_quartile: f64,
}

#[derive(Serialize)]
struct OfFigures {
    bias: f64,
    bias_std_error: f64,
    mse: f64,
    mse_std_error: f64,
    predicted: OfPrediction,
    predicted_first_order: OfPrediction,
    coverage: Option<OfCoverage>,
}

#[derive(Serialize)]
struct OfCoverage {
    share: f64,
    std_error: f64,
    without_interval: f64,
    flagged: f64,
    missed_flagged: f64,
}

#[derive(Serialize)]
struct OfPrediction {
    bias: f64,
    mse: f64,
}

/// What is not a number becomes `null`.
pub(super) fn json(report: &Report) -> io::Result<String> {
    let problems = report.problems.iter().map(problem).collect();
    let mut text = serde_json::to_string_pretty(&File {
        provenance: &report.provenance,
        problems,
        exhibits: report.exhibits.as_ref(),
    })?;
    text.push('\n');
    Ok(text)
}

fn problem(report: &ProblemReport) -> OfProblem {
    let problem = report.problem;
    let channel = |(channel, (f_integral, h_integral))| Channel { channel, f_integral, h_integral };
    OfProblem {
        problem: problem.id(),
        title: problem.title(),
        formula: problem.formula(),
        about: problem.about(),
        channels: problem.channels().into_iter().zip(problem.integrals()).map(channel).collect(),
        reference_draws: report.reference_draws,
        estimators: report.methods.iter().map(method).collect(),
    }
}

fn method(report: &MethodReport) -> OfMethod {
    OfMethod {
        estimator: report.method.id(),
        error_at_equal_time: versus(report.equal.error_at_equal_time),
        time_to_equal_error: versus(report.equal.time_to_equal_error),
        slope_in_draws: report.equal.slope_in_draws,
        slope_in_time: report.equal.slope_in_time,
        theory_agrees: report.theory.agrees,
        theory_deviation: report.theory.deviation,
        points: report.points.iter().map(point).collect(),
    }
}

fn versus(versus: Versus) -> OfVersus {
    let (kind, ratio, std_error) = match versus {
        Versus::Times { ratio, std_error } => ("times", Some(ratio), Some(std_error)),
        Versus::AtMost(ratio) => ("at_most", Some(ratio), None),
        Versus::Exact => ("exact", None, None),
        Versus::Never => ("never", None, None),
    };
    OfVersus { kind, ratio, std_error }
}

fn point(point: &Point) -> OfPoint {
    let Seconds { median, lower, upper } = point.seconds;
    OfPoint {
        draws: point.draws,
        replicates: point.replicates,
        seconds: OfSeconds { median, lower_quartile: lower, upper_quartile: upper },
        all: figures(&point.relative, point.coverage),
        channels: point.channels.iter().map(|channel| figures(&channel.relative, channel.coverage)).collect(),
    }
}

fn figures(figures: &Figures, coverage: Option<Coverage>) -> OfFigures {
    let prediction = |Prediction { bias, mse }| OfPrediction { bias, mse };
    OfFigures {
        bias: figures.bias,
        bias_std_error: figures.bias_std_error,
        mse: figures.mse,
        mse_std_error: figures.mse_std_error,
        predicted: prediction(figures.predicted),
        predicted_first_order: prediction(figures.first_order),
        coverage: coverage.map(shares),
    }
}

fn shares(coverage: Coverage) -> OfCoverage {
    let Coverage { share, std_error, without, flagged, missed_flagged } = coverage;
    OfCoverage { share, std_error, without_interval: without, flagged, missed_flagged }
}
