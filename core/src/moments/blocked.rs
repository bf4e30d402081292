//! Blocks of 64 draws, merged into `f64` state: the loop that every accumulator shares.

use crate::lanes::Lanes;
use crate::moments::accumulate::{Accumulate, Merge, Moments};
use core::marker::PhantomData;

/// Draws in a full block.
///
/// 64 draws keep `f32` sums short enough for an error of a few units in the last place, and make
/// closing and merging a block cheap beside its draws: for co-moments with one auxiliary about a tenth
/// of the operations.
pub const BLOCK: usize = 64;

/// The first draws of a stream each make a block of their own, so that they reach the `f64` state
/// unrounded and the state knows a slope and a scale before the first sums in `V`'s precision.
const SINGLES: u64 = 4;

/// Sums over the draws of one block, and what they amount to.
///
/// *Implemented by* the kernels of this folder; *called by* [`Blocked`] alone.
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
    /// Into how many partial sums a batch splits a block: draw `i` goes to part `i % PARTIALS`.
    /// A function of the number of channels alone, so that the order of summation, and with it
    /// every bit, is the same for any lane width. A power of two, at most 16.
    const PARTIALS: usize;

    /// A block without draws, for a stream in `state`.
    fn empty(state: &Self::State) -> Self;
    /// Adds the sums of another part of this block.
    fn fold(&mut self, other: &Self);
    /// The state of the `count` draws that were added, with the parameters of `state`.
    fn close(&self, state: &Self::State, count: u64) -> Self::State;
}

/// A [`Kernel`] for draws of type `D`.
pub trait Takes<D>: Kernel {
    /// Tells an empty block its first draw (`index` 0) and its second (1), which are still to be added, for
    /// sums to be taken about.
    fn begin(&mut self, index: usize, draw: &D);
    /// Adds the `index`-th draw of the block.
    fn add(&mut self, index: usize, draw: &D);
}

/// The `f64` state of a stream of draws.
pub trait State: Copy {
    /// The state of one channel.
    type Channel: Copy;

    /// Appends the state of `later_count` further draws. Neither count is 0.
    fn merge(&mut self, count: u64, later: &Self, later_count: u64);
    /// The state of channel `channel`; panics if there is no such channel.
    fn channel(&self, channel: usize) -> Self::Channel;
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

/// Partial sums for `M` channels: as many draws as make the channels fill 16 lanes evenly.
pub(crate) const fn partials(channels: usize) -> usize {
    let mut gcd = 16;
    while !channels.is_multiple_of(gcd) {
        gcd /= 2;
    }
    16 / gcd
}

/// A stream of draws as merged blocks: the accumulator that each kernel `B` becomes.
///
/// `count` draws of state, and an open block of up to [`BLOCK`] more. Made with `Default`, or, where
/// a kernel has parameters, by that kernel's constructor.
#[derive(Debug)]
pub struct Blocked<V, B: Kernel> {
    closed: u64,
    open: u32,
    lanes: PhantomData<V>,
    state: B::State,
    block: B,
}

// By hand: a derive would ask the same of the marker `V`.
impl<V, B: Kernel> Clone for Blocked<V, B> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V, B: Kernel> Copy for Blocked<V, B> {}

impl<V, B: Kernel> Default for Blocked<V, B>
where
    B::State: Default,
{
    fn default() -> Self {
        Self::with_parameters(B::State::default())
    }
}

impl<V, B: Kernel> Blocked<V, B> {
    /// An empty accumulator whose kernel takes its parameters from `state`.
    pub(crate) fn with_parameters(state: B::State) -> Self {
        Self { closed: 0, open: 0, lanes: PhantomData, block: B::empty(&state), state }
    }

    /// The state of all draws so far, the open block included.
    #[inline]
    fn state(&self) -> B::State {
        let mut closed = *self;
        closed.close();
        closed.state
    }

    /// The state before any draw: where kernels keep their parameters.
    pub(crate) fn parameters(self) -> B::State {
        self.state
    }

    #[inline(always)]
    fn absorb(&mut self, part: &B::State, count: u64) {
        if self.closed == 0 {
            self.state = *part;
        } else {
            self.state.merge(self.closed, part, count);
        }
        self.closed += count;
    }

    #[inline]
    fn close(&mut self) {
        if self.open > 0 {
            let count = u64::from(self.open);
            self.open = 0;
            let part = self.block.close(&self.state, count);
            self.absorb(&part, count);
        }
    }
}

impl<V, B: Kernel> Blocked<V, B> {
    /// One full block of its own.
    #[inline(always)]
    fn full_block<D>(&self, draws: &[D; BLOCK]) -> B::State
    where
        B: Takes<D>,
    {
        // The number of partial sums must be a constant for the sums to live in registers.
        match B::PARTIALS {
            1 => self.block_in_parts::<D, 1>(draws),
            2 => self.block_in_parts::<D, 2>(draws),
            4 => self.block_in_parts::<D, 4>(draws),
            8 => self.block_in_parts::<D, 8>(draws),
            _ => self.block_in_parts::<D, 16>(draws),
        }
    }

    /// Draw `i` goes to part `i % P`; the parts are then folded in a fixed tree.
    #[inline(always)]
    fn block_in_parts<D, const P: usize>(&self, draws: &[D; BLOCK]) -> B::State
    where
        B: Takes<D>,
    {
        let mut empty = B::empty(&self.state);
        empty.begin(0, &draws[0]);
        empty.begin(1, &draws[1]);
        let mut parts = [empty; P];
        for (row, draws) in draws.as_chunks::<P>().0.iter().enumerate() {
            for (column, (part, draw)) in parts.iter_mut().zip(draws).enumerate() {
                part.add(P * row + column, draw);
            }
        }
        let mut width = P / 2;
        while width > 0 {
            let (left, right) = parts.split_at_mut(width);
            for (left, right) in left.iter_mut().zip(right) {
                left.fold(right);
            }
            width /= 2;
        }
        parts[0].close(&self.state, BLOCK as u64)
    }
}

impl<V, D: Copy, B: Takes<D>> Accumulate<D> for Blocked<V, B> {
    #[inline(always)]
    fn add(&mut self, draw: D) {
        if self.open < 2 {
            if self.open == 0 {
                self.block = B::empty(&self.state);
            }
            self.block.begin(self.open as usize, &draw);
        }
        self.block.add(self.open as usize, &draw);
        self.open += 1;
        if self.open as usize == BLOCK || self.closed < SINGLES {
            self.close();
        }
    }

    fn add_batch(&mut self, draws: &[D]) {
        // The singles first, one by one, as `add` would.
        let singles = SINGLES.saturating_sub(self.closed).min(draws.len() as u64) as usize;
        let (singles, rest) = draws.split_at(singles);
        for draw in singles {
            self.add(*draw);
        }
        let (blocks, tail) = rest.as_chunks::<BLOCK>();
        if !blocks.is_empty() {
            self.close();
        }
        for block in blocks {
            let part = self.full_block(block);
            self.absorb(&part, BLOCK as u64);
        }
        for draw in tail {
            self.add(*draw);
        }
    }
}

impl<V: Lanes, B: Kernel> Moments for Blocked<V, B> {
    type Lanes = V;
    type Channel = <B::State as State>::Channel;

    #[inline]
    fn count(&self) -> u64 {
        self.closed + u64::from(self.open)
    }
    #[inline]
    fn closed(&self) -> Self {
        let mut closed = *self;
        closed.close();
        closed
    }
    #[inline]
    fn channel(&self, channel: usize) -> Self::Channel {
        // Closed moments are read in place: a copy of all lanes for each of them would cost their square.
        if self.open == 0 { self.state.channel(channel) } else { self.state().channel(channel) }
    }
}

impl<V: Lanes, B: Kernel> Merge for Blocked<V, B> {
    fn merge(&mut self, later: &Self) {
        // The empty state is the identity, to the bit, on either side.
        if later.count() == 0 {
            return;
        }
        if self.count() == 0 {
            *self = *later;
            return;
        }
        self.close();
        let count = later.count();
        self.absorb(&later.state(), count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partial_sums_fill_sixteen_lanes() {
        for (channels, parts) in
            [(1, 16), (2, 8), (3, 16), (4, 4), (7, 16), (8, 2), (12, 4), (16, 1), (24, 2), (32, 1), (1000, 2)]
        {
            assert_eq!(partials(channels), parts, "{channels} channels");
        }
    }
}
