//! Laws of the readers of files, one file each: whatever the bytes, an answer or an error, never a panic.
//!
//! A package of their own, since these need every adapter, and the laws of `ratiocv-hostile` none.

mod checkpoint;
mod csv;
mod scene;

pub use checkpoint::checkpoint;
pub use csv::csv;
pub use scene::scene;
