//! Lights, and which of them to sample.

mod choice;
mod emitter;

pub(crate) use choice::{Facing, Lights, Weights};
pub use choice::{LightChoice, Mixture};
pub(crate) use emitter::Emitter;
