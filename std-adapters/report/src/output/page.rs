//! `index.html`: one file, nothing loaded from elsewhere.

use crate::output::coverage::coverage;
use crate::output::exhibits;
use crate::output::headings::headings;
use crate::output::plots::{bias, error, functions, functions_legend, look, swatch, theory};
use crate::output::selection::{grouped, leaders};
use crate::output::summary::summary;
use crate::output::words::versus;
use crate::{MethodReport, ProblemReport, Report};
use core::fmt::Write;

pub(super) const STYLE: &str = include_str!("page.css");

/// Enough estimators to tell the story and few enough to be told apart: Quenouille, Beale, Tin and the jackknife
/// lie on the ratio's curve wherever errors, not biases, are drawn, and the other fitted ones on the difference's.
const ERRORS: [&str; 6] = ["mc", "ratio", "difference", "mean_of_ratios", "hartley_ross", "mickey"];
const DEFENSIVE: [&str; 6] = [
    "mc",
    "defensive_ratio",
    "defensive_beale",
    "defensive_mean_of_ratios",
    "defensive_hartley_ross",
    "defensive_mickey",
];
const BIASES: [&str; 7] = ["ratio", "quenouille", "beale", "tin", "mean_of_ratios", "hartley_ross", "mickey"];

pub(super) fn page(report: &Report) -> String {
    let mut page = String::new();
    head(&mut page, report);
    // Writing to a String cannot fail.
    let _ = write!(page, "<h2>Which estimator, for the same run time?</h2>\n{}", verdicts(report));
    let _ = write!(page, "<h2>Error at equal time</h2>\n{}", equal_times(report));
    coverage(&mut page, report);
    let errors = |problem: &ProblemReport| error(problem, &ERRORS);
    let intro = "Left and low is good. Black dashes are plain Monte Carlo; a curve below it is a gain. Each mark \
                 doubles the number of draws, from 2. Bands are ±2 standard errors. A curve that levels off has a bias \
                 that does not vanish. The step at 64 draws is real: from there on they are summed in blocks. What is exact \
                 to rounding is not drawn.";
    section(&mut page, report, "Error against run time", intro, &legend(report, &ERRORS), &errors);
    let defended = |problem: &ProblemReport| error(problem, &DEFENSIVE);
    let weight = report.provenance.defensive_weight;
    let _ = writeln!(page, "<details><summary>The same on the defensive auxiliary (weight {weight})</summary>");
    panels(&mut page, report, &legend(report, &DEFENSIVE), &defended);
    page.push_str("</details>\n");
    let biases = |problem: &ProblemReport| bias(problem, &BIASES);
    let intro = "Marks are measured biases that stand out from noise, with ±3 standard errors; lines are predictions, \
                 from 8 draws on. Below the grey area's edge (three standard errors of the quietest estimator) nothing can be \
                 seen. The ratio's bias falls as 1/N, that of Quenouille, Beale and Tin as 1/N², that of the mean of \
                 ratios not at all; Hartley–Ross and Mickey have none.";
    section(&mut page, report, "Bias against the number of draws", intro, &legend(report, &BIASES), &biases);
    let theories = |problem: &ProblemReport| theory(problem, &ERRORS);
    let intro = "N times the MSE: flat where the error falls as 1/√N. Open marks are measured, with ±2 standard errors; \
                 lines are predicted to second order in 1/N from the problem's own moments. They should meet on the right; \
                 for few draws the expansion of a ratio may be off, that of plain Monte Carlo and Hartley–Ross is exact.";
    section(&mut page, report, "Predicted and measured error", intro, &legend(report, &ERRORS), &theories);
    report.exhibits.iter().for_each(|measured| page.push_str(&exhibits::sections(measured)));
    integrands(&mut page, report);
    foot(&mut page, report);
    page
}

fn head(page: &mut String, report: &Report) {
    let _ = write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Ratio control variates: error against run time</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <h1>Ratio control variates: error against run time</h1>\n\
         <p>Integrals F whose values are known exactly, estimated again and again from N random draws of an integrand f \
         and an auxiliary h whose integral H is known. Errors are relative to F; for several channels (colours, \
         wavelengths) the mean of the squared relative error over channels.</p>\n"
    );
    if report.provenance.quick {
        page.push_str("<p class=\"says\">A quick look: few replicates, at most 256 draws.</p>\n");
    }
}

/// What the numbers say, first.
fn verdicts(report: &Report) -> String {
    let mut rows = String::new();
    for problem in &report.problems {
        let Some(line) = summary(problem) else { continue };
        let ties = if line.ties == 0 {
            String::new()
        } else {
            format!(" <span class=\"soft\">(and {} others within noise)</span>", line.ties)
        };
        let _ = writeln!(
            rows,
            "<tr><td><b>{}</b><br><span class=\"soft\">{}</span></td><td class=\"left\" data-name=\"least error\"><code>{}</code>{ties}</td><td data-name=\"RMSE at equal time\">{}</td><td class=\"left\" data-name=\"theory agrees\">{}</td></tr>",
            escaped(problem.problem.title()),
            escaped(problem.problem.about()),
            line.best.method.id(),
            line.error(),
            line.theory(),
        );
    }
    format!(
        "<div class=\"scroll\"><table class=\"wrap\">\n<thead><tr><th>problem</th><th class=\"left\">least error</th>\
         <th>RMSE at equal time</th><th class=\"left\">theory agrees</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

/// Rows of problems, columns of estimators.
fn equal_times(report: &Report) -> String {
    let Some(first) = report.problems.first() else { return String::new() };
    let mut rows = String::new();
    for problem in &report.problems {
        let leaders = leaders(problem.methods.iter());
        let cell = |method: &MethodReport| {
            let error = method.equal.error_at_equal_time;
            let class = match leaders.iter().position(|leader| leader.method == method.method) {
                Some(0) => " class=\"best\"",
                Some(_) => " class=\"tied\"",
                None if error.ratio() > 1.05 => " class=\"worse\"",
                None => "",
            };
            format!("<td{class}>{}</td>", versus(error))
        };
        let cells: String = grouped(problem).into_iter().map(cell).collect();
        let _ = writeln!(rows, "<tr><th class=\"stick\">{}</th>{cells}</tr>", problem.problem.id());
    }
    format!(
        "<p>RMSE as a multiple of plain Monte Carlo's, when each estimator gets the time that plain takes for {} draws. \
         Below 1 is a gain. The least of each row is marked, and what noise cannot tell from it; the simplest of these \
         is in bold (the mean of ratios is out of the running: its bias stays).</p>\n\
         <div class=\"scroll\"><table class=\"wide\">\n<thead>{}</thead>\n<tbody>\n{rows}</tbody></table></div>\n",
        first.reference_draws,
        headings(&grouped(first), &[]),
    )
}

fn section(
    page: &mut String,
    report: &Report,
    title: &str,
    intro: &str,
    legend: &str,
    plot: &dyn Fn(&ProblemReport) -> String,
) {
    let _ = write!(page, "<h2>{title}</h2>\n<p>{intro}</p>\n");
    panels(page, report, legend, plot);
}

fn panels(page: &mut String, report: &Report, legend: &str, plot: &dyn Fn(&ProblemReport) -> String) {
    let _ = writeln!(page, "{legend}<div class=\"panels\">");
    for problem in &report.problems {
        let _ = write!(page, "<figure><h3>{}</h3>\n{}</figure>\n", escaped(problem.problem.title()), plot(problem));
    }
    page.push_str("</div>\n");
}

fn legend(report: &Report, ids: &[&str]) -> String {
    let measured = |id: &&&str| {
        report.problems.iter().any(|problem| problem.methods.iter().any(|method| method.method.id() == **id))
    };
    let entries: String =
        ids.iter().filter(measured).map(|id| format!("<li>{}<code>{id}</code></li>", swatch(look(id)))).collect();
    format!("<ul class=\"legend\">{entries}</ul>\n")
}

fn integrands(page: &mut String, report: &Report) {
    page.push_str(
        "<h2>The integrands</h2>\n<p>f and h divided by their integrals: the nearer the two curves of a colour, the more \
         a ratio gains. Where draws are not uniform, what matters is both divided by g.</p>\n<div class=\"panels\">\n",
    );
    for problem in &report.problems {
        let entries: String =
            functions_legend(problem).iter().map(|(swatch, name)| format!("<li>{swatch}{name}</li>")).collect();
        let _ = write!(
            page,
            "<figure><h3>{}</h3>\n{}<ul class=\"legend\">{entries}</ul>\n<figcaption>{}. {}</figcaption></figure>\n",
            escaped(problem.problem.title()),
            functions(problem),
            escaped(problem.problem.formula()),
            escaped(problem.problem.about()),
        );
    }
    page.push_str("</div>\n");
}

fn foot(page: &mut String, report: &Report) {
    let from = &report.provenance;
    let _ = write!(
        page,
        "<h2>How it was measured</h2>\n<p>All estimators of a replicate share its draws. Run times include sampling and \
         the estimator's own moments with error bars; medians on one thread, estimators taking turns. Everything but the \
         times is the same to the bit for the same seed and budget, on any number of threads. The numbers are in \
         <code>report.csv</code> and <code>report.json</code>.</p>\n\
         <p class=\"soft\">ratiocv {}, {}, {}, {}; {} ({}), {} threads; {}; seed {}, budget {} s, defensive weight {}; took \
         {:.0} s.</p>\n</body>\n</html>\n",
        from.version,
        escaped(from.compiler),
        from.target,
        from.profile,
        escaped(&from.cpu),
        from.level,
        from.threads,
        from.date,
        from.seed,
        from.budget_seconds,
        from.defensive_weight,
        from.wall_seconds,
    );
}

pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
