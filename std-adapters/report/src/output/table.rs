//! A report for the terminal.

use crate::output::summary::summary;
use crate::output::words::{short, time, versus};
use crate::{MethodReport, ProblemReport, Report};
use comfy_table::{CellAlignment, ContentArrangement, LineStyle, Table, TableStyle};
use core::fmt::Write;

const WIDTH: u16 = 110;

pub(super) fn table(report: &Report) -> String {
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
        let _ = writeln!(text, "{}", one_problem(problem));
    }
    let _ = writeln!(
        text,
        "error, time: RMSE in the time of plain Monte Carlo, and time to its RMSE, as multiples of plain's.\n\
         slope: d log RMSE/d log draws. bias in %, in () its standard errors. RMSE in % of F; theory: as predicted.\n\
         {}, {}, {} threads, seed {}, {:.0} s",
        report.provenance.cpu,
        report.provenance.compiler,
        report.provenance.threads,
        report.provenance.seed,
        report.provenance.wall_seconds,
    );
    text
}

fn new_table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─')));
    table.set_content_arrangement(ContentArrangement::Dynamic);
    table.set_width(WIDTH).set_header(header);
    table
}

fn one_problem(problem: &ProblemReport) -> String {
    let draws = problem.methods.first().and_then(|method| method.points.last()).map_or(0, |point| point.draws);
    let mut table = new_table(&["estimator", "error", "time", "slope", "bias", "RMSE", "theory", "run time"]);
    for method in &problem.methods {
        table.add_row(row(method));
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!(
        "{}: {}\nerror and time against plain with {} draws; the rest at {draws} draws\n{table}\n",
        problem.problem.id(),
        problem.problem.title(),
        problem.reference_draws,
    )
}

fn row(method: &MethodReport) -> Vec<String> {
    let Some(point) = method.points.last() else { return vec![method.method.id().into()] };
    let figures = &point.relative;
    let percent = |x: f64| short(100.0 * x);
    let equal = &method.equal;
    vec![
        method.method.id().into(),
        versus(equal.error_at_equal_time),
        versus(equal.time_to_equal_error),
        if equal.slope_in_draws.is_finite() { format!("{:.2}", equal.slope_in_draws) } else { "–".into() },
        format!("{} ({:.1})", percent(figures.bias), figures.bias / figures.bias_std_error),
        percent(figures.rmse()),
        percent(libm::sqrt(figures.predicted.mse.max(0.0))),
        time(point.seconds.median),
    ]
}
