//! Scenes and a small path tracer that yields f and auxiliaries h with E\[h\] = 1, per path depth and
//! technique, so that every estimator of `ratiocv-core` runs on its pixels.
//!
//! - [`Description`]: a scene as it was read; plain data.

mod description;

pub use description::{
    Camera, Description, Filter, Geometry, Light, Material, Medium, Mesh, Roughness, Shape, Surface,
};
