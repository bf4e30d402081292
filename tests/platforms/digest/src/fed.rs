//! Hostile draws through an accumulator, and what estimators say of it.

use crate::hash::Hash;
use crate::hostile::KINDS;
use num_traits::float::FloatCore;
use ratiocv_core::moments::{Accumulate, Merge, Moments, Save};
use ratiocv_core::{ChannelEstimate, Estimator, Lanes, Sample};

/// Draws by themselves, and in a batch: more than a run of 64, with a rest.
const ALONE: usize = 70;
const BATCH: usize = 203;

/// Who takes the lines, and how three parts are merged: `regrouped`, a + (b + c), is a plant, which a comparison must
/// see. Backwards would be none: a merge of two parts does not depend on their order.
pub(crate) struct Lines<'a> {
    pub(crate) each: &'a mut dyn FnMut(&str, &str, u64),
    pub(crate) regrouped: bool,
}

/// An estimator of the moments `S` of a channel. An object, so that it is compiled once, not for every
/// accumulator and its lanes.
pub(crate) trait Estimates<S, const K: usize> {
    fn of(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> ChannelEstimate;
}

impl<S, E: Estimator<S, K>, const K: usize> Estimates<S, K> for E {
    fn of(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> ChannelEstimate {
        self.estimate_channel(sample, integrals)
    }
}

// Out of line, like all here: compiled once for each accumulator, not wherever it is called.
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
pub(crate) fn fed<D: Copy, M: Accumulate<D> + Merge + Copy>(
    empty: M,
    regrouped: bool,
    draw: &dyn Fn(usize) -> D,
    seen: &mut dyn FnMut(&M),
) -> M {
    let mut moments = empty;
    seen(&moments);
    for i in 0..ALONE {
        add(&mut moments, draw(i));
        if i < 3 || i == 64 {
            seen(&moments);
        }
    }
    seen(&moments);
    let batch = |first: usize| -> [D; BATCH] { core::array::from_fn(|i| draw(first + i)) };
    let (mut later, mut last) = (empty, empty);
    add_batch(&mut later, &batch(ALONE));
    seen(&later);
    add_batch(&mut last, &batch(ALONE + BATCH));
    if regrouped {
        later.merge(&last);
        moments.merge(&later);
    } else {
        moments.merge(&later);
        moments.merge(&last);
    }
    seen(&moments);
    add_batch(&mut moments, &batch(ALONE + 2 * BATCH));
    seen(&moments);
    moments
}

/// Shows a hash of everything that `empty` keeps of all kinds of draws, and one of everything that each of
/// `estimators` says of it at any stage.
#[inline(never)]
pub(crate) fn show<D: Copy, M, const K: usize, const E: usize>(
    lines: &mut Lines<'_>,
    [lanes, name]: [&str; 2],
    empty: M,
    draw: &dyn Fn(usize, usize) -> D,
    integrals: [f64; K],
    estimators: [(&str, &dyn Estimates<M::Channel, K>); E],
) where
    M: Accumulate<D> + Merge + Moments + Save + Copy,
{
    let epsilon = <<M::Lanes as Lanes>::Scalar as FloatCore>::epsilon().widen();
    let (mut kept, mut said) = (Hash::EMPTY, [const { Hash::EMPTY }; E]);
    for first in (0..KINDS).step_by(M::Lanes::LANES) {
        let mut look = |moments: &M| {
            let closed = moments.closed();
            for channel in 0..M::Lanes::LANES {
                let moments = &closed.channel(channel);
                let sample = Sample { channel, count: closed.count(), epsilon, moments };
                for (hash, (_, estimator)) in said.iter_mut().zip(estimators) {
                    hash.estimate(&estimator.of(&sample, &integrals));
                }
            }
        };
        let mut moments = fed(empty, lines.regrouped, &|i| draw(first, i), &mut look);
        moments.words(&mut |word| kept.word(*word));
    }
    (lines.each)(lanes, name, kept.0);
    for (hash, (name, _)) in said.iter().zip(estimators) {
        (lines.each)(lanes, name, hash.0);
    }
}
