//! Blocks of draws, merged into `f64` state: the loop that every accumulator shares.

use crate::draw::Draw;
use crate::error::Error;
use crate::lanes::Lanes;
use crate::moments::accumulate::{Accumulate, AccumulateSlices, Merge, Moments, same_length};
use crate::moments::kernel::{Kernel, State, Takes};
use crate::moments::read::Means;
use crate::moments::run::{BLOCK, Run, add_run};
use crate::moments::save::Save;
use crate::planted::planted;
use core::iter;
use core::marker::PhantomData;

/// Runs of a batch that share a beginning, an end and a merge. A merge costs as much as 64 to 128
/// draws; sixteen runs, added up one after another, make it a few per cent of a batch and lengthen the
/// sums by sixteen terms.
const RUNS: usize = 16;

/// The first draws of a stream each make a block of their own, so that they reach the `f64` state
/// unrounded and the state knows a slope and a scale before the first sums in `V`'s precision.
const SINGLES: u64 = 4;

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

    #[cold]
    #[inline(never)]
    fn channel_of_open(&self, channel: usize) -> <B::State as State>::Channel {
        self.state().channel(channel)
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

    /// How many of a batch's draws go in one by one before its runs: those that make blocks of one, unless a run
    /// can do without them.
    #[inline(always)]
    pub(super) fn singles(&self, draws: usize) -> usize {
        if !B::LEARNS && draws >= BLOCK {
            return 0;
        }
        SINGLES.saturating_sub(self.closed).min(draws as u64) as usize
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

    // Inlined into whatever level its caller is compiled for.
    #[inline(always)]
    fn add_batch(&mut self, draws: &[D]) {
        let (singles, rest) = draws.split_at(self.singles(draws.len()));
        let (runs, tail) = rest.as_chunks::<BLOCK>();
        if !singles.is_empty() {
            self.add_singly(singles.iter().copied());
        }
        let mut runs = runs;
        while !runs.is_empty() {
            let (block, rest) = runs.split_at(self.runs_at_once(runs.len()));
            self.add_block(block.iter());
            runs = rest;
        }
        if !tail.is_empty() {
            self.add_singly(tail.iter().copied());
        }
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
        same_length("h", f.len(), h.len())?;
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
    fn is_closed(&self) -> bool {
        self.open == 0
    }
    #[inline]
    fn channel(&self, channel: usize) -> Self::Channel {
        // Closed moments are read in place: a copy of all lanes for each of them would cost their square.
        if self.is_closed() { self.state.channel(channel) } else { self.channel_of_open(channel) }
    }
    #[inline]
    fn means_alone<const K: usize>(&self, channel: usize) -> Option<Means<K>> {
        if self.is_closed() { self.state.means_alone(channel) } else { None }
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
