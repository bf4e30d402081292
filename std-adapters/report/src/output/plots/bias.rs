//! Bias against the number of draws.

use crate::ProblemReport;
use crate::output::plots::axis::Scale;
use crate::output::plots::panel::{Panel, Series};
use crate::output::plots::{EXACT, chosen, look};

/// |bias|/F over N, measured as marks and predicted as lines; grey where noise is larger.
pub(crate) fn bias(problem: &ProblemReport, ids: &[&str]) -> String {
    let mut floor: Vec<(f64, f64)> = vec![];
    let mut all = vec![];
    for method in chosen(problem, ids) {
        let mut series = Series::new(look(method.method.id()));
        for (index, point) in method.points.iter().enumerate() {
            let (draws, figures) = (point.draws as f64, &point.relative);
            let (size, noise) = (libm::fabs(figures.bias), 3.0 * figures.bias_std_error);
            if noise > EXACT {
                // The quietest estimator's noise.
                match floor.get_mut(index) {
                    Some(least) => least.1 = least.1.min(noise),
                    None => floor.push((draws, noise)),
                }
            }
            if size > noise && size > EXACT {
                series.points.push((draws, size, true));
                series.bars.push((draws, (size - noise).max(size / 4.0), size + noise));
            }
        }
        // Predictions are lines, as far as they could be seen.
        let least = floor.iter().map(|point| point.1).fold(f64::INFINITY, f64::min) / 3.0;
        let predicted =
            method.points.iter().map(|point| (point.draws as f64, libm::fabs(point.relative.predicted.bias)));
        series.line = predicted.skip_while(|(draws, _)| *draws < 8.0).filter(|(_, size)| *size > least).collect();
        all.push(series);
    }
    if floor.is_empty() {
        return "<p class=\"empty\">No bias beyond rounding.</p>\n".into();
    }
    // Of its own colour, the floor also keeps the panel's range where nothing is biased.
    let mut ghost = Series::new(look("mc"));
    ghost.look.dash = (1, 5);
    ghost.line = floor.clone();
    all.push(ghost);
    Panel {
        title: format!("Bias against the number of draws: {}", problem.problem.title()),
        x: ("draws N", Scale::Log),
        y: ("|bias| / F", Scale::Log),
        floor,
        series: all,
    }
    .svg()
}
