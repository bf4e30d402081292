//! What an accumulator sums over a block of draws, and the state that blocks are merged into.

use crate::moments::read::Means;

/// Sums over the draws of one block, and what they amount to.
///
/// *Implemented by* the kernels of this folder; *called by* [`Blocked`](super::Blocked) alone.
///
/// # Laws
/// `empty`, [`Takes::begin`], then [`Takes::add`] of `n` draws, then `close(n)`, yields the state of these
/// draws. `fold` adds the sums of another part of the same block (same state, same beginning).
/// Lanes never mix.
///
/// # Implementing
/// Branch-free in `add`; decisions belong in `close` or in the estimator.
pub trait Kernel: Copy {
    /// What a closed block, and a stream of blocks, amounts to. Parameters live there too.
    type State: State;
    /// Into how many partial sums a batch splits a run: draw `i` goes to part `i % PARTIALS`.
    /// A function of the number of channels alone, so that the order of summation, and with it
    /// every bit, is the same for any lane width. A power of two, at most 8.
    const PARTIALS: usize;
    /// Whether its sums are taken about what the state learns from the first draws of a stream. If not, a batch
    /// may begin with a run.
    const LEARNS: bool;
    /// `P` partial sums side by side: the same kernel on `P` times as many lanes, so that a few channels
    /// fill SIMD registers too; `[Self; P]` where a draw's number matters.
    type Beside<const P: usize>: Copy;

    /// A block without draws, for a stream in `state`.
    fn empty(state: &Self::State) -> Self;
    /// Adds the sums of another part of this block.
    fn fold(&mut self, other: &Self);
    /// The state of the `count` draws that were added, with the parameters of `state`.
    fn close(&self, state: &Self::State, count: u64) -> Self::State;
    /// `P` parts like this one.
    fn beside<const P: usize>(&self) -> Self::Beside<P>;
    /// Part `part` of `P`.
    fn part<const P: usize>(parts: &Self::Beside<P>, part: usize) -> Self;
    /// Adds to each part the sums of another one.
    fn fold_beside<const P: usize>(parts: &mut Self::Beside<P>, others: &Self::Beside<P>);
}

/// A [`Kernel`] for draws of type `D`.
pub trait Takes<D>: Kernel {
    /// Tells an empty block its first draw (`index` 0) and its second (1), which are still to be added, for
    /// sums to be taken about.
    fn begin(&mut self, index: usize, draw: &D);
    /// Adds the `index`-th draw of the block.
    fn add(&mut self, index: usize, draw: &D);
    /// Adds `P` draws, the first of them the `index`-th of the block: one to each part.
    fn add_beside<const P: usize>(parts: &mut Self::Beside<P>, index: usize, draws: &[D; P]);
}

/// [`Kernel`]'s parts of a kernel of lanes that has a `map` over them, and a `join` with another one of any
/// lanes: side by side as lanes. `fold` is `join` too.
macro_rules! lanes_beside {
    ($($block:tt)*) => {
        type Beside<const P: usize> = $($block)*;
        #[inline(always)]
        fn beside<const P: usize>(&self) -> Self::Beside<P> {
            self.map(|lanes| $crate::spectrum::Spectrum([lanes; P]))
        }
        #[inline(always)]
        fn part<const P: usize>(parts: &Self::Beside<P>, part: usize) -> Self {
            parts.map(|lanes| lanes.0[part])
        }
        #[inline(always)]
        fn fold_beside<const P: usize>(parts: &mut Self::Beside<P>, others: &Self::Beside<P>) {
            parts.join(others);
        }
        #[inline(always)]
        fn fold(&mut self, other: &Self) {
            self.join(other);
        }
    };
}
pub(crate) use lanes_beside;

/// [`Kernel`]'s parts of a kernel to which a draw's number matters: one beside the other.
macro_rules! kernels_beside {
    () => {
        type Beside<const P: usize> = [Self; P];
        #[inline(always)]
        fn beside<const P: usize>(&self) -> [Self; P] {
            [*self; P]
        }
        #[inline(always)]
        fn part<const P: usize>(parts: &[Self; P], part: usize) -> Self {
            parts[part]
        }
        #[inline(always)]
        fn fold_beside<const P: usize>(parts: &mut [Self; P], others: &[Self; P]) {
            for (part, other) in parts.iter_mut().zip(others) {
                part.fold(other);
            }
        }
    };
}
pub(crate) use kernels_beside;

/// Adds one draw to each of `P` kernels.
#[inline(always)]
pub(crate) fn add_to_each<D, B: Takes<D>, const P: usize>(parts: &mut [B; P], index: usize, draws: &[D; P]) {
    for (i, (part, draw)) in parts.iter_mut().zip(draws).enumerate() {
        part.add(index + i, draw);
    }
}

/// The `f64` state of a stream of draws.
pub trait State: Copy {
    /// The state of one channel.
    type Channel: Copy;

    /// Appends the state of `later_count` further draws. Neither count is 0.
    fn merge(&mut self, count: u64, later: &Self, later_count: u64);
    /// The state of channel `channel`; panics if there is no such channel.
    fn channel(&self, channel: usize) -> Self::Channel;
    /// [`Moments::means_alone`](super::Moments::means_alone).
    #[inline(always)]
    fn means_alone<const K: usize>(&self, channel: usize) -> Option<Means<K>> {
        let _ = channel;
        None
    }
    /// Calls `each` with every number, parameters included, in a fixed order: see [`Save`](super::Save).
    fn words(&mut self, each: &mut dyn FnMut(&mut u64));
}

/// The part with more draws first (the earlier of two alike), the other one, and the fraction of all
/// draws that the other one has.
///
/// Merges keep the anchor of the larger part: relative to that of a lone outlier, the mean of
/// everything else would lose its digits.
#[inline(always)]
pub(crate) fn larger_first<S>(earlier: S, count: u64, later: S, later_count: u64) -> (S, S, f64) {
    let total = (count + later_count) as f64;
    if later_count > count {
        (later, earlier, count as f64 / total)
    } else {
        (earlier, later, later_count as f64 / total)
    }
}

/// Partial sums for `channels` channels: as many draws as make the channels fill 8 lanes evenly.
pub(crate) const fn partials(channels: usize) -> usize {
    let mut gcd = 8;
    while !channels.is_multiple_of(gcd) {
        gcd /= 2;
    }
    8 / gcd
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partial_sums_fill_eight_lanes() {
        for (channels, parts) in
            [(0, 1), (1, 8), (2, 4), (3, 8), (4, 2), (7, 8), (8, 1), (12, 2), (16, 1), (24, 1), (33, 8), (1000, 1)]
        {
            assert_eq!(partials(channels), parts, "{channels} channels");
        }
    }
}
