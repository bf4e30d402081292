//! Error against run time, for problems whose integrals are known exactly.

pub mod catalogue;
mod measure;
mod output;
pub mod problems;
mod provenance;

pub use measure::{
    ChannelPoint, Equal, Error, Figures, MethodReport, Options, Point, ProblemReport, Progress, Report, Seconds,
    Theory, Versus, run,
};
pub use provenance::Provenance;
