//! Hostile draws through every accumulator and estimator.

use crate::hash::Hash;
use crate::hostile::{KINDS, draw};
use ratiocv_core::moments::{
    Accumulate, Blocked, Comoments, ComomentsBlock, Extremes, ExtremesBlock, GroupedPairs, Groups, Joined, Merge,
    Moments, Pairs, Save, Sums, Third, Widened,
};
use ratiocv_core::{
    Beale, Choose, CrossFitted, DeterministicMixture, Difference, Draw, EstimatedIntegrals, Estimator, FallBackWhenIll,
    HartleyRoss, Integrals, Jackknife, Lanes, MeanOfRatios, Mickey, OptimalDefensive, PathProduct, Plain, Quenouille,
    RandomMixture, RatioOfIntegrals, RatioOfMeans, Reads, RegressionRatio, ScaledSums, Tin,
};

/// Draws by themselves, and in a batch: more than a run of 64, with a rest.
const ALONE: usize = 70;
const BATCH: usize = 203;

/// One draw, and many. Out of line, as is [`fed`]: compiled once for each accumulator, not wherever it is called.
#[inline(never)]
fn add<D, M: Accumulate<D>>(moments: &mut M, draw: D) {
    moments.add(draw);
}

#[inline(never)]
fn add_batch<D, M: Accumulate<D>>(moments: &mut M, draws: &[D]) {
    moments.add_batch(draws);
}

/// The moments of the same draws by themselves, in batches and merged; `seen` looks at every stage.
#[inline(never)]
fn fed<D: Copy, M: Accumulate<D> + Merge + Copy>(empty: M, draw: &dyn Fn(usize) -> D, seen: &mut dyn FnMut(&M)) -> M {
    let mut moments = empty;
    seen(&moments);
    for i in 0..ALONE {
        add(&mut moments, draw(i));
        if i < 3 || i == 64 {
            seen(&moments);
        }
    }
    seen(&moments);
    let batch: [D; BATCH] = core::array::from_fn(|i| draw(ALONE + i));
    let mut later = empty;
    add_batch(&mut later, &batch);
    seen(&later);
    moments.merge(&later);
    seen(&moments);
    add_batch(&mut moments, &core::array::from_fn::<D, BATCH, _>(|i| draw(ALONE + BATCH + i)));
    seen(&moments);
    moments
}

/// A hash of everything that `estimator` says of everything that `empty` saw, and of what was kept.
#[inline(never)]
fn hashed<V: Lanes, D: Copy, M, E, const K: usize>(
    empty: M,
    estimator: &E,
    integrals: &Integrals<V, K>,
    draw: &dyn Fn(usize, usize) -> D,
) -> u64
where
    M: Accumulate<D> + Merge + Moments<Lanes = V> + Save + Copy,
    E: Estimator<M::Channel, K>,
{
    let mut hash = Hash::EMPTY;
    for first in (0..KINDS).step_by(V::LANES) {
        let mut moments = fed(empty, &|i| draw(first, i), &mut |moments| {
            hash.estimate(&estimator.estimate_anyway(moments, integrals))
        });
        moments.words(&mut |word| hash.word(*word));
    }
    hash.0
}

/// A hash of what an accumulator keeps that no estimator reads.
#[inline(never)]
fn kept<V: Lanes, M: Accumulate<Draw<V>> + Merge + Save + Copy>(empty: M) -> u64 {
    let mut hash = Hash::EMPTY;
    for first in (0..KINDS).step_by(V::LANES) {
        fed(empty, &|i| draw(first, i), &mut |_| ()).words(&mut |word| hash.word(*word));
    }
    hash.0
}

/// Shows a hash for each estimator and each kind of moments, on lanes `V`, whose name is `lanes`.
pub(crate) fn all<V: Lanes>(lanes: &str, each: &mut dyn FnMut(&str, &str, u64)) {
    let one = Integrals::<V>::ONE;
    let two = Integrals::<V, 2>::new([V::Wide::ONE, V::Wide::from_fn(|_| -0.5)]);
    macro_rules! show {
        ($($name:literal: $estimator:expr, $moments:expr, $integrals:expr;)*) => {
            $(each(lanes, $name, hashed(closed($moments), &$estimator, &$integrals, &draw));)*
        };
    }
    /// Only to say what type it is.
    fn closed<M>(moments: M) -> M {
        moments
    }
    show! {
        "mc": Plain, Comoments::<V>::default(), one;
        "mc value": Plain, Sums::<V>::default(), one;
        "ratio": RatioOfMeans, RatioOfMeans.error_bar(&one), one;
        "ratio value": RatioOfMeans, RatioOfMeans.value(&one), one;
        "quenouille": Quenouille, Quenouille.error_bar(&one), one;
        "beale": Beale, Beale.error_bar(&one), one;
        "tin": Tin, Tin.error_bar(&one), one;
        "jackknife": Jackknife, Jackknife.error_bar(&one), one;
        "mean_of_ratios": MeanOfRatios, MeanOfRatios.error_bar(&one), one;
        "hartley_ross": HartleyRoss, HartleyRoss.error_bar(&one), one;
        "hartley_ross value": HartleyRoss, HartleyRoss.value(&one), one;
        "mickey": Mickey, Mickey.error_bar(&one), one;
        "mickey value": Mickey, Mickey.value(&one), one;
        "regression_ratio": RegressionRatio::default(), Comoments::<V>::default(), one;
        "difference": Difference::default(), Comoments::<V>::default(), one;
        "difference_2": Difference::default(), Comoments::<V, 2>::default(), two;
        "optimal_defensive_ratio": <OptimalDefensive>::default(), Comoments::<V>::default(), one;
        "optimal_defensive_mickey": OptimalDefensive::of(Mickey), OptimalDefensive::of(Mickey).error_bar(&one), one;
        "cross_fitted_difference": CrossFitted(Difference::default()), CrossFitted(Difference::default()).error_bar(&one), one;
        "choose": Choose::default(), Comoments::<V>::default(), one;
        "choose_unbiased": CrossFitted(Choose::default()), CrossFitted(Choose::default()).error_bar(&one), one;
        "random_mixture_2": <RandomMixture>::default(), Comoments::<V, 2>::default(), two;
        "ratio_of_integrals": RatioOfIntegrals, Comoments::<V, 2>::default(), two;
        "fall_back": FallBackWhenIll(RatioOfMeans), Comoments::<V>::default(), one;
        "estimated_integrals": EstimatedIntegrals { estimator: Difference::default(), std_errors: [V::Wide::ONE] },
            Comoments::<V>::default(), one;
        "tails": RatioOfMeans, Blocked::<V, Joined<ComomentsBlock<V>, (), (), ExtremesBlock<V>>>::default(), one;
        "widened": Tin, Widened::<V, Comoments<V::Wide>>::default(), Integrals::<V::Wide>::ONE;
    }
    macro_rules! show_defensive {
        ($($name:literal: $estimator:expr;)*) => {$(
            if let Ok(estimator) = $estimator.defensive(0.01) {
                each(lanes, $name, hashed(estimator.error_bar(&one), &estimator, &one, &draw));
            }
        )*};
    }
    show_defensive! {
        "defensive_ratio": RatioOfMeans;
        "defensive_beale": Beale;
        "defensive_tin": Tin;
        "defensive_jackknife": Jackknife;
        "defensive_mean_of_ratios": MeanOfRatios;
        "defensive_hartley_ross": HartleyRoss;
        "defensive_mickey": Mickey;
    }
    let pairs = |first, i: usize| Pairs([draw(first, 2 * i), draw(first, 2 * i + 1)]);
    let groups = GroupedPairs::<V, 2, 8>::default();
    each(lanes, "deterministic_mixture", hashed(groups, &DeterministicMixture, &two, &pairs));
    each(lanes, "third", kept(Third::<V>::default()));
    each(lanes, "extremes", kept(Extremes::<V>::default()));
    each(lanes, "groups", kept(Groups::<V, 3>::default()));
    each(lanes, "paths", paths::<V>());
}

/// Paths of five steps.
fn paths<V: Lanes>() -> u64 {
    let mut hash = Hash::EMPTY;
    for first in (0..KINDS).step_by(V::LANES) {
        let path = |i: usize| {
            let mut path = PathProduct::<V>::default();
            (0..5).for_each(|d| path.extend(draw(first, 5 * i + d), &Integrals::ONE));
            path
        };
        fed(ScaledSums::<V>::default(), &path, &mut |sums| hash.estimate(&sums.ratio_of_means()));
    }
    hash.0
}
