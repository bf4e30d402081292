//! The functions of the exhibit of two techniques.

use crate::exhibits::TwoTechniquesMse;
use crate::output::plots::axis::Scale;
use crate::output::plots::panel::{Panel, Series};
use crate::output::plots::style::{BLACK, BLUE, Look, Mark, VERMILLION};
use crate::output::plots::swatch;

/// How each function is drawn, and what it is called.
fn looks() -> [(Look, &'static str); 5] {
    let look = |colour, dash| Look { colour, dash, mark: Mark::None };
    [
        (look(BLACK, (1, 0)), "f/F"),
        (look(BLUE, (7, 4)), "h₁"),
        (look(VERMILLION, (7, 4)), "h₂"),
        (look(BLUE, (2, 3)), "g₁"),
        (look(VERMILLION, (2, 3)), "g₂"),
    ]
}

/// f/F, the auxiliaries and the densities of the techniques.
pub(crate) fn techniques(exhibit: &TwoTechniquesMse) -> String {
    let curve = |index: usize, look: Look| {
        let unit = if index == 0 { exhibit.f_integral } else { 1.0 };
        let mut series = Series::new(look);
        series.line = exhibit.curves.iter().map(|at| (at[0], at[index + 1] / unit)).collect();
        series
    };
    Panel {
        title: "Integrand, auxiliaries and techniques".into(),
        x: ("x", Scale::Linear),
        y: ("f/F, h, g", Scale::Linear),
        floor: vec![],
        series: looks().into_iter().enumerate().map(|(index, (look, _))| curve(index, look)).collect(),
    }
    .svg()
}

/// Pairs of a swatch and a name.
pub(crate) fn techniques_legend() -> Vec<(String, &'static str)> {
    looks().map(|(look, name)| (swatch(look), name)).into()
}
