//! The integrands themselves.

use crate::ProblemReport;
use crate::output::plots::axis::Scale;
use crate::output::plots::panel::{Panel, Series};
use crate::output::plots::style::{BLUE, GREEN, GREY, Look, Mark, VERMILLION};
use crate::output::plots::swatch;
use crate::problems::{Curve, Role};

fn look(curve: &Curve) -> Look {
    let Curve { role, group, .. } = *curve;
    let colour = match role {
        Role::Proposal => GREY,
        // With one channel, colours are free to tell f from h.
        Role::Auxiliary if curve.channel.is_empty() => BLUE,
        _ => [VERMILLION, GREEN, BLUE][group % 3],
    };
    let dash = match role {
        Role::Integrand => (1, 0),
        Role::Auxiliary => (7, 4),
        Role::Proposal => (2, 3),
    };
    Look { colour, dash, mark: Mark::None }
}

/// f/F and h/H, and the sampling density where it is not uniform.
pub(crate) fn functions(problem: &ProblemReport) -> String {
    let (axis, curves) = problem.problem.curves();
    let series = curves.into_iter().map(|curve| Series {
        look: look(&curve),
        line: curve.points,
        points: vec![],
        band: vec![],
        bars: vec![],
    });
    Panel {
        title: format!("Integrand and auxiliary: {}", problem.problem.title()),
        x: (axis, Scale::Linear),
        y: ("f/F, h/H", Scale::Linear),
        floor: vec![],
        series: series.collect(),
    }
    .svg()
}

/// What the curves of a problem are: pairs of a swatch and a name.
pub(crate) fn legend(problem: &ProblemReport) -> Vec<(String, String)> {
    let (_, curves) = problem.problem.curves();
    let name = |role, channel: &str| match role {
        Role::Integrand => format!("f/F {channel}"),
        Role::Auxiliary => format!("h/H {channel}"),
        Role::Proposal => "g, the density of the draws".into(),
    };
    curves.iter().map(|curve| (swatch(look(curve)), name(curve.role, &curve.channel))).collect()
}
