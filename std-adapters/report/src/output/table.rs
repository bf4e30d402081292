//! A report for the terminal.

use crate::output::poor::{judged_draws, poor};
use crate::output::selection::{best, grouped, shortlist};
use crate::output::summary::summary;
use crate::output::words::{percent, short, time, versus};
use crate::{MethodReport, ProblemReport, Report};
use comfy_table::{Attribute, Cell, CellAlignment, ContentArrangement, LineStyle, Table, TableStyle};
use core::fmt::Write;

const WIDTH: u16 = 110;

/// What a table for the terminal shows, and how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TableOptions {
    /// Every estimator that was measured; else plain Monte Carlo and the best of each other group.
    pub all: bool,
    /// The best estimator of each problem in bold, by ANSI escape sequences.
    pub bold: bool,
}

pub(super) fn table(report: &Report, options: TableOptions) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = writeln!(text, "The least error for the run time of plain Monte Carlo, problem by problem:\n");
    let mut lead = new_table(&["problem", "best estimator", "as good within noise", "its error", "theory agrees"]);
    for problem in &report.problems {
        let Some(line) = summary(problem) else { continue };
        let ties = if line.ties == 0 { String::new() } else { format!("{} others", line.ties) };
        lead.add_row([problem.problem.id().into(), line.best.method.id().into(), ties, line.error(), line.theory()]);
    }
    let _ = writeln!(text, "{lead}\n");
    for problem in &report.problems {
        let _ = writeln!(text, "{}", one_problem(problem, options));
    }
    let _ = writeln!(
        text,
        "error, time: RMSE in the time of plain Monte Carlo, and time to its RMSE, as multiples of plain's.\n\
         slope: d log RMSE/d log draws. bias in %, in () its standard errors. RMSE in % of F; theory: as predicted.\n\
         covered: % of the intervals value ± 1.96 std_error that contain F."
    );
    if !options.all {
        let _ = writeln!(
            text,
            "Only plain Monte Carlo and the best of each group (the simplest of equals) are listed; the files have all."
        );
    }
    text.push_str(&poor_ones(report, options));
    let _ = writeln!(
        text,
        "\n{}, {}, {}, {} threads, seed {}, {:.0} s",
        report.provenance.cpu,
        report.provenance.level,
        report.provenance.compiler,
        report.provenance.threads,
        report.provenance.seed,
        report.provenance.wall_seconds,
    );
    text
}

/// "16, 64, 256".
fn judged(problem: &ProblemReport) -> String {
    judged_draws(problem).map(|(_, draws)| draws.to_string()).collect::<Vec<_>>().join(", ")
}

fn new_table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─')));
    table.set_content_arrangement(ContentArrangement::Dynamic);
    table.force_no_tty().set_width(WIDTH).set_header(header);
    table
}

fn shown(problem: &ProblemReport, options: TableOptions) -> Vec<&MethodReport> {
    if options.all { grouped(problem) } else { shortlist(problem) }
}

fn one_problem(problem: &ProblemReport, options: TableOptions) -> String {
    let draws = problem.methods.first().and_then(|method| method.points.last()).map_or(0, |point| point.draws);
    let mut table =
        new_table(&["estimator", "error", "time", "slope", "bias", "RMSE", "theory", "run time", "covered"]);
    let best = best(problem.methods.iter()).map(|best| best.method);
    if options.bold {
        table.enforce_styling();
    }
    for method in shown(problem, options) {
        let cell = |text| {
            if best == Some(method.method) { Cell::new(text).add_attribute(Attribute::Bold) } else { Cell::new(text) }
        };
        table.add_row(row(problem, method).into_iter().map(cell));
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!(
        "{}: {}\nerror and time against plain with {} draws; covered with {}; the rest at {draws} draws\n{table}\n",
        problem.problem.id(),
        problem.problem.title(),
        problem.reference_draws,
        judged(problem),
    )
}

fn row(problem: &ProblemReport, method: &MethodReport) -> Vec<String> {
    let Some(point) = method.points.last() else { return vec![method.method.id().into()] };
    let figures = &point.relative;
    let equal = &method.equal;
    let shares = judged_draws(problem).map(|(index, _)| method.points[index].coverage.map_or(f64::NAN, |it| it.share));
    vec![
        method.method.id().into(),
        versus(equal.error_at_equal_time),
        versus(equal.time_to_equal_error),
        if equal.slope_in_draws.is_finite() { format!("{:.2}", equal.slope_in_draws) } else { "–".into() },
        format!("{} ({:.1})", short(100.0 * figures.bias), figures.bias / figures.bias_std_error),
        short(100.0 * figures.rmse()),
        short(100.0 * libm::sqrt(figures.predicted.mse.max(0.0))),
        time(point.seconds.median),
        shares.map(|share| format!("{:>3}", percent(share, 0))).collect::<Vec<_>>().join(" "),
    ]
}

/// Where error bars are not to be trusted, of the estimators that are shown.
fn poor_ones(report: &Report, options: TableOptions) -> String {
    let mut table =
        new_table(&["problem", "draws", "estimators", "covered", "flagged", "misses flagged", "no interval"]);
    for problem in &report.problems {
        for poor in poor(problem, &shown(problem, options)) {
            table.add_row([
                poor.problem.problem.id().into(),
                poor.draws.to_string(),
                poor.ids().join(", "),
                poor.share(),
                poor.flagged(),
                poor.missed_flagged(),
                poor.without(),
            ]);
        }
    }
    if table.is_empty() {
        return String::new();
    }
    for column in table.column_iter_mut().filter(|column| column.index != 0 && column.index != 2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!(
        "\nError bars to be wary of: fewer than 90 % of the intervals contain F, or of the estimates have one.\n\
         In %, with the share of the estimates, and of the misses, that carry a flag of any kind:\n\n{table}\n"
    )
}
