//! Whether error bars mean what they say: part of the page.

use crate::output::headings::headings;
use crate::output::poor::{judged_draws, poor};
use crate::output::selection::grouped;
use crate::output::words::percent;
use crate::{Coverage, MethodReport, Report};
use core::fmt::Write;

/// Classes of the style sheet, each for shares from its first number on, and what they mean.
const SHADES: [(f64, &str, &str); 6] = [
    (0.98, "c-wide", "98 % and more: exact, or wider than need be"),
    (0.93, "c-good", "from 93 %"),
    (0.9, "c-fair", "from 90 %"),
    (0.8, "c-low", "from 80 %"),
    (0.6, "c-poor", "from 60 %"),
    (0.0, "c-bad", "less"),
];

/// The section.
pub(super) fn coverage(page: &mut String, report: &Report) {
    let error = largest_error(report);
    let shades: String = SHADES
        .iter()
        .map(|(_, class, meaning)| format!("<li><span class=\"shade {class}\"></span>{meaning}</li>"))
        .collect();
    let _ = write!(
        page,
        "<h2>Do the error bars mean what they say?</h2>\n\
         <p>How many per cent of the intervals value ± 1.96 standard errors contain F, after so many draws, all channels \
         together: 95 where error bars can be trusted. The standard error of these figures is at most {error}; point at \
         one for its own, for the worst channel and for flags. Errors of rounding size (10⁻¹² F) count as covered; \
         estimates whose error is unknown have no interval, and count neither way.</p>\n\
         <ul class=\"legend\">{shades}</ul>\n{}{}",
        heat(report),
        poor_ones(report),
    );
}

fn largest_error(report: &Report) -> String {
    let points = report.problems.iter().flat_map(|problem| &problem.methods).flat_map(|method| &method.points);
    let errors = points.filter_map(|point| point.coverage).map(|coverage| coverage.std_error);
    percent(errors.filter(|error| !error.is_nan()).fold(0.0, f64::max), 1) + " %"
}

fn heat(report: &Report) -> String {
    let Some(first) = report.problems.first() else { return String::new() };
    let mut rows = String::new();
    for problem in &report.problems {
        let (methods, draws): (_, Vec<_>) = (grouped(problem), judged_draws(problem).collect());
        for (place, (index, draws_each)) in draws.iter().enumerate() {
            let cells: String =
                methods.iter().map(|method| cell(&problem.problem.channels(), method, *index)).collect();
            let (class, name) = if place == 0 {
                let name = format!("<th class=\"stick\" rowspan=\"{}\">{}</th>", draws.len(), problem.problem.id());
                (" class=\"first\"", name)
            } else {
                ("", String::new())
            };
            let _ = writeln!(rows, "<tr{class}>{name}<td class=\"draws\">{draws_each}</td>{cells}</tr>");
        }
    }
    let head = headings(&grouped(first), &["draws"]);
    format!(
        "<div class=\"scroll\"><table class=\"wide heat\">\n<thead>{head}</thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

fn cell(channels: &[String], method: &MethodReport, index: usize) -> String {
    let point = &method.points[index];
    let Some(coverage) = point.coverage else { return "<td></td>".into() };
    let Coverage { share, std_error, without, flagged, missed_flagged } = coverage;
    let mut says = format!(
        "{}, {} draws: {} ± {} %; flagged {} %, of the misses {} %; no interval {} %",
        method.method.id(),
        point.draws,
        percent(share, 1),
        percent(std_error, 1),
        percent(flagged, 0),
        percent(missed_flagged, 0),
        percent(without, 0),
    );
    if let Some((channel, worst)) = point.worst_coverage().filter(|_| channels.len() > 1) {
        let _ = write!(says, "; worst channel {} {} %", channels[channel], percent(worst.share, 0));
    }
    // Shaded as it is shown: two cells that say 93 look alike.
    let shown = libm::round(100.0 * share) / 100.0;
    let class = SHADES.iter().find(|(from, ..)| shown >= *from).map_or("c-none", |(_, class, _)| class);
    format!("<td class=\"{class}\" title=\"{says}\">{}</td>", percent(share, 0))
}

fn poor_ones(report: &Report) -> String {
    let mut rows = String::new();
    for problem in &report.problems {
        for poor in poor(problem, &grouped(problem)) {
            let ids: Vec<_> = poor.ids().iter().map(|id| format!("<code>{id}</code>")).collect();
            let _ = writeln!(
                rows,
                "<tr><td><b>{}</b></td><td data-name=\"draws\">{}</td><td class=\"left\">{}</td>\
                 <td data-name=\"contain F\">{}</td><td data-name=\"in the worst channel\">{}</td>\
                 <td data-name=\"estimates flagged\">{}</td><td data-name=\"misses flagged\">{}</td>\
                 <td data-name=\"no interval\">{}</td></tr>",
                poor.problem.problem.id(),
                poor.draws,
                ids.join(", "),
                poor.share(),
                poor.worst(),
                poor.flagged(),
                poor.missed_flagged(),
                poor.without(),
            );
        }
    }
    if rows.is_empty() {
        return "<p>Nowhere do fewer than 90 % of the intervals of a consistent estimator contain F.</p>\n".into();
    }
    format!(
        "<h3 class=\"list\">Under 90 %</h3>\n\
         <p>Where fewer than 90 % of the intervals contain F, or fewer than 90 % of the estimates have one, and whether \
         the estimates say so themselves: the share that carries a flag, any flag at all (<code>LOW_ESS</code>, \
         <code>DENOM_ILL</code>, <code>HEAVY_TAIL</code>, …), of all and of those that miss. All figures in %, from the \
         least to the largest of the estimators named. A few draws of a skewed integrand do not know how far off they \
         are: where flags are rare too, only more draws tell. The mean of ratios is left out: it does not converge, so \
         that its intervals must miss.</p>\n\
         <div class=\"scroll\"><table class=\"wrap poor\">\n<thead><tr><th>problem</th><th>draws</th><th class=\"left\">\
         estimators</th><th>contain F</th><th>in the worst<br>channel</th><th>estimates<br>flagged</th>\
         <th>misses<br>flagged</th><th>no<br>interval</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}
