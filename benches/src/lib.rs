//! What the speed of the accumulators is held against: kernels written by hand with intrinsics, other
//! libraries, a naive loop, and the bars that ours must clear. See `benches/README.md`.
//!
//! [`sets`] puts all that work on the same draws side by side, and compares their answers with a scalar
//! reference before anything is timed.

mod answer;
pub mod bars;
pub mod clock;
mod contender;
mod draws;
mod kernels;
pub mod sets;

pub use answer::Answer;
pub use contender::{Contender, Measured};
