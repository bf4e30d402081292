//! Each estimator keeps only the moments that it reads: the table in the documentation, measured.

use ratiocv_core::{
    Beale, Choose, CrossFitted, Difference, HartleyRoss, Jackknife, Lanes, MeanOfRatios, Mickey, OptimalDefensive,
    Plain, Quenouille, RandomMixture, RatioOfMeans, Reads, RegressionRatio, Spectrum, Tin,
};

fn row<E: Reads<K>, const K: usize>(_: E) -> String {
    fn bytes<E: Reads<K>, V: Lanes, const K: usize>() -> String {
        format!("{} | {}", size_of::<E::Value<V>>(), size_of::<E::ErrorBar<V>>())
    }
    let auxiliaries = if K == 1 { String::new() } else { format!(", {K} auxiliaries") };
    format!("| `{}`{auxiliaries} | {} | {} |\n", E::ID, bytes::<E, Spectrum<f32, 3>, K>(), bytes::<E, f64, K>())
}

fn table() -> String {
    let head = "| estimator | RGB in `f32`: value | with error bar | one channel in `f64`: value | with error bar |\n\
                |---|---|---|---|---|\n";
    let rows = [
        row::<_, 1>(Plain),
        row(RatioOfMeans),
        row(Quenouille),
        row(Beale),
        row(Tin),
        row(MeanOfRatios),
        row(HartleyRoss),
        row(Mickey),
        row(Jackknife),
        row::<_, 1>(RegressionRatio::default()),
        row::<_, 1>(Difference::default()),
        row::<_, 2>(Difference::default()),
        row::<_, 3>(Difference::default()),
        row::<_, 1>(CrossFitted(Difference::default())),
        row::<_, 1>(<OptimalDefensive>::default()),
        row::<_, 1>(OptimalDefensive::of(Mickey)),
        row::<_, 1>(CrossFitted(OptimalDefensive::of(Mickey))),
        row::<_, 1>(Choose::default()),
        row::<_, 1>(CrossFitted(Choose::default())),
        row::<_, 2>(<RandomMixture>::default()),
    ];
    head.to_owned() + &rows.concat()
}

#[test]
fn the_documented_sizes_are_true() {
    let documented = include_str!("../core/src/moments/sizes.md");
    assert_eq!(documented, table(), "core/src/moments/sizes.md should read:\n{}", table());
}

#[test]
fn what_is_not_read_is_not_kept() {
    fn value<E: Reads>(_: E) -> usize {
        size_of::<E::Value<f64>>()
    }
    fn error_bar<E: Reads>(_: E) -> usize {
        size_of::<E::ErrorBar<f64>>()
    }
    // Means of two numbers cost less than their co-moments, these less than co-moments and ratios or
    // groups.
    assert!(value(RatioOfMeans) < error_bar(RatioOfMeans));
    assert!(error_bar(RatioOfMeans) < error_bar(HartleyRoss));
    assert!(error_bar(RatioOfMeans) < error_bar(Quenouille));
    assert!(error_bar(Quenouille) < error_bar(Mickey));
    assert_eq!(value(Beale), error_bar(RatioOfMeans));
}
