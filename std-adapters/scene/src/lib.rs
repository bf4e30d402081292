//! Scenes and a small path tracer that yields f and auxiliaries h with E\[h\] = 1, per path depth and
//! technique, so that every estimator of `ratiocv-core` runs on its pixels.
//!
//! - [`Description`]: a scene as it was read; plain data.
//! - [`Description::read`]: Mitsuba 3 scene files; [`BuiltIn`]: those that come with the crate.

mod description;
mod input;
mod planted;

pub use description::{
    Camera, Description, Filter, Geometry, Light, Material, Medium, Mesh, Roughness, Shape, Surface,
};
pub use input::{BuiltIn, Error, Leniency, Warning};
