//! Runs the accumulators of each estimator, each inside a call of `counted` for callgrind to count, and prints
//! what was run, its bytes, and the draws that the call goes through. See benches/costs.

mod by_hand;

use by_hand::PlainByHand;
use core::hint::black_box;
use ratiocv_core::moments::{Accumulate, GroupedPairs, Moments, Pairs};
use ratiocv_core::{
    Beale, Choose, CrossFitted, Difference, Draw, Estimator, HartleyRoss, Integrals, Jackknife, Lanes, MeanOfRatios,
    Mickey, OptimalDefensive, Plain, Quenouille, RandomMixture, RatioOfMeans, Reads, RegressionRatio, Scalar, Spectrum,
    Tin,
};

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

fn measure_pairs<V: Lanes>() {
    let pairs: Vec<_> = draws::<V, 2>().iter().map(|draw| Pairs([draw.auxiliary(0), draw.auxiliary(1)])).collect();
    let mut moments = GroupedPairs::<V, 2, 8>::default();
    batch(&mut moments, &pairs);
    counted(&mut || batch(&mut moments, &pairs));
    black_box(moments.count());
    line("deterministic_mixture", V::LANES, "error-bar", "batch", size_of::<GroupedPairs<V, 2, 8>>());
}

fn measure_by_hand<const M: usize>() {
    let draws: Vec<[f32; M]> = draws::<Spectrum<f32, M>, 0>().iter().map(|draw| draw.f.0).collect();
    let mut moments = PlainByHand::<M>::EMPTY;
    moments.add_batch(black_box(&draws));
    counted(&mut || moments.add_batch(black_box(&draws)));
    let bytes = size_of_val(black_box(&moments));
    line("plain_by_hand", M, "value", "batch", bytes);
}

fn main() {
    // The first alone, so that the rest is left out of the program: what it costs cannot depend on it.
    measure::<_, 0>(&Plain, "mc");
    #[cfg(not(feature = "plain-alone"))]
    {
        measure_by_hand::<32>();
        measure::<_, 1>(&RatioOfMeans, "ratio");
        measure::<_, 1>(&Quenouille, "quenouille");
        measure::<_, 1>(&Beale, "beale");
        measure::<_, 1>(&Tin, "tin");
        measure::<_, 1>(&Jackknife, "jackknife");
        measure::<_, 1>(&MeanOfRatios, "mean_of_ratios");
        measure::<_, 1>(&HartleyRoss, "hartley_ross");
        measure::<_, 1>(&Mickey, "mickey");
        measure::<_, 1>(&RegressionRatio::default(), "regression_ratio");
        measure::<_, 1>(&Difference::default(), "difference");
        measure::<_, 2>(&Difference::default(), "difference_2");
        measure::<_, 1>(&CrossFitted(Difference::default()), "cross_fitted_difference");
        measure::<_, 1>(&OptimalDefensive::of(RatioOfMeans), "optimal_defensive_ratio");
        measure::<_, 1>(&OptimalDefensive::of(Mickey), "optimal_defensive_mickey");
        measure::<_, 1>(&Choose::default(), "choose");
        measure::<_, 1>(&CrossFitted(Choose::default()), "choose_unbiased");
        measure::<_, 2>(&RandomMixture::<RatioOfMeans>::default(), "random_mixture_2");
        measure_pairs::<Rgb>();
    }
}
