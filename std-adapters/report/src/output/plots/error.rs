//! Error against run time.

use crate::ProblemReport;
use crate::output::plots::axis::Scale;
use crate::output::plots::panel::{Panel, Series};
use crate::output::plots::{EXACT, chosen, look};

/// Relative RMSE over the time of one estimate, of the estimators `ids`.
pub(crate) fn error(problem: &ProblemReport, ids: &[&str]) -> String {
    let series = chosen(problem, ids).map(|method| {
        let mut series = Series::new(look(method.method.id()));
        for point in &method.points {
            let (time, rmse) = (point.seconds.median, point.relative.rmse());
            if rmse <= EXACT {
                continue;
            }
            series.line.push((time, rmse));
            series.points.push((time, rmse, true));
            // ±2 standard errors of the MSE; a lower end below 0 would have no place.
            let (mse, two) = (point.relative.mse, 2.0 * point.relative.mse_std_error);
            series.band.push((time, libm::sqrt((mse - two).max(mse / 4.0)), libm::sqrt(mse + two)));
        }
        series
    });
    Panel {
        title: format!("Error against run time: {}", problem.problem.title()),
        x: ("run time of one estimate", Scale::LogSeconds),
        y: ("RMSE / F", Scale::Log),
        floor: vec![],
        series: series.collect(),
    }
    .svg()
}
