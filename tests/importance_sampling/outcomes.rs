//! All outcomes of one draw, and their exact moments.

use crate::scripted::{PART, first_and_last, played};
use ratiocv_core::sampling::{Accepted, Discrete, Partial, RandomMixture, Strata, in_channel};
use ratiocv_core::{Draw, Lanes, Problem, Proposal, Spectrum};
use ratiocv_tests::sum::Sum;

/// A function on `B` points: `f[channel][point]`.
pub(crate) type Table<const M: usize, const B: usize> = [[f64; B]; M];

/// A draw, and its probability.
pub(crate) type Outcome<const M: usize> = (f64, Draw<Spectrum<f64, M>, 0>);

/// Mean and variance of each channel over `outcomes`, which are all there are.
pub(crate) fn moments<const M: usize>(outcomes: &[Outcome<M>]) -> [(f64, f64); M] {
    let expect = |q: &dyn Fn(&Spectrum<f64, M>) -> f64| {
        let mut sum = Sum::default();
        for (p, draw) in outcomes {
            sum.add(p * q(&draw.f));
        }
        sum.value()
    };
    assert!((expect(&|_| 1.0) - 1.0).abs() <= 1e-15, "the outcomes are not all there are");
    core::array::from_fn(|j| {
        let mean = expect(&|f| f[j]);
        (mean, expect(&|f| (f[j] - mean) * (f[j] - mean)))
    })
}

/// The total variance of one draw.
pub(crate) fn total<const M: usize>(outcomes: &[Outcome<M>]) -> f64 {
    moments(outcomes).iter().map(|(_, variance)| variance).sum()
}

/// The values at a point.
pub(crate) fn at<const M: usize, const B: usize>(f: &Table<M, B>, point: usize) -> Spectrum<f64, M> {
    Spectrum::from_fn(|j| f[j][point])
}

/// `f` turned over: the values by point.
pub(crate) fn values<const M: usize, const B: usize>(f: &Table<M, B>) -> [Spectrum<f64, M>; B] {
    core::array::from_fn(|point| at(f, point))
}

/// Scripts that make `choice` choose each index, with its probability.
fn choices<const B: usize>(choice: &Discrete<B>) -> impl Iterator<Item = (usize, f64, [f64; 2])> + '_ {
    (0..B).filter_map(|i| first_and_last(choice, i).map(|ends| (i, choice.pdf(&i), ends)))
}

/// Estimator 1: vector-valued importance sampling.
pub(crate) fn vector<const M: usize, const B: usize>(f: &Table<M, B>, g: &Discrete<B>) -> Vec<Outcome<M>> {
    let problem = Problem::new(|point: &usize| at(f, *point)).proposal(*g);
    let draw = |u: f64| played(&[u], |rng| problem.draw(rng));
    choices(g)
        .map(|(_, p, [first, last])| {
            assert_eq!(draw(first), draw(last));
            (p, draw(first))
        })
        .collect()
}

/// One stratum of Estimator 2: entry-wise stratification.
pub(crate) fn stratum<const M: usize, const B: usize, const K: usize>(
    f: &Table<M, B>,
    strata: &Strata<Spectrum<f64, M>, K>,
    k: usize,
    g: &Discrete<B>,
) -> Vec<Outcome<M>> {
    let problem = Problem::new(|point: &usize| strata.value(k, |j| f[j][*point])).proposal(*g);
    choices(g).map(|(_, p, [first, _])| (p, played(&[first], |rng| problem.draw(rng)))).collect()
}

/// Estimator 3: random mixture.
pub(crate) fn mixture<const M: usize, const B: usize>(
    f: &Table<M, B>,
    choice: &Discrete<M>,
    g: &[Discrete<B>; M],
) -> Vec<Outcome<M>> {
    let problem = Problem::new(|(k, point): &(usize, usize)| in_channel::<Spectrum<f64, M>>(*k, f[*k][*point]))
        .proposal(RandomMixture::new(*choice, *g));
    let mut outcomes = Vec::new();
    for (k, p, [first, last]) in choices(choice) {
        for (_, conditional, [head, tail]) in choices(&g[k]) {
            let draw = played(&[first, tail], |rng| problem.draw(rng));
            assert_eq!(draw, played(&[last, head], |rng| problem.draw(rng)));
            outcomes.push((p * conditional, draw));
        }
    }
    outcomes
}

/// Estimator 4: partial; every set of accepted channels.
pub(crate) fn partial<const M: usize, const B: usize>(
    f: &Table<M, B>,
    g: &Discrete<B>,
    accept: &Table<M, B>,
) -> Vec<Outcome<M>> {
    type Point<const M: usize> = (usize, Accepted<Spectrum<f64, M>>);
    let problem = Problem::new(|(point, accepted): &Point<M>| accepted.value(|j| f[j][*point]))
        .proposal(Partial::new(*g, |point: &usize| at(accept, *point)));
    let mut outcomes = Vec::new();
    for (point, p, [first, _]) in choices(g) {
        for set in 0..1_u32 << M {
            let accepted = |j: usize| set >> j & 1 == 1;
            // What must be accepted cannot be rejected, and the other way round.
            let possible = (0..M).all(|j| if accepted(j) { accept[j][point] > 0.0 } else { accept[j][point] < 1.0 });
            if !possible {
                continue;
            }
            let roll = |j: usize| if accepted(j) { 0.0 } else { 1.0 - PART };
            let script: Vec<f64> = core::iter::once(first).chain((0..M).map(roll)).collect();
            let chance = |j: usize| if accepted(j) { accept[j][point] } else { 1.0 - accept[j][point] };
            outcomes.push((p * (0..M).map(chance).product::<f64>(), played(&script, |rng| problem.draw(rng))));
        }
    }
    outcomes
}

/// f, as integrals by channel.
pub(crate) fn sums<const M: usize, const B: usize>(f: &Table<M, B>) -> [f64; M] {
    f.map(|row| row.iter().sum())
}

/// |f|.
pub(crate) fn magnitudes<const M: usize, const B: usize>(f: &Table<M, B>) -> Table<M, B> {
    f.map(|row| row.map(f64::abs))
}
