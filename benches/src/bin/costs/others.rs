//! Every estimator but plain, and plain by hand.

use crate::by_hand::PlainByHand;
use crate::{Rgb, batch, counted, draws, line, measure};
use core::hint::black_box;
use ratiocv_core::moments::{GroupedPairs, Moments, Pairs};
use ratiocv_core::{
    Beale, Choose, CrossFitted, Difference, HartleyRoss, Jackknife, Lanes, MeanOfRatios, Mickey, OptimalDefensive,
    Quenouille, RandomMixture, RatioOfMeans, RegressionRatio, Spectrum, Tin,
};

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

pub(crate) fn measure_all() {
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
