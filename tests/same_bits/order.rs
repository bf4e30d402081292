//! The order of summation, written out once more: a mean of plain numbers, without lanes, kernels or states.

use crate::hostile::draws;
use ratiocv_core::moments::{Accumulate, BLOCK, HasMeans, Moments, Sums};
use ratiocv_core::{Lanes, Spectrum};
use ratiocv_simd::{F32x4, F32x8, F32x16};

/// A mean on its way: the first number, the mean relative to it, and how many there were.
#[derive(Clone, Copy)]
struct Mean {
    anchor: f64,
    relative: f64,
    count: u64,
}

/// The mean of a block of one or more runs, by `parts` sums in `f32` of what lies above its first number: run by
/// run, then part by part.
fn block(numbers: &[f32], parts: usize) -> Mean {
    let shift = numbers[0];
    let mut sums = vec![];
    for run in numbers.chunks(BLOCK) {
        let mut of_run = vec![0.0_f32; parts];
        for (i, x) in run.iter().enumerate() {
            of_run[i % parts] += x - shift;
        }
        if sums.is_empty() {
            sums = of_run;
        } else {
            sums.iter_mut().zip(of_run).for_each(|(sum, of_run)| *sum += of_run);
        }
    }
    while sums.len() > 1 {
        let upper = sums.split_off(sums.len() / 2);
        for (lower, upper) in sums.iter_mut().zip(upper) {
            *lower += upper;
        }
    }
    let count = numbers.len() as u64;
    Mean { anchor: f64::from(shift), relative: f64::from(sums[0]) / count as f64, count }
}

/// The two together, about the anchor of the larger.
fn joined(earlier: Mean, later: Mean) -> Mean {
    let (large, small) = if later.count > earlier.count { (later, earlier) } else { (earlier, later) };
    let count = earlier.count + later.count;
    let apart = (small.anchor - large.anchor) + (small.relative - large.relative);
    Mean { relative: large.relative + apart * (small.count as f64 / count as f64), count, ..large }
}

/// Blocks of one for the first `singles` numbers, then a block of one run, blocks of up to `runs` runs, each in
/// `parts` sums, then the rest in one.
fn mean(numbers: &[f32], singles: usize, runs: usize, parts: usize) -> f64 {
    let (first, rest) = numbers.split_at(singles);
    let (whole, rest) = rest.split_at(rest.len() / BLOCK * BLOCK);
    let (one_run, whole) = whole.split_at(BLOCK);
    let whole = core::iter::once(one_run).chain(whole.chunks(runs * BLOCK)).map(|numbers| block(numbers, parts));
    let blocks = first.iter().map(|x| block(&[*x], 1)).chain(whole);
    let blocks = blocks.chain((!rest.is_empty()).then(|| block(rest, 1)));
    let mean = blocks.reduce(joined).expect("some numbers");
    mean.anchor + mean.relative
}

/// Means of every channel, added at once (a run to begin with, then 16 to a block, in `parts` sums) and one by one
/// (four draws alone, then one run, one sum).
fn check<V: Lanes<Scalar = f32>>(parts: usize) {
    let draws = draws::<V, 0>(0, 4 + 19 * BLOCK + 37);
    let (mut at_once, mut one_by_one) = (Sums::<V, 0>::default(), Sums::<V, 0>::default());
    at_once.add_batch(&draws);
    for draw in &draws {
        one_by_one.add(*draw);
    }
    // Infinities and NaNs are not asked for here.
    for channel in (0..V::LANES).filter(|channel| ![8, 9].contains(&(channel % 11))) {
        let numbers: Vec<f32> = draws.iter().map(|draw| draw.f.get(channel)).collect();
        for (moments, singles, runs, parts) in [(&at_once, 0, 16, parts), (&one_by_one, 4, 1, 1)] {
            let ours = moments.closed().channel(channel).means(moments.count()).f;
            let right = mean(&numbers, singles, runs, parts);
            assert_eq!(ours.to_bits(), right.to_bits(), "channel {channel} of {}: {ours}, {right}", V::LANES);
        }
    }
}

#[test]
fn partial_sums_are_a_function_of_the_number_of_channels() {
    check::<f32>(8);
    check::<Spectrum<f32, 2>>(4);
    check::<Spectrum<f32, 3>>(8);
    check::<Spectrum<f32, 12>>(2);
    check::<Spectrum<f32, 16>>(1);
    check::<Spectrum<f32, 40>>(1);
    check::<F32x4>(2);
    check::<F32x8>(1);
    check::<F32x16>(1);
    check::<Spectrum<F32x8, 3>>(1);
    check::<Spectrum<F32x4, 3>>(2);
}
