//! Blocks of draws, merged into `f64` state: the loop that every accumulator shares.

use crate::draw::Draw;
use crate::error::Error;
use crate::lanes::Lanes;
use crate::moments::accumulate::{Accumulate, AccumulateSlices, Merge, Moments, same_length};
use crate::moments::save::Save;
use crate::planted::planted;
use core::hint::black_box;
use core::iter;
use core::marker::PhantomData;

/// Draws that are summed in one go: a run of a batch, or the block that draws make one by one.
///
/// 64 draws keep `f32` sums short enough for an error of a few units in the last place.
pub const BLOCK: usize = 64;

/// Runs of a batch that share a beginning, an end and a merge. A merge costs as much as 64 to 128
/// draws; sixteen runs, added up one after another, make it a few per cent of a batch and lengthen the
/// sums by sixteen terms.
const RUNS: usize = 16;

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
    /// Into how many partial sums a batch splits a run: draw `i` goes to part `i % PARTIALS`.
    /// A function of the number of channels alone, so that the order of summation, and with it
    /// every bit, is the same for any lane width. A power of two, at most 8.
    const PARTIALS: usize;
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

/// [`Kernel`]'s parts of a kernel of lanes that has a `map` over them: side by side as lanes.
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
            parts.fold(others);
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

/// [`BLOCK`] draws of a batch, wherever they lie.
pub(crate) trait Run<D> {
    /// Draw `i`; panics beyond the last one.
    fn draw(&self, i: usize) -> D;
}

impl<D: Copy> Run<D> for &[D; BLOCK] {
    #[inline(always)]
    fn draw(&self, i: usize) -> D {
        self[i]
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
    /// Calls `each` with every number, parameters included, in a fixed order: see [`Save`].
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

/// A stream of draws as merged blocks: the accumulator that each kernel `B` becomes.
///
/// `count` draws of state, and an open block of up to [`BLOCK`] more. Made with `Default`, or, where
/// a kernel has parameters, by that kernel's constructor.
#[derive(Debug)]
pub struct Blocked<V, B: Kernel> {
    closed: u64,
    open: u32,
    lanes: PhantomData<V>,
    pub(super) state: B::State,
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

    // Out of line, like all that is not done for each draw: it halves the time of a build.
    #[inline(never)]
    pub(super) fn absorb(&mut self, part: &B::State, count: u64) {
        if self.closed == 0 {
            self.state = *part;
        } else {
            self.state.merge(self.closed, part, count);
        }
        self.closed += count;
    }

    #[inline]
    pub(super) fn close(&mut self) {
        if self.open > 0 {
            let count = u64::from(self.open);
            self.open = 0;
            let part = self.block.close(&self.state, count);
            self.absorb(&part, count);
        }
    }
}

impl<D: Copy> Run<D> for [D; BLOCK] {
    #[inline(always)]
    fn draw(&self, i: usize) -> D {
        self[i]
    }
}

impl<V: Lanes> Run<Draw<V>> for (&[V; BLOCK], &[V; BLOCK]) {
    #[inline(always)]
    fn draw(&self, i: usize) -> Draw<V> {
        Draw::new(self.0[i], self.1[i])
    }
}

impl<V, B: Kernel> Blocked<V, B> {
    /// Makes up to [`RUNS`] runs a block of their own.
    #[inline(always)]
    fn add_block<D, R: Run<D>>(&mut self, runs: impl Iterator<Item = R>)
    where
        B: Takes<D>,
    {
        self.close();
        // The number of partial sums must be a constant for the sums to live in registers.
        match B::PARTIALS {
            1 => self.block_in_parts::<D, R, 1>(runs),
            2 => self.block_in_parts::<D, R, 2>(runs),
            4 => self.block_in_parts::<D, R, 4>(runs),
            _ => self.block_in_parts::<D, R, 8>(runs),
        }
    }

    /// Draw `i` of a run goes to part `i % P`; the runs are added up in their order.
    #[inline(always)]
    fn block_in_parts<D, R: Run<D>, const P: usize>(&mut self, mut runs: impl Iterator<Item = R>)
    where
        B: Takes<D>,
    {
        let Some(first) = runs.next() else { return };
        let mut empty = B::empty(&self.state);
        empty.begin(0, &first.draw(0));
        empty.begin(1, &first.draw(1));
        let empty = empty.beside::<P>();
        let mut sums = empty;
        add_run::<D, B, R, P>(&mut sums, &empty, 0, &first);
        let mut count = BLOCK;
        for run in runs {
            add_run::<D, B, R, P>(&mut sums, &empty, count, &run);
            count += BLOCK;
        }
        self.absorb_parts::<P>(&sums, count as u64);
    }

    /// Folds the parts in a fixed tree, and merges what they amount to.
    #[inline(never)]
    fn absorb_parts<const P: usize>(&mut self, sums: &B::Beside<P>, count: u64) {
        let mut parts: [B; P] = core::array::from_fn(|part| B::part(sums, part));
        let mut width = P / 2;
        while width > 0 {
            let (left, right) = parts.split_at_mut(width);
            for (left, right) in left.iter_mut().zip(right) {
                left.fold(right);
            }
            width /= 2;
        }
        let part = parts[0].close(&self.state, count);
        self.absorb(&part, count);
    }

    /// Adds draws that make no run.
    #[inline(never)]
    fn add_singly<D: Copy>(&mut self, draws: impl Iterator<Item = D>)
    where
        B: Takes<D>,
    {
        for draw in draws {
            self.add(draw);
        }
    }

    /// How many of `runs` runs make the next block: one to begin with, for the state to know a slope from
    /// more than the singles before it relies on it for long.
    #[inline(always)]
    pub(super) fn runs_at_once(&self, runs: usize) -> usize {
        runs.min(if self.closed < BLOCK as u64 { 1 } else { RUNS })
    }

    /// How many of a batch's draws go in one by one before its runs: those that make blocks of one.
    #[inline(always)]
    pub(super) fn singles(&self, draws: usize) -> usize {
        SINGLES.saturating_sub(self.closed).min(draws as u64) as usize
    }
}

/// Adds the sums of a run, whose first draw is the `start`-th of the block, to those of the runs before.
#[inline(always)]
fn add_run<D, B: Takes<D>, R: Run<D>, const P: usize>(
    sums: &mut B::Beside<P>,
    empty: &B::Beside<P>,
    start: usize,
    run: &R,
) {
    // Seen from outside, sums are in memory before and after the loop. Otherwise what becomes of them in
    // `f64` halves the width of the vectors that the compiler makes of the loop, or prevents them: 12
    // instructions per sample and channel of co-moments, not 3.
    let mut of_run = *black_box(empty);
    for row in 0..BLOCK / P {
        let draws: [D; P] = core::array::from_fn(|column| run.draw(P * row + column));
        B::add_beside(&mut of_run, start + P * row, &draws);
    }
    B::fold_beside(sums, &of_run);
    black_box(sums);
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

    // Inlined into whatever level its caller is compiled for.
    #[inline(always)]
    fn add_batch(&mut self, draws: &[D]) {
        let (singles, rest) = draws.split_at(self.singles(draws.len()));
        let (runs, tail) = rest.as_chunks::<BLOCK>();
        self.add_singly(singles.iter().copied());
        let mut runs = runs;
        while !runs.is_empty() {
            let (block, rest) = runs.split_at(self.runs_at_once(runs.len()));
            self.add_block(block.iter());
            runs = rest;
        }
        self.add_singly(tail.iter().copied());
    }

    #[inline(always)]
    fn add_from(&mut self, count: u64, mut draw: impl FnMut() -> D) {
        let singles = self.singles(usize::try_from(count).unwrap_or(usize::MAX));
        self.add_singly(iter::repeat_with(&mut draw).take(singles));
        let rest = count - singles as u64;
        let mut runs = rest / BLOCK as u64;
        while runs > 0 {
            let some = self.runs_at_once(usize::try_from(runs).unwrap_or(usize::MAX)) as u64;
            self.add_block((0..some).map(|_| core::array::from_fn::<D, BLOCK, _>(|_| draw())));
            runs -= some;
        }
        self.add_singly(iter::repeat_with(draw).take((rest % BLOCK as u64) as usize));
    }
}

impl<V: Lanes, B: Takes<Draw<V>>> AccumulateSlices<V> for Blocked<V, B> {
    #[inline(always)]
    fn add_slices(&mut self, f: &[V], h: &[V]) -> Result<(), Error> {
        same_length(f, h)?;
        let singles = self.singles(f.len());
        let ((single_f, f), (single_h, h)) = (f.split_at(singles), h.split_at(singles));
        let ((runs_f, tail_f), (runs_h, tail_h)) = (f.as_chunks::<BLOCK>(), h.as_chunks::<BLOCK>());
        let draw = |(f, h): (&V, &V)| Draw::new(*f, *h);
        self.add_singly(single_f.iter().zip(single_h).map(draw));
        let (mut runs_f, mut runs_h) = (runs_f, runs_h);
        while !runs_f.is_empty() {
            let at_once = self.runs_at_once(runs_f.len());
            let ((block_f, rest_f), (block_h, rest_h)) = (runs_f.split_at(at_once), runs_h.split_at(at_once));
            self.add_block(block_f.iter().zip(block_h));
            (runs_f, runs_h) = (rest_f, rest_h);
        }
        self.add_singly(tail_f.iter().zip(tail_h).map(draw));
        Ok(())
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

impl<V, B: Kernel> Save for Blocked<V, B> {
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        planted!("save_open": self.close(), self.open = 0);
        each(&mut self.closed);
        self.state.words(each);
    }
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
