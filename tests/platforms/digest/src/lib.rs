//! What every platform computes and prints: the bits must be the same everywhere.
#![no_std]
#![forbid(unsafe_code)]

mod estimators;
mod fed;
mod hash;
mod hostile;
mod kernels;
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

use fed::Lines;
use ratiocv_core::{Spectrum, fp_environment};

/// Shows all lines: what, which, and 64 bits, the same on every platform. `regrouped` merges by another tree, which
/// a comparison must notice.
pub fn all(regrouped: bool, each: &mut dyn FnMut(&str, &str, u64)) {
    each("environment", "sound", u64::from(fp_environment().is_sound()));
    picture::all(each);
    let lines = &mut Lines { each, regrouped };
    if estimators::all::<Spectrum<f32, 3>>(lines, "f32x3").is_err() {
        (lines.each)("no", "estimators", 0);
    }
    kernels::all::<f64>(lines, "f64");
    kernels::all::<Spectrum<f32, 16>>(lines, "f32x16");
    kernels::comoments::<Spectrum<f32, 4>>(lines, "f32x4");
    kernels::comoments::<Spectrum<f32, 8>>(lines, "f32x8");
    kernels::comoments::<Spectrum<f64, 4>>(lines, "f64x4");
}

/// Those lines of [`all`] that packs of SIMD lanes can make in the place of arrays, made so.
#[cfg(feature = "packs")]
pub fn packs(each: &mut dyn FnMut(&str, &str, u64)) {
    use ratiocv_simd::{F32x4, F32x8, F32x16, F64x4};
    let lines = &mut Lines { each, regrouped: false };
    kernels::all::<F32x16>(lines, "f32x16");
    kernels::comoments::<F32x4>(lines, "f32x4");
    kernels::comoments::<F32x8>(lines, "f32x8");
    kernels::comoments::<F64x4>(lines, "f64x4");
}
