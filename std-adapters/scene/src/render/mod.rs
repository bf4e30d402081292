//! Images: estimators on pixels, and the loop over them.

mod error;
mod frame;
mod image;
mod kept;
mod method;
mod output;
mod pixel;
mod run;
mod work;

pub use error::RenderError;
pub use frame::Frame;
pub use image::Image;
pub use method::{Method, OnPixel, Visitor};
pub use output::{Layer, Written, write};
pub use pixel::{Pixel, PixelEstimate};
pub use run::{Budget, Render, Rendered, Stopped};
