//! Exact expectations over all samples of a discrete law: no statistics, no tolerance for noise.

use crate::golden::Point;
use crate::sum::Sum;

/// Expectation, bias and MSE of an estimator.
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    /// E\[F̂\].
    pub expectation: f64,
    /// E\[F̂ − F\].
    pub bias: f64,
    /// E\[(F̂ − F)²\].
    pub mse: f64,
}

/// Calls `each` with every way to write `total` as an ordered sum of `parts` counts.
pub fn compositions(total: usize, parts: usize, each: &mut impl FnMut(&[usize])) {
    fn go(rest: usize, at: usize, counts: &mut [usize], each: &mut impl FnMut(&[usize])) {
        if at + 1 == counts.len() {
            counts[at] = rest;
            return each(counts);
        }
        for here in 0..=rest {
            counts[at] = here;
            go(rest - here, at + 1, counts, each);
        }
    }
    go(total, 0, &mut vec![0; parts], each);
}

/// Calls `each` with every ascending list of `length` numbers below `kinds`, repeats allowed.
pub fn ascending(kinds: usize, length: usize, each: &mut impl FnMut(&[usize])) {
    let mut list = vec![0; length];
    loop {
        each(&list);
        let Some(last) = list.iter().rposition(|kind| kind + 1 < kinds) else { return };
        let next = list[last] + 1;
        list[last..].fill(next);
    }
}

/// The draws of `group_size` that differ in more than order, as counts per point, with their
/// probabilities.
pub fn multisets(support: &[Point], group_size: usize) -> Vec<(Vec<usize>, f64)> {
    let mut all = Vec::new();
    compositions(group_size, support.len(), &mut |counts| {
        let weight =
            multinomial(counts) * counts.iter().zip(support).map(|(c, p)| p.p.powi(*c as i32)).product::<f64>();
        all.push((counts.to_vec(), weight));
    });
    all
}

/// n!/Πc!, exact for the sizes used here.
pub fn multinomial(counts: &[usize]) -> f64 {
    let (mut value, mut n) = (1u128, 0u128);
    for count in counts {
        for i in 1..=*count as u128 {
            n += 1;
            value = value * n / i;
        }
    }
    value as f64
}

/// The exact moments of `estimate` over all samples made of `groups` exchangeable groups of
/// `group_size` draws: `estimate` receives the points of each group in turn, and must not depend on
/// the order of groups, nor on that of the draws within one.
pub fn over_groups(
    support: &[Point],
    groups: usize,
    group_size: usize,
    f: f64,
    mut estimate: impl FnMut(&[&[usize]]) -> f64,
) -> Exact {
    let kinds: Vec<(Vec<usize>, f64)> = multisets(support, group_size)
        .into_iter()
        .map(|(counts, p)| (counts.iter().enumerate().flat_map(|(i, count)| vec![i; *count]).collect(), p))
        .collect();
    let (mut value, mut error, mut square) = (Sum::default(), Sum::default(), Sum::default());
    ascending(kinds.len(), groups, &mut |chosen| {
        let sample: Vec<&[usize]> = chosen.iter().map(|kind| kinds[*kind].0.as_slice()).collect();
        let runs: Vec<usize> = chosen.chunk_by(|a, b| a == b).map(<[usize]>::len).collect();
        let weight = multinomial(&runs) * chosen.iter().map(|kind| kinds[*kind].1).product::<f64>();
        let estimate = estimate(&sample);
        value.add(weight * estimate);
        error.add(weight * (estimate - f));
        square.add(weight * (estimate - f) * (estimate - f));
    });
    Exact { expectation: value.value(), bias: error.value(), mse: square.value() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_of_all_samples_sum_to_one() {
        let point = |p| Point { y: 0.0, x: vec![], p, w: vec![] };
        let support = [point(0.25), point(0.5), point(0.25)];
        let exact = over_groups(&support, 3, 4, 0.0, |groups| {
            assert_eq!(groups.iter().map(|group| group.len()).sum::<usize>(), 12);
            1.0
        });
        assert!((exact.expectation - 1.0).abs() <= 1e-15 && (exact.mse - 1.0).abs() <= 1e-15);
    }

    #[test]
    fn multinomials_are_exact() {
        assert_eq!(multinomial(&[2, 1, 1]), 12.0);
        assert_eq!(multinomial(&[16, 0]), 1.0);
        assert_eq!(multinomial(&[4, 4, 4, 4]), 63_063_000.0);
    }
}
