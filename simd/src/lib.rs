//! Channels, pixels or samples side by side: SIMD lanes for `ratiocv-core`.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

pub mod functions;
mod level;
mod xoshiro16;

pub use level::{Level, Work, add_batch, at_best_level};
pub use xoshiro16::Xoshiro16;
