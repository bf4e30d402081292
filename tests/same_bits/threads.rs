//! The same bits from any number of threads, on packs as on arrays.

use ratiocv_core::{
    Defensive, Flags, HartleyRoss, Lanes, Mickey, Problem, Reads, Scalar, Spectrum, Tin, Uniform, WithIntegral,
};
use ratiocv_simd::{F32x4, F32x8, F32x16, F64x4, F64x8};
use ratiocv_threads::integrate;

/// Value, error and flags of each channel of three estimates on `threads` threads.
fn estimates<V: Lanes>(threads: usize) -> Vec<(u64, u64, Flags)> {
    let number = |x: f64| V::Scalar::from_f64(x);
    let problem = Problem::new(move |x: &f64| V::from_fn(|i| number(x * x + i as f64 / (0.1 + x))))
        .auxiliary(WithIntegral::new(
            move |x: &f64| V::from_fn(|i| number(x + i as f64)),
            V::Wide::from_fn(|i| 0.5 + i as f64),
        ))
        .proposal(Uniform);
    let draws = 20_011; // no multiple of a chunk or of a block
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool.install(|| {
        let mickey: Defensive<Mickey> = Mickey.defensive(0.01).unwrap();
        let all = [
            integrate(&problem, &mickey, draws, 7).unwrap(),
            integrate(&problem, &HartleyRoss, draws, 7).unwrap(),
            integrate(&problem, &Tin, draws, 7).unwrap(),
        ];
        let channels = |i: usize| all.map(|estimate| estimate.channel(i));
        (0..V::LANES).flat_map(channels).map(|c| (c.value.to_bits(), c.std_error.to_bits(), c.flags)).collect()
    })
}

#[test]
fn sixteen_channels_are_the_same_on_any_lanes_and_threads() {
    let one = estimates::<Spectrum<f32, 16>>(1);
    for threads in [1, 2, 3, 5, 8] {
        assert_eq!(estimates::<Spectrum<f32, 16>>(threads), one, "arrays, {threads} threads");
        assert_eq!(estimates::<Spectrum<F32x4, 4>>(threads), one, "packs of 4, {threads} threads");
        assert_eq!(estimates::<Spectrum<F32x8, 2>>(threads), one, "packs of 8, {threads} threads");
        assert_eq!(estimates::<F32x16>(threads), one, "packs of 16, {threads} threads");
    }
}

#[test]
fn eight_channels_in_double_are_the_same_on_any_lanes_and_threads() {
    let one = estimates::<Spectrum<f64, 8>>(1);
    for threads in [1, 2, 3, 5, 8] {
        assert_eq!(estimates::<Spectrum<f64, 8>>(threads), one, "arrays, {threads} threads");
        assert_eq!(estimates::<Spectrum<F64x4, 2>>(threads), one, "packs of 4, {threads} threads");
        assert_eq!(estimates::<F64x8>(threads), one, "packs of 8, {threads} threads");
    }
}
