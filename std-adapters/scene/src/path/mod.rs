//! Paths: what they yield, and the kernels that trace them.

mod direct;
mod kernel;
mod kernels;
mod pairs;
mod record;
mod samples;
mod terms;
mod vertex;

pub(crate) use kernel::Block;
pub(crate) use kernels::{Kernel, Traced};
pub use samples::{BLOCK, Samples};
pub(crate) use terms::Terms;
pub use terms::{Technique, Term};
