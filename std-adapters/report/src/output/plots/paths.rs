//! Bias against the number of paths, of a channel of the nested exhibit.

use crate::exhibits::NestedBias;
use crate::output::plots::axis::Scale;
use crate::output::plots::look;
use crate::output::plots::panel::{Panel, Series};

/// Bias in per cent of F, measured, with the naive ratio's limit and a line at 0.
pub(crate) fn bias_of_paths(nested: &NestedBias, channel: usize) -> String {
    let mut all = vec![];
    for level in [0.0, 100.0 * nested.limit[channel]] {
        let mut series = Series::new(look(if level == 0.0 { "mc" } else { "naive_ratio" }));
        series.look.dash = if level == 0.0 { (1, 0) } else { (2, 4) };
        let ends = nested.curves.iter().flat_map(|curve| &curve.points).map(|point| point.draws as f64);
        series.line = ends.map(|draws| (draws, level)).collect();
        series.line.sort_by(|a, b| a.0.total_cmp(&b.0));
        series.line.dedup();
        all.push(series);
    }
    for (place, curve) in nested.curves.iter().enumerate() {
        let mut series = Series::new(look(curve.estimator));
        for point in &curve.points {
            // Side by side, for bars that would lie on top of each other.
            let draws = point.draws as f64 * (0.91 + 0.06 * place as f64);
            let (bias, two) = (100.0 * point.bias[channel], 200.0 * point.std_error[channel]);
            series.points.push((draws, bias, true));
            series.bars.push((draws, bias - two, bias + two));
        }
        series.line = series.points.iter().map(|(draws, bias, _)| (*draws, *bias)).collect();
        all.push(series);
    }
    Panel {
        title: format!("Bias against the number of paths: {}", nested.channels[channel]),
        x: ("paths N", Scale::Log),
        y: ("bias, % of F", Scale::Linear),
        floor: vec![],
        series: all,
    }
    .svg()
}
