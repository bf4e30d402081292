//! The table for a terminal.

use crate::scene::SceneReport;
use core::fmt::Write;

pub(super) fn table(report: &SceneReport) -> String {
    let mut text = format!(
        "{}, {} x {} pixels; reference of {} samples, its own MSE {:.1e}\n",
        report.name, report.size[0], report.size[1], report.reference.samples, report.reference.mse
    );
    let Some(plain) = report.curves.first() else { return text };
    let cells = |title: &str, cell: &dyn Fn(usize, usize) -> String, text: &mut String| {
        let _ = write!(text, "\n{title:24}");
        for point in &plain.points {
            let _ = write!(text, "{:>12}", point.samples);
        }
        text.push('\n');
        for (row, curve) in report.curves.iter().enumerate() {
            let _ = write!(text, "{:24}", curve.method.name());
            for column in 0..curve.points.len() {
                let _ = write!(text, "{:>12}", cell(row, column));
            }
            text.push('\n');
        }
    };
    let point = |row: usize, column: usize| report.curves[row].points[column];
    cells("MSE, by samples", &|row, column| format!("{:.3e}", point(row, column).mse), &mut text);
    cells("gain at equal samples", &|row, column| format!("{:.2}", point(row, column).gain), &mut text);
    cells("gain at equal time", &|row, column| format!("{:.2}", point(row, column).efficiency), &mut text);
    let pixels = f64::from(report.size[0]) * f64::from(report.size[1]);
    let rate = |row, column| {
        let point = point(row, column);
        format!("{:.2}", pixels * point.samples as f64 / point.seconds / 1e6)
    };
    cells("M samples/s", &rate, &mut text);
    text
}
