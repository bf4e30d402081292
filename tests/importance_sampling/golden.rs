//! The golden variances, and what the accumulators make of these draws.

use crate::outcomes::{Outcome, Table, magnitudes, mixture, moments, partial, stratum, sums, total, values, vector};
use ratiocv_core::moments::{Accumulate, Moments, Variance};
use ratiocv_core::sampling::{Discrete, Strata};
use ratiocv_core::{Estimator, Flags, Integrals, Plain, Proposal, Spectrum};
use ratiocv_tests::assert_close;
use ratiocv_tests::golden::{ImportanceSampling, seed};
use ratiocv_tests::sum::Sum;

fn row<const B: usize>(row: &[f64]) -> [f64; B] {
    row.try_into().expect("the record's size")
}

fn table<const M: usize, const B: usize>(rows: &[Vec<f64>]) -> Table<M, B> {
    core::array::from_fn(|j| row(&rows[j]))
}

fn choice<const B: usize>(weights: &[f64]) -> Discrete<B> {
    Discrete::new(&row(weights)).expect("a table of weights")
}

/// The record of `name`.
fn record(name: &str) -> ImportanceSampling {
    seed().importance_sampling.into_iter().find(|record| record.name == name).expect("the record")
}

/// Compares every variance of a record of `M` channels, `B` points and `K` strata; how many there were.
fn check<const M: usize, const B: usize, const K: usize>(name: &str) -> usize {
    let record = record(name);
    let f: Table<M, B> = table(&record.f);
    let n = record.n as f64;
    let g = choice::<B>(&record.g);
    let gk: [Discrete<B>; M] = core::array::from_fn(|k| choice(&record.gk[k]));
    let pk = choice::<M>(&record.pk);
    let best = Discrete::by_norm(&values(&f)).expect("norms");
    let sizes = magnitudes(&f);

    for (point, right) in record.optimal_g.iter().enumerate() {
        assert_close(best.pdf(&point), right.0, 1e-12 * right.0, "optimal g");
    }
    for (j, right) in record.total.iter().enumerate() {
        assert_eq!(sums(&f)[j], right.0);
    }

    let strata = Strata::<Spectrum<f64, M>, K>::new(|j| {
        record.strata.iter().position(|stratum| stratum.contains(&j)).expect("a stratum for every channel")
    })
    .expect("strata in range");
    let stratified = |g: &dyn Fn(usize) -> Discrete<B>| {
        let of = |k: usize| total(&unbiased(&f, strata.channels(k), stratum(&f, &strata, k, &g(k))));
        (0..K).map(|k| of(k) / record.nk[k] as f64).sum::<f64>()
    };
    let own_norms = |k: usize| -> Discrete<B> {
        Discrete::by_norm(&core::array::from_fn::<_, B, _>(|point| strata.value(k, |j| f[j][point]))).expect("norms")
    };
    let all = || 0..M;
    let best_pk = Discrete::new(&sums(&sizes)).expect("channels that are not 0");
    let best_gk = sizes.map(|row| Discrete::new(&row).expect("a channel that is not 0"));
    let ours = [
        ("vector_is", total(&unbiased(&f, all(), vector(&f, &g))) / n),
        ("vector_is_optimal", total(&unbiased(&f, all(), vector(&f, &best))) / n),
        ("random_mixture_is", total(&unbiased(&f, all(), mixture(&f, &pk, &gk))) / n),
        ("random_mixture_is_optimal", total(&unbiased(&f, all(), mixture(&f, &best_pk, &best_gk))) / n),
        ("partial_is", total(&unbiased(&f, all(), partial(&f, &g, &table(&record.accept)))) / n),
        ("entry_wise_stratification", stratified(&|k| gk[k])),
        ("entry_wise_stratification_optimal", stratified(&own_norms)),
    ];
    for (id, ours) in ours {
        let right = record.variance[id].0;
        // A variance of 0 is left with the squares of roundings.
        assert_close(ours, right, 1e-12 * right.max(1e-12), &format!("{name} {id}"));
        println!("{name} {id}: {ours:e}, off by {:e}", (ours - right).abs());
    }
    ours.len()
}

/// The same outcomes, whose mean is the sum of f in `channels`, and 0 in the others.
fn unbiased<const M: usize, const B: usize>(
    f: &Table<M, B>,
    channels: impl Iterator<Item = usize>,
    outcomes: Vec<Outcome<M>>,
) -> Vec<Outcome<M>> {
    let channels: Vec<usize> = channels.collect();
    for (j, (mean, _)) in moments(&outcomes).iter().enumerate() {
        let right = if channels.contains(&j) { sums(f)[j] } else { 0.0 };
        assert_close(*mean, right, 1e-13 * right.abs(), &format!("mean of channel {j}"));
    }
    outcomes
}

#[test]
fn variances_are_the_golden_ones() {
    assert_eq!(check::<2, 4, 2>("is_nonneg") + check::<3, 3, 2>("is_signed"), 2 * 7);
    assert_eq!(seed().importance_sampling.len(), 2);
}

/// Over all samples of two draws: the plain mean has the right mean and variance, its squared error
/// bar the right mean, and only samples without a sight of f have no error bar.
fn check_pairs<const M: usize>(outcomes: &[Outcome<M>]) {
    let one = moments(outcomes);
    let mut sums = [[Sum::default(); 3]; M];
    for (p, first) in outcomes {
        for (q, second) in outcomes {
            let mut pair = Variance::<Spectrum<f64, M>, 0>::default();
            pair.add(*first);
            pair.add(*second);
            assert_eq!(pair.count(), 2); // rejected or not
            let estimate = Plain.estimate(&pair, &Integrals::NONE).expect("two draws");
            for (j, sums) in sums.iter_mut().enumerate() {
                let unseen = first.f[j] == 0.0 && second.f[j] == 0.0;
                assert_eq!(estimate.flags(j), if unseen { Flags::NO_SUPPORT } else { Flags::NONE });
                assert_eq!(estimate.std_error[j].is_nan(), unseen);
                let (value, error) = (estimate.value[j], if unseen { 0.0 } else { estimate.std_error[j] });
                let off = value - one[j].0;
                for (sum, term) in sums.iter_mut().zip([value, off * off, error * error]) {
                    sum.add(p * q * term);
                }
            }
        }
    }
    for (j, (mean, variance)) in one.into_iter().enumerate() {
        let [value, square, error] = sums[j].map(Sum::value);
        assert_close(value, mean, 1e-13 * mean.abs(), "mean of the estimate");
        assert_close(square, variance / 2.0, 1e-12 * variance, "variance of the estimate");
        assert_close(error, variance / 2.0, 1e-12 * variance, "mean of the squared error bar");
    }
}

#[test]
fn two_draws_of_each_kind_give_value_and_error_bar() {
    let record = record("is_signed");
    let f: Table<3, 3> = table(&record.f);
    let (g, gk) = (choice(&record.g), core::array::from_fn(|k| choice(&record.gk[k])));
    check_pairs(&vector(&f, &g));
    check_pairs(&mixture(&f, &choice(&record.pk), &gk));
    check_pairs(&partial(&f, &g, &table(&record.accept)));
}
