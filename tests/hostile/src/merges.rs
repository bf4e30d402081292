//! Parts, merged in any order.

use crate::bytes::{Bytes, Reach, draws};
use crate::truth::Truth;
use ratiocv_core::moments::{
    Accumulate, Blocked, ComomentsBlock, ExtremesBlock, GroupsBlock, HasComoments, HasGroups, HasMeans, Joined, Merge,
    Moments,
};
use ratiocv_core::{Draw, Integrals, Plain, RatioOfMeans, Scalar, conformance};

type All<S> = Blocked<S, Joined<ComomentsBlock<S>, (), GroupsBlock<S, 8>, ExtremesBlock<S>>>;

/// Draws in parts, empty ones among them, merged in the order of the draws or any other, in any tree: the means and
/// squares of all draws but for rounding, counters exactly; and the laws that hold to the bit.
pub fn merges(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let kind = bytes.byte();
    let reach = [Reach::Moderate, Reach::Finite, Reach::Any, Reach::Any][usize::from(kind >> 1 & 3)];
    if kind & 1 == 0 { of::<f32>(&mut bytes, reach) } else { of::<f64>(&mut bytes, reach) }
}

fn of<S: Scalar>(bytes: &mut Bytes<'_>, reach: Reach) {
    // Sizes of parts, and which of them to merge next.
    let choices: [usize; 8] = core::array::from_fn(|_| usize::from(bytes.byte()));
    let points = bytes.points::<S, 2>(reach, 150);
    let draws: Vec<Draw<S>> = draws(&points);
    let (mut parts, mut in_order) = (Vec::<All<S>>::new(), true);
    let mut rest = &draws[..];
    for (i, choice) in choices.iter().enumerate() {
        let size = if i + 1 == choices.len() { rest.len() } else { (choice % 80).min(rest.len()) };
        let (part, after) = rest.split_at(size);
        let mut moments = All::<S>::default();
        if choice & 64 == 0 {
            part.iter().for_each(|draw| moments.add(*draw))
        } else {
            moments.add_batch(part)
        }
        parts.push(moments);
        rest = after;
    }
    for step in (1..choices.len()).rev() {
        let left = choices[step] % (parts.len() - 1);
        let right =
            if choices[0] & 1 == 0 { left + 1 } else { left + 1 + choices[step - 1] % (parts.len() - 1 - left) };
        in_order &= right == left + 1;
        let later = parts.remove(right);
        parts[left].merge(&later);
    }
    let merged = parts[0].closed();
    let (channel, count) = (merged.channel(0), merged.count());
    assert_eq!(count, draws.len() as u64, "draws were lost");

    let tails = channel.tails().expect("they were kept");
    let is = |no_f: bool| points.iter().filter(|[f, h]| *h == 0.0 && (*f == 0.0) == no_f).count() as u64;
    assert_eq!((tails.nothing, tails.unbounded), (is(true), is(false)), "draws with h = 0 were lost");
    let largest = points.iter().map(|[f, _]| f.abs()).fold(0.0, f64::max);
    assert_eq!(tails.max_f, largest, "the largest |f|");
    let group_counts: u64 = (0..8).map(|g| channel.group(count, g).count).sum();
    assert_eq!(group_counts, count, "draws of groups were lost");

    if reach < Reach::Any {
        let numbers = |entry: usize| -> Vec<f64> { points.iter().map(|point| point[entry]).collect() };
        let (f, h) = (Truth::new(&numbers(0)), Truth::new(&numbers(1)));
        let means = channel.means(count);
        f.mean_is::<S>(means.f, "mean of f");
        h.mean_is::<S>(means.h[0], "mean of h");
        if means.f.is_finite() && means.h[0].is_finite() {
            h.products_are::<S>(&h, channel.comoments().hh[0][0], "squares of h");
        }
    }
    if reach == Reach::Moderate && in_order {
        for g in 0..8.min(points.len()) {
            let own: Vec<f64> = points.iter().skip(g).step_by(8).map(|[f, _]| *f).collect();
            let (group, sum) = (channel.group(count, g), own.iter().sum::<f64>());
            assert_eq!(group.count, own.len() as u64, "draws of group {g}");
            let size = own.iter().map(|x| x.abs()).sum::<f64>();
            let off = (group.f * own.len() as f64 - sum).abs();
            assert!(off <= 32.0 * crate::truth::epsilon::<S>() * size, "group {g}: {} for {sum}", group.f);
        }
    }
    to_the_bit(&draws, choices[1]);
}

fn to_the_bit<S: Scalar>(draws: &[Draw<S>], at: usize) {
    let (one, empty) = (Integrals::ONE, |_: &Integrals<S>| All::<S>::default());
    let ratio = conformance::empty_is_identity(&RatioOfMeans, &empty, draws, &one);
    let plain = conformance::empty_is_identity(&Plain, &empty, draws, &one);
    let saved = conformance::saved_goes_on_the_same(&RatioOfMeans, &empty, draws, at, &one);
    let calls = conformance::same_calls_same_bits(&RatioOfMeans, &empty, draws, &one);
    assert_eq!([ratio, plain, saved, calls], [Ok(()); 4]);
}
