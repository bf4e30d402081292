//! Scenes and a small path tracer that yields f and auxiliaries h with E\[h\] = 1, per path depth and
//! technique, so that every estimator of `ratiocv-core` runs on its pixels.
//!
//! - [`Description`]: a scene as it was read; plain data.
//! - [`Description::read`]: Mitsuba 3 scene files; [`BuiltIn`]: those that come with the crate.
//! - [`Needs`]: what it needs; what it does not is left out.
//! - [`Scene`]: it prepared, with the kernel that traces its paths.
//! - [`Samples`]: what comes of them, f and h of each [`Term`].
//!
//! Geometry is `f32` in [`glam::Vec3`], whose arithmetic is plain scalar code on every platform, and square roots are
//! correctly rounded on every platform (IEEE 754), so that `std`'s are; of other functions there are our own, in
//! additions and multiplications.

mod camera;
mod colour;
mod description;
mod error;
mod frame;
mod geometry;
mod input;
mod lanes;
mod light;
mod material;
mod medium;
mod needs;
mod path;
mod planted;
mod random;
mod render;
mod scene;

pub use colour::Colour;
pub use description::{
    Camera, Description, Filter, Geometry, Light, Material, Medium, Mesh, Roughness, Shape, Surface,
};
pub use error::SceneError;
pub use input::{BuiltIn, Error, Leniency, Warning};
pub use light::{LightChoice, Mixture};
pub use needs::{Needs, Options};
pub use path::{BLOCK, Samples, Technique, Term};
pub use render::{
    Budget, Frame, Image, Layer, Method, OnPixel, Pixel, PixelEstimate, Render, RenderError, Rendered, Stopped,
    Visitor, Written, write,
};
pub use scene::Scene;
