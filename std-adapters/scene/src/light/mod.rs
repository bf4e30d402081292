//! Lights, and which of them to sample.

mod choice;
mod choices;
mod emitter;
mod lamps;
mod towards;

pub(crate) use choice::{Facing, Lights, Weights};
pub use choice::{LightChoice, Mixture};
pub(crate) use choices::Choices;
pub(crate) use emitter::Emitter;
pub(crate) use towards::Directions;
