//! What every platform computes and prints: the bits must be the same everywhere.
#![no_std]
#![forbid(unsafe_code)]

mod estimators;
mod hash;
mod hostile;
mod output;
mod picture;
#[allow(
    missing_docs,
    missing_debug_implementations,
    dead_code,
    unreachable_pub,
    reason = "the core's example as it is"
)]
#[path = "../../../../core/examples/renderer/render.rs"]
mod render;
#[allow(
    missing_docs,
    missing_debug_implementations,
    dead_code,
    unreachable_pub,
    reason = "the core's example as it is"
)]
#[path = "../../../../core/examples/renderer/scene.rs"]
mod scene;

pub use output::hex;

use ratiocv_core::{Spectrum, fp_environment};
use ratiocv_simd::F32x4;

/// Shows all lines: what, which, and 64 bits, the same on every platform.
pub fn all(each: &mut dyn FnMut(&str, &str, u64)) {
    each("environment", "sound", u64::from(fp_environment().is_sound()));
    picture::all(each);
    estimators::all::<Spectrum<f32, 16>>("f32x16", each);
    estimators::all::<f64>("f64", each);
}

/// Those lines of [`all`] that packs of SIMD lanes can make in the place of arrays, made so.
pub fn packs(each: &mut dyn FnMut(&str, &str, u64)) {
    estimators::all::<Spectrum<F32x4, 4>>("f32x16", each);
}
