//! Channels, pixels or samples side by side: SIMD lanes for `ratiocv-core`.
//!
//! # Packs or arrays?
//! `Spectrum<f32, 16>` is lanes as well, and the compiler vectorises its loops, if it is in the mood: it gives up
//! on merges, whose operations are many and of two precisions, before it gives up on sums. A pack is vectors
//! whatever the compiler thinks. Both give the same bits. Instructions of co-moments with one auxiliary, per
//! draw and channel (per merge and channel in brackets):
//!
//! | 8 channels | x86-64 | x86-64-v3 |
//! |---|---|---|
//! | `Spectrum<f32, 8>` | 9.7 (170) | 3.6 (116) |
//! | `F32x8` | 10.5 (175) | 3.0 (69) |
//!
//! | 32 channels | x86-64 | x86-64-v3 |
//! |---|---|---|
//! | `Spectrum<f32, 32>` | 15.3 (336) | 7.4 (179) |
//! | `Spectrum<F32x8, 4>` | 12.5 (257) | 4.5 (102) |
//!
//! A pack is as fast as the instructions of the *build*: without `-C target-cpu=x86-64-v3` (or `native`) an
//! [`F32x8`] is two registers of SSE2, and an array is as good. So: packs where the target is known and pixels or
//! wavelengths come in fours, eights or sixteens; arrays for RGB pixel by pixel and for builds that run anywhere.
//! [`gather`] makes packs of eight pixels out of interleaved RGB.
//!
//! No operation here fuses a multiplication with an addition or takes a reciprocal for a quotient. `wide`'s own
//! functions beyond those of [`Lanes`](ratiocv_core::Lanes) (`mul_add`, `exp`, `ln`, `powf`) do, depending on the
//! target, and are not passed on.
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
