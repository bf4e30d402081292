//! The laws of every accumulator on every lane type, driven by proptest.

use num_traits::float::FloatCore;
use proptest::prelude::*;
use ratiocv_core::conformance::{self, Accumulator, Sampled};
use ratiocv_core::moments::{
    Blocked, Comoments, ComomentsBlock, ExtremesBlock, GroupedPairs, Groups, GroupsBlock, Joined, Mean, Pairs, RatioOf,
    Sums, ThirdBlock, UnivariateBlock, Variance,
};
use ratiocv_core::{
    Beale, CrossFitted, Dependent, DeterministicMixture, Difference, Draw, Estimator, HartleyRoss, Integrals, Lanes,
    MeanOfRatios, Mickey, Plain, Quenouille, RatioOfMeans, Reads, Regression, RegressionRatio, Scalar, Spectrum, Tin,
};

/// Draws with ties, zeros of either sign, and numbers of many sizes: what breaks sums. h stays away
/// from sums that cancel, where no relative tolerance could hold.
fn draws<V: Lanes>() -> impl Strategy<Value = Vec<Draw<V>>> {
    let f = prop_oneof![
        4 => -4.0..8.0_f64,
        1 => Just(0.0),
        1 => Just(-0.0),
        1 => Just(1.0),
        1 => (-20..20_i32).prop_map(power_of_two),
    ];
    let h = prop_oneof![4 => 0.25..2.0_f64, 1 => Just(1.0), 1 => (-8..3_i32).prop_map(power_of_two)];
    prop::collection::vec((f, h, any::<u64>()), 2..300).prop_map(|list| {
        list.iter()
            .map(|(f, h, salt)| {
                // Every channel its own: the first as drawn, the others turned about.
                let turn = |i: usize| ((salt.rotate_left(i as u32 * 7) & 7) as f64 + 1.0) / 8.0;
                let channel = |i: usize, x: f64| V::Scalar::from_f64(if i == 0 { x } else { x * turn(i) });
                Draw::new(V::from_fn(|i| channel(i, *f)), V::from_fn(|i| channel(i + V::LANES, *h)))
            })
            .collect()
    })
}

fn power_of_two(e: i32) -> f64 {
    2.0_f64.powi(e)
}

/// The same draws with a second auxiliary, that of the draw before.
fn two<V: Lanes>(draws: &[Draw<V>]) -> Vec<Draw<V, 2>> {
    let before = |i: usize| draws[(i + draws.len() - 1) % draws.len()];
    draws.iter().enumerate().map(|(i, draw)| Draw { f: draw.f, h: [draw.h[0], before(i).h[0]] }).collect()
}

/// All laws for one estimator on one accumulator.
fn obey<D: Sampled, M: Accumulator<D>, E: Estimator<M::Channel, K>, const K: usize>(
    estimator: &E,
    empty: impl Fn(&Integrals<D::Lanes, K>) -> M,
    draws: &[D],
) -> Result<(), TestCaseError> {
    // The tolerance of an estimate: rounding of the lanes' scalar, times the conditions of the sums
    // (f has both signs) and of the corrections.
    let epsilon = Lanes::widen(<<D::Lanes as Lanes>::Scalar as FloatCore>::epsilon());
    let mut spread = 1.0_f64;
    for draw in draws {
        let _ = draw.changed(
            |f| {
                spread = (0..D::Lanes::LANES).map(|i| Lanes::widen(f.get(i)).abs()).fold(spread, f64::max);
                f
            },
            |h| h,
        );
    }
    let value = estimator.estimate_anyway(&at_once(empty(&Integrals::ONE), draws), &Integrals::ONE);
    let lanes = 0..D::Lanes::LANES;
    let least = lanes.map(|i| value.value.get(i).abs()).fold(f64::INFINITY, f64::min).max(1e-9);
    let tolerance = 256.0 * epsilon * spread / least.min(1.0);
    conformance::all(estimator, empty, draws, &Integrals::ONE, tolerance).map_err(TestCaseError::fail)
}

fn at_once<D: Sampled, M: Accumulator<D>>(mut moments: M, draws: &[D]) -> M {
    moments.add_batch(draws);
    moments
}

/// Every kernel at once, as the report uses them.
type Everything<V> = Blocked<
    V,
    Joined<ComomentsBlock<V>, UnivariateBlock<RatioOf<V>, 1>, GroupsBlock<V, 8>, ExtremesBlock<V>, ThirdBlock<V>>,
>;

macro_rules! every_accumulator {
    ($($name:ident: $lanes:ty;)*) => {$(
        mod $name {
            use super::*;
            type V = $lanes;

            proptest! {
                #![proptest_config(ProptestConfig {
                    cases: if V::LANES > 4 { 16 } else { 64 },
                    rng_seed: proptest::test_runner::RngSeed::Fixed(0x5eed),
                    failure_persistence: None,
                    ..ProptestConfig::default()
                })]

                #[test]
                fn value_tier(draws in draws::<V>()) {
                    obey(&Plain, |_| Mean::<V>::default(), &draws)?;
                    obey(&RatioOfMeans, |_| Sums::<V>::default(), &draws)?;
                    obey(&Quenouille, |_| Groups::<V, 2>::default(), &draws)?;
                    obey(&Mickey, |_| Groups::<V, 8>::default(), &draws)?;
                    obey(&Mickey, |_| Groups::<V, 3>::default(), &draws)?;
                    obey(&HartleyRoss, |h| HartleyRoss.value(h), &draws)?;
                    obey(&MeanOfRatios, |h| MeanOfRatios.value(h), &draws)?;
                }

                #[test]
                fn error_bar_tier(draws in draws::<V>()) {
                    obey(&Plain, |_| Variance::<V>::default(), &draws)?;
                    obey(&RatioOfMeans, |_| Comoments::<V>::default(), &draws)?;
                    obey(&Beale, |_| Comoments::<V>::default(), &draws)?;
                    obey(&Tin, |_| Comoments::<V>::default(), &draws)?;
                    obey(&Quenouille, |h| Quenouille.error_bar(h), &draws)?;
                    obey(&Mickey, |h| Mickey.error_bar(h), &draws)?;
                    obey(&HartleyRoss, |h| HartleyRoss.error_bar(h), &draws)?;
                    obey(&MeanOfRatios, |h| MeanOfRatios.error_bar(h), &draws)?;
                }

                #[test]
                fn defensive(draws in draws::<V>()) {
                    let ratio = RatioOfMeans.defensive(0.01).unwrap();
                    obey(&ratio, |h| ratio.value(h), &draws)?;
                    let beale = Beale.defensive(0.125).unwrap();
                    obey(&beale, |h| beale.error_bar(h), &draws)?;
                    let hartley_ross = HartleyRoss.defensive(0.25).unwrap();
                    obey(&hartley_ross, |h| hartley_ross.error_bar(h), &draws)?;
                    let mickey = Mickey.defensive(0.01).unwrap();
                    obey(&mickey, |h| mickey.error_bar(h), &draws)?;
                }

                // Folds by fits to half the draws; two auxiliaries by given exponents, whose error bar reads
                // every square and product; pairs by the jackknife of their sum.
                #[test]
                fn folds_several_and_pairs(draws in draws::<V>()) {
                    let unshrunk = Regression { shrink: false, dependent: Dependent::MinimumNorm };
                    let folds = CrossFitted(Difference { regression: unshrunk });
                    obey(&folds, |h| folds.error_bar(h), &draws)?;
                    let draws = two(&draws);
                    obey(&RegressionRatio::default().fixed([0.75, -0.5]), |_| Comoments::<V, 2>::default(), &draws)?;
                    let parts = |draw: &Draw<V, 2>| Pairs([draw.auxiliary(0), Draw::new(draw.f, draw.h[1])]);
                    let pairs: Vec<_> = draws.iter().map(parts).collect();
                    obey(&DeterministicMixture, |_| GroupedPairs::<V, 2, 8>::default(), &pairs)?;
                }

                #[test]
                fn diagnostic_tier(draws in draws::<V>()) {
                    obey(&RatioOfMeans, |_| Everything::<V>::default(), &draws)?;
                    obey(&HartleyRoss, |_| Everything::<V>::default(), &draws)?;
                    obey(&Tin, |_| Everything::<V>::default(), &draws)?;
                }
            }
        }
    )*};
}

every_accumulator! {
    one_f64: f64;
    one_f32: f32;
    rgb_f32: Spectrum<f32, 3>;
    three_packs_of_two: Spectrum<Spectrum<f64, 2>, 3>;
}
