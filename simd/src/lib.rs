//! Channels, pixels or samples side by side: SIMD lanes for `ratiocv-core`.
//!
//! # Packs or arrays?
//! `Spectrum<f32, 8>` is lanes as well: the compiler makes vectors of its loops, which it does for sums and not
//! for all of a merge, whose operations are many and of two precisions. An [`F32x8`] is vectors whatever the
//! compiler thinks. Both give the same bits. Instructions of co-moments with one auxiliary per channel and draw
//! (`add_batch`, `add`) or merge, counted by callgrind:
//!
//! | lanes | x86-64: batch | add | merge | x86-64-v3: batch | add | merge |
//! |---|---|---|---|---|---|---|
//! | `Spectrum<f32, 8>` | 4.7 | 11.1 | 143 | 2.1 | 5.7 | 92 |
//! | `F32x8` | 4.7 | 12.4 | 136 | 2.1 | 5.8 | 68 |
//! | `Spectrum<f32, 32>` | 7.5 | 13.6 | 254 | 3.2 | 5.2 | 133 |
//! | `Spectrum<F32x8, 4>` | 7.2 | 11.6 | 140 | 3.2 | 4.0 | 61 |
//!
//! A pack takes its instructions from the *build* (`-C target-cpu=x86-64-v3`); an array takes those of the function
//! that it is inlined into, so that [`at_best_level`] speeds up arrays and not packs. So: arrays for batches
//! and for builds that run anywhere; packs where draws come one by one or merges are many, channels are
//! many, and the target is known. [`gather`] makes packs of eight pixels out of interleaved RGB.
//!
//! No operation here fuses a multiplication with an addition or takes a reciprocal for a quotient. `wide`'s own
//! functions (`mul_add`, and `exp`, `ln`, `powf` by it) fuse where the target can, and are not passed on.
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
