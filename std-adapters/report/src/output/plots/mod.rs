//! The figures of the page, one panel per problem.

mod axis;
mod bias;
mod error;
mod functions;
mod panel;
mod paths;
mod scene;
mod style;
mod techniques;
mod theory;

pub(super) use bias::bias;
pub(super) use error::error;
pub(super) use functions::{functions, legend as functions_legend};
pub(super) use paths::bias_of_paths;
pub(super) use scene::{drawn, scene_error};
pub(super) use style::{look, swatch};
pub(super) use techniques::{techniques, techniques_legend};
pub(super) use theory::theory;

use crate::{MethodReport, ProblemReport};

/// The measured estimators among `ids`, in that order.
fn chosen<'a>(problem: &'a ProblemReport, ids: &'a [&str]) -> impl Iterator<Item = &'a MethodReport> {
    ids.iter().filter_map(|id| problem.methods.iter().find(|method| method.method.id() == *id))
}

/// An RMSE that rounding explains is not drawn.
const EXACT: f64 = 1e-12;
