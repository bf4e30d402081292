//! Measured against predicted MSE.

use crate::ProblemReport;
use crate::output::plots::axis::Scale;
use crate::output::plots::panel::{Panel, Series};
use crate::output::plots::{EXACT, chosen, look};

/// N·MSE/F² over N: measured as marks with error bars, predicted to second order as lines.
pub(crate) fn theory(problem: &ProblemReport, ids: &[&str]) -> String {
    let series = chosen(problem, ids).map(|method| {
        let mut series = Series::new(look(method.method.id()));
        for point in &method.points {
            let (draws, figures) = (point.draws as f64, &point.relative);
            if figures.rmse() <= EXACT {
                continue;
            }
            let (mse, two) = (draws * figures.mse, 2.0 * draws * figures.mse_std_error);
            series.points.push((draws, mse, false));
            series.bars.push((draws, (mse - two).max(mse / 4.0), mse + two));
            // An expansion that has gone negative, or far off, says nothing for so few draws.
            let predicted = draws * figures.predicted.mse;
            if predicted > mse / 30.0 && predicted < mse * 30.0 {
                series.line.push((draws, predicted));
            }
        }
        series
    });
    Panel {
        title: format!("Predicted and measured error: {}", problem.problem.title()),
        x: ("draws N", Scale::Log),
        y: ("N · MSE / F²", Scale::Log),
        floor: vec![],
        series: series.collect(),
    }
    .svg()
}
