//! Integrand, auxiliary and proposal as objects, for those who have functions rather than draws.

mod auxiliary;
mod integrand;
mod integrate;
mod proposal;

pub use auxiliary::{Auxiliaries, Auxiliary, WithIntegral};
pub use integrand::Integrand;
pub use integrate::Problem;
pub use proposal::{Proposal, Uniform, UniformCube, unit_interval};
