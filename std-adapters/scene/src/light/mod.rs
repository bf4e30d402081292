//! Lights, and which of them to sample.

mod choice;
mod choices;
mod emitter;
mod lamps;

pub(crate) use choice::{Chosen, Facing, Lights, Weights};
pub use choice::{LightChoice, Mixture};
pub(crate) use emitter::{Directions, Emitter};
