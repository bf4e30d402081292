//! Lights, and which of them to sample.

mod choice;
mod choices;
mod emitter;
mod lamps;

pub(crate) use choice::{Facing, Lights, Weights};
pub use choice::{LightChoice, Mixture};
pub(crate) use emitter::Emitter;
