//! What an expert writes for x86-64 with intrinsics; separate multiplications and additions, no FMA.
//!
//! Each has a `new` that gives `None` where the CPU lacks what it needs, so that a value of the type is
//! the proof that its kernels may be called.

mod avx2;
mod avx512;
mod comoments;
mod divider;
mod raw_sums;
mod sse2;
mod state;

pub(crate) use avx2::{Avx2, BareAvx2};
pub(crate) use avx512::{Avx512, BareAvx512};
pub(crate) use divider::Divider;
pub(crate) use raw_sums::RawSums;
pub(crate) use sse2::NaiveSse2;
