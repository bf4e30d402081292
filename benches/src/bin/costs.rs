//! Runs the accumulator of one estimator over draws, to be counted by callgrind: `costs ID TIER REPEATS`,
//! TIER `value` or `error-bar`. See benches/costs.

use core::hint::black_box;
use ratiocv_core::moments::{Accumulate, GroupedPairs, Moments, Pairs};
use ratiocv_core::{
    Beale, Choose, CrossFitted, Difference, Draw, Estimator, HartleyRoss, Integrals, Jackknife, MeanOfRatios, Mickey,
    OptimalDefensive, Plain, Quenouille, RandomMixture, RatioOfMeans, Reads, RegressionRatio, Spectrum, Tin,
};

type Lanes = Spectrum<f32, 3>;

const DRAWS: usize = 4096;

/// A number that looks random enough.
fn number(i: usize, salt: usize) -> f32 {
    0.5 + ((i * 7919 + salt * 104_729) % 1000) as f32 / 1000.0
}

fn draws<const K: usize>() -> Vec<Draw<Lanes, K>> {
    let draw = |i| Draw {
        f: Spectrum(core::array::from_fn(|c| number(i, c) + number(i, 17 + c))),
        h: core::array::from_fn(|k| Spectrum(core::array::from_fn(|c| number(i, c + 3 * k)))),
    };
    (0..DRAWS).map(draw).collect()
}

/// Not inlined, so that each accumulator is compiled for itself.
#[inline(never)]
fn run<D, M: Accumulate<D>>(moments: &mut M, draws: &[D], repeats: usize) {
    for _ in 0..repeats {
        moments.add_batch(black_box(draws));
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, id, tier, repeats] = &arguments[..] else { panic!("costs ID TIER REPEATS") };
    let repeats: usize = repeats.parse().expect("REPEATS is a number");
    let mut found = false;
    macro_rules! measure {
        ($($estimator:expr, $auxiliaries:literal;)*) => {$(
            found |= measure::<_, $auxiliaries>(&$estimator, id, tier, repeats);
        )*};
    }
    measure! {
        Plain, 0; RatioOfMeans, 1; Quenouille, 1; Beale, 1; Tin, 1; Jackknife, 1; MeanOfRatios, 1; HartleyRoss, 1;
        Mickey, 1; RegressionRatio::default(), 1; Difference::default(), 1; CrossFitted(Difference::default()), 1;
        OptimalDefensive::of(RatioOfMeans), 1; OptimalDefensive::of(Mickey), 1; Choose::default(), 1;
        CrossFitted(Choose::default()), 1; RandomMixture::<RatioOfMeans>::default(), 2; RegressionRatio::default(), 2;
    }
    if id == "difference_2" {
        // The same id with two auxiliaries.
        found |= measure::<_, 2>(&Difference::default(), "difference", tier, repeats);
    }
    if id == "deterministic_mixture" {
        let pairs: Vec<_> = draws::<2>().iter().map(|draw| Pairs([draw.auxiliary(0), draw.auxiliary(1)])).collect();
        let mut moments = GroupedPairs::<Lanes, 2, 8>::default();
        run(&mut moments, &pairs, repeats);
        black_box(moments.count());
        found = true;
    }
    assert!(found, "no estimator {id}");
}

fn measure<E, const K: usize>(estimator: &E, id: &str, tier: &str, repeats: usize) -> bool
where
    E: Reads<K> + Estimator<<E::ErrorBar<Lanes> as Moments>::Channel, K>,
{
    if E::ID != id {
        return false;
    }
    let (draws, integrals) = (draws::<K>(), Integrals::ONE);
    if tier == "value" {
        let mut moments = estimator.value(&integrals);
        run(&mut moments, &draws, repeats);
        black_box(moments.count());
    } else {
        let mut moments = estimator.error_bar(&integrals);
        run(&mut moments, &draws, repeats);
        black_box(estimator.estimate_anyway(&moments, &integrals).value);
    }
    true
}
