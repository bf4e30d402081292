//! Channels, pixels or samples side by side: SIMD lanes for `ratiocv-core`.
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

pub mod functions;
mod interleaved;
mod level;
mod mask;
mod packs;
mod xoshiro16;

pub use interleaved::{gather, scatter};
pub use level::{Level, Work, add_batch, at_best_level};
pub use mask::Mask;
pub use packs::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};
pub use xoshiro16::Xoshiro16;
