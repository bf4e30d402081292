//! Runs the accumulators of each estimator, each inside a call of `counted` for callgrind to count, and prints
//! what was run, its bytes, and the draws that the call goes through. See benches/costs.

#[cfg(not(feature = "plain-alone"))]
mod by_hand;
#[cfg(not(feature = "plain-alone"))]
mod others;

use core::hint::black_box;
use ratiocv_core::moments::{Accumulate, Moments};
use ratiocv_core::{Draw, Estimator, Integrals, Lanes, Plain, Reads, Scalar, Spectrum};

/// Draws of a batch.
const DRAWS: usize = 4096;
/// Draws that a scene-like caller adds to each pixel, one by one, before it asks for the estimate.
const SAMPLES: usize = 64;

/// A number that looks random enough.
fn number(i: usize, salt: usize) -> f64 {
    0.5 + ((i * 7919 + salt * 104_729) % 1000) as f64 / 1000.0
}

fn draws<V: Lanes, const K: usize>() -> Vec<Draw<V, K>> {
    let lanes = |of: &dyn Fn(usize) -> f64| V::from_fn(|channel| V::Scalar::from_f64(of(channel)));
    let draw = |i| Draw {
        f: lanes(&|channel| number(i, channel) + number(i, 17 + channel)),
        h: core::array::from_fn(|k| lanes(&|channel| number(i, channel + 3 * k))),
    };
    (0..DRAWS).map(draw).collect()
}

#[inline(never)]
fn counted(run: &mut dyn FnMut()) {
    run();
}

/// Not inlined, so that each accumulator is compiled for itself.
#[inline(never)]
fn batch<D, M: Accumulate<D>>(moments: &mut M, draws: &[D]) {
    moments.add_batch(black_box(draws));
}

#[inline(never)]
fn one_by_one<D: Copy, M: Accumulate<D>>(moments: &mut M, draws: &[D]) {
    for draw in black_box(draws) {
        moments.add(*draw);
    }
}

/// A line: what, channels, tier, caller, bytes, draws.
fn line(id: &str, channels: usize, tier: &str, caller: &str, bytes: usize) {
    println!("{id} {channels} {tier} {caller} {bytes} {DRAWS}");
}

fn measure_tier<E, V, M, const K: usize>(estimator: &E, id: &str, tier: &str, empty: M)
where
    V: Lanes,
    M: Accumulate<Draw<V, K>> + Moments<Lanes = V> + Copy,
    E: Estimator<M::Channel, K>,
{
    let draws = draws::<V, K>();
    let mut moments = empty;
    // The first draws make blocks of their own; what is counted is what goes on.
    batch(&mut moments, &draws);
    counted(&mut || batch(&mut moments, &draws));
    black_box(moments.count());
    line(id, V::LANES, tier, "batch", size_of::<M>());
    counted(&mut || {
        for samples in draws.chunks(SAMPLES) {
            let mut pixel = empty;
            one_by_one(&mut pixel, samples);
            black_box(estimator.estimate_anyway(&pixel, &Integrals::ONE).value);
        }
    });
    line(id, V::LANES, tier, "scene", size_of::<M>());
}

/// On one channel, on RGB and on 32 wavelengths.
fn measure<E, const K: usize>(estimator: &E, id: &str)
where
    E: Reads<K>
        + Estimator<<E::ErrorBar<f32> as Moments>::Channel, K>
        + Estimator<<E::Value<f32> as Moments>::Channel, K>
        + Estimator<<E::ErrorBar<Rgb> as Moments>::Channel, K>
        + Estimator<<E::Value<Rgb> as Moments>::Channel, K>
        + Estimator<<E::ErrorBar<Wavelengths> as Moments>::Channel, K>
        + Estimator<<E::Value<Wavelengths> as Moments>::Channel, K>,
{
    macro_rules! on {
        ($($lanes:ty),*) => {$(
            measure_tier::<_, $lanes, _, K>(estimator, id, "value", estimator.value(&Integrals::ONE));
            measure_tier::<_, $lanes, _, K>(estimator, id, "error-bar", estimator.error_bar(&Integrals::ONE));
        )*};
    }
    on!(f32, Rgb, Wavelengths);
}

type Rgb = Spectrum<f32, 3>;
type Wavelengths = Spectrum<f32, 32>;

fn main() {
    // The first alone, so that the rest can be left out of the program: what it costs cannot depend on it.
    measure::<_, 0>(&Plain, "mc");
    #[cfg(not(feature = "plain-alone"))]
    others::measure_all();
}
