//! Error, bias and run time of every estimator on every problem.

mod clock;
mod compare;
mod coverage;
#[cfg(test)]
mod every_estimator;
mod options;
mod plan;
mod progress;
mod replicates;
mod report;
mod run;
mod tally;
mod theory;

pub use compare::{Equal, Versus};
pub use coverage::Coverage;
pub use options::{Error, Options};
pub use progress::Progress;
pub(crate) use replicates::cell_seed;
pub use report::{ChannelPoint, Figures, MethodReport, Point, ProblemReport, Report, Seconds, Theory};
pub use run::run;
