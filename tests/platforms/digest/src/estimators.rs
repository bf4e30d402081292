//! Every kernel and every estimator.

use crate::fed::{Lines, fed, show};
use crate::hash::Hash;
use crate::hostile::{KINDS, draw};
use ratiocv_core::moments::{
    Blocked, Comoments, ComomentsBlock, ExtremesBlock, FoldsBlock, GroupedPairs, Groups, GroupsBlock, Joined, Pairs,
    RatioOf, RatioVariance, Sums, ThirdBlock, UnivariateBlock, Widened,
};
use ratiocv_core::{
    Beale, Choose, CrossFitted, DeterministicMixture, Difference, Error, EstimatedIntegrals, FallBackWhenIll,
    HartleyRoss, Integrals, Jackknife, Lanes, MeanOfRatios, Mickey, OptimalDefensive, PathProduct, Plain, Quenouille,
    RandomMixture, RatioOfIntegrals, RatioOfMeans, Reads, RegressionRatio, ScaledSums, Tin,
};

/// All that estimators of one auxiliary read: fed once, and compiled once.
type Everything<V> = Blocked<
    V,
    Joined<
        ComomentsBlock<V>,
        [UnivariateBlock<RatioOf<V>, 1>; 2],
        GroupsBlock<V, 8>,
        ExtremesBlock<V>,
        ThirdBlock<V>,
        FoldsBlock<ComomentsBlock<V>>,
    >,
>;

/// Shows a hash for each accumulator and each of its estimators, on lanes `V`, whose name is `lanes`.
pub(crate) fn all<V: Lanes>(lines: &mut Lines<'_>, lanes: &str) -> Result<(), Error> {
    let one = &Integrals::<V>::ONE;
    let (of_one, of_two) = ([1.0], [1.0, -0.5]);
    macro_rules! show {
        ($($name:literal: $moments:expr, $integrals:expr, [$($estimator:literal: $of:expr),*];)*) => {
            $(show(lines, [lanes, $name], $moments, &draw, $integrals, [$(($estimator, &$of)),*]);)*
        };
    }
    let ratios = Blocked::both(RatioVariance::default(), RatioVariance::defensive(0.01, one)?);
    show! {
        "everything": Everything::<V>::with_ratios(ratios), of_one, [
            "mc": Plain,
            "ratio": RatioOfMeans,
            "quenouille": Quenouille,
            "beale": Beale,
            "tin": Tin,
            "jackknife": Jackknife,
            "mean_of_ratios": MeanOfRatios,
            "hartley_ross": HartleyRoss,
            "mickey": Mickey,
            "regression_ratio": RegressionRatio::default(),
            "difference": Difference::default(),
            "cross_fitted_difference": CrossFitted(Difference::default()),
            "choose": Choose::default(),
            "choose_unbiased": CrossFitted(Choose::default()),
            "optimal_defensive_ratio": <OptimalDefensive>::default(),
            "optimal_defensive_mickey": OptimalDefensive::of(Mickey),
            "fall_back": FallBackWhenIll(RatioOfMeans),
            "estimated_integrals": EstimatedIntegrals { estimator: Difference::default(), std_errors: [1.0] },
            "defensive_ratio": RatioOfMeans.defensive(0.01)?,
            "defensive_quenouille": Quenouille.defensive(0.01)?,
            "defensive_beale": Beale.defensive(0.01)?,
            "defensive_tin": Tin.defensive(0.01)?,
            "defensive_jackknife": Jackknife.defensive(0.01)?,
            "defensive_mean_of_ratios": MeanOfRatios.defensive(0.01)?,
            "defensive_hartley_ross": HartleyRoss.defensive(0.01)?,
            "defensive_mickey": Mickey.defensive(0.01)?
        ];
        "comoments_2": Comoments::<V, 2>::default(), of_two, [
            "difference_2": Difference::default(),
            "choose_2": Choose::default(),
            "random_mixture_2": <RandomMixture>::default(),
            "ratio_of_integrals": RatioOfIntegrals
        ];
        // Without error bars, and without singles before a run.
        "sums": Sums::<V>::default(), of_one, ["mc value": Plain, "ratio value": RatioOfMeans];
        "groups": Groups::<V, 8>::default(), of_one, ["mickey value": Mickey];
        "ratios": MeanOfRatios.error_bar(one), of_one, ["mean_of_ratios alone": MeanOfRatios];
        "widened": Widened::<V, Comoments<V::Wide>>::default(), of_one, ["tin widened": Tin];
    }
    let pairs = |first, i: usize| Pairs([draw(first, 2 * i), draw(first, 2 * i + 1)]);
    let groups = GroupedPairs::<V, 2, 8>::default();
    show(lines, [lanes, "pairs"], groups, &pairs, of_two, [("deterministic_mixture", &DeterministicMixture)]);
    let paths = paths::<V>(lines.regrouped);
    (lines.each)(lanes, "paths", paths);
    Ok(())
}

/// Paths of five steps.
fn paths<V: Lanes>(regrouped: bool) -> u64 {
    let mut hash = Hash::EMPTY;
    for first in (0..KINDS).step_by(V::LANES) {
        let path = |i: usize| {
            let mut path = PathProduct::<V>::default();
            (0..5).for_each(|d| path.extend(draw(first, 5 * i + d), &Integrals::ONE));
            path
        };
        fed(ScaledSums::<V>::default(), regrouped, &path, &mut |sums| {
            let estimate = sums.ratio_of_means();
            (0..V::LANES).for_each(|channel| hash.estimate(&estimate.channel(channel)));
        });
    }
    hash.0
}
