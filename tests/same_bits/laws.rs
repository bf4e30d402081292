//! The laws of accumulators on packs, and on no channel at all; `laws` (beside this) has them on arrays.

use crate::moments::{Everything, Recipe};
use ratiocv_core::conformance::all;
use ratiocv_core::moments::{Accumulate, Comoments, Merge, Moments};
use ratiocv_core::{Draw, Estimator, HartleyRoss, Integrals, Lanes, Spectrum, Tin};
use ratiocv_simd::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};
use ratiocv_tests::samples::Noise;

/// Draws with h in [½, 1½) and f between ¾h and 1¼h: no sum cancels.
fn draws<V: Lanes>() -> Vec<Draw<V>> {
    Noise(11).draws(300)
}

/// All laws, where a split may move an estimate by `tolerance`.
fn obeys<V: Lanes>(tolerance: f64) {
    let integrals = Integrals::ONE;
    assert_eq!(all(&Tin, |_| Comoments::<V>::default(), &draws(), &integrals, tolerance), Ok(()));
}

#[test]
fn packs_obey_the_laws() {
    // Eight units of the last place, and as much again for Tin's correction.
    let (single, double) = (16.0 * f64::from(f32::EPSILON), 16.0 * f64::EPSILON);
    obeys::<F32x4>(single);
    obeys::<F32x8>(single);
    obeys::<F32x16>(single);
    obeys::<Spectrum<F32x8, 3>>(single);
    obeys::<F64x2>(double);
    obeys::<F64x4>(double);
    obeys::<F64x8>(double);
}

#[test]
fn all_moments_at_once_obey_the_laws() {
    let tolerance = 16.0 * f64::from(f32::EPSILON);
    let empty = |integrals: &Integrals<F32x8>| Everything::empty(integrals);
    assert_eq!(all(&HartleyRoss, empty, &draws(), &Integrals::ONE, tolerance), Ok(()));
}

#[test]
fn no_channel_at_all_is_lawful() {
    obeys::<Spectrum<f32, 0>>(0.0);
    obeys::<Spectrum<F64x4, 0>>(0.0);
    let mut nothing = Comoments::<Spectrum<f32, 0>>::default();
    nothing.add_batch(&[Draw::ZERO; 100]);
    nothing.merge(&nothing.clone());
    assert_eq!(nothing.count(), 200);
    assert!(Tin.estimate(&nothing, &Integrals::ONE).unwrap().strict().is_ok());
}
