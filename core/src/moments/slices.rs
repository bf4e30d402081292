//! Channels whose number is known only at run time, in memory that the caller owns.
//!
//! Channels are independent, so M of them are pieces of `V::LANES` channels, each an accumulator like any
//! other. What depends on all M is the order of summation: draw i of a block goes to partial sum i mod P,
//! P = 8/gcd(M, 8), run by run, and the P sums are folded in a fixed tree. So the bits are those of
//! `Spectrum<_, M>`, whatever the pieces.
//!
//! Rows are added four at a time to as many pieces as fit the cache of level 1 with all their partial sums:
//! what is in memory is read once, in long stretches, and a channel's `f64` state is touched once per block.

use crate::draw::Draw;
use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::{Estimator, Sample};
use crate::integrals::Integrals;
use crate::lanes::{Lanes, Scalar};
use crate::moments::accumulate::{Accumulate, Merge, Moments, same_length};
use crate::moments::blocked::Blocked;
use crate::moments::kernel::{Kernel, State, Takes, partials};
use crate::moments::run::BLOCK;
use crate::planted::planted;
use core::fmt;
use num_traits::float::FloatCore;

/// Blocks on the stack, twice: 32 KiB of co-moments of 16 lanes in `f32`.
const PARTS: usize = 64;

/// Rows that are added before their sums are stored again.
const ROWS: usize = 4;

/// Moments of M channels, M known at run time: `V::LANES` of them in each accumulator of a slice that the
/// caller owns.
///
/// Draws are rows of M numbers, f and each of `K` auxiliaries in arrays of their own. The same calls give the
/// same bits as one accumulator of `Spectrum<_, M>`, for any `V`. `Spectrum<f32, 16>` is a good `V`; one
/// accumulator of it takes 96 bytes per channel for [`Comoments`](super::Comoments), 48 for
/// [`Sums`](super::Sums), and 16 bytes. The last accumulator repeats channels of the one before where M is no
/// multiple; lanes to spare where M is less than `V::LANES` hold anything.
///
/// ```
/// use ratiocv_core::{moments::{Slices, Sums}, Error, RatioOfMeans, Spectrum};
/// type Piece = Sums<Spectrum<f32, 16>>;
/// let channels = 50_usize;
/// let mut memory = vec![Piece::default(); channels.div_ceil(16)];
/// let mut moments = Slices::new(&mut memory, channels)?;
/// let h: Vec<f32> = (0..1000 * channels).map(|i| 1.0 + (i % 7) as f32).collect();
/// let f: Vec<f32> = h.iter().map(|h| 3.0 * h).collect();
/// moments.add_batch(&f, [&h])?;
/// let mut values = vec![0.0; channels];
/// moments.estimate(&RatioOfMeans, |_| [0.5], |channel, estimate| values[channel] = estimate.value)?;
/// assert!(values.iter().all(|value| (value - 1.5).abs() < 1e-15));
/// assert_eq!(moments.count(), 1000);
/// # Ok::<(), Error>(())
/// ```
pub struct Slices<'a, V, B: Kernel> {
    pieces: &'a mut [Blocked<V, B>],
    channels: usize,
}

// By hand: a derive would not ask it of the state.
impl<V, B: Kernel> fmt::Debug for Slices<'_, V, B>
where
    Blocked<V, B>: fmt::Debug,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Slices").field("pieces", &self.pieces).field("channels", &self.channels).finish()
    }
}

/// The channel in lane `lane` of accumulator `piece`.
#[inline(always)]
fn channel_of<V: Lanes>(channels: usize, piece: usize, lane: usize) -> usize {
    let first = (piece * V::LANES).min(channels.saturating_sub(V::LANES));
    (first + lane).min(channels.saturating_sub(1))
}

impl<V: Lanes, const K: usize> Integrals<V, K> {
    /// Those of accumulator `piece` of [`Slices`] of `channels` channels, for accumulators with parameters.
    ///
    /// ```
    /// use ratiocv_core::{moments::{RatioVariance, Slices}, Error, Integrals, Spectrum};
    /// let (channels, weight) = (5, 0.25);
    /// let integral = |channel: usize| [1.0 + channel as f64];
    /// let piece = |i| RatioVariance::<Spectrum<f64, 4>>::defensive(weight, &Integrals::of_piece(channels, i, integral));
    /// let mut memory = [piece(0)?, piece(1)?];
    /// let mut moments = Slices::new(&mut memory, channels)?;
    /// moments.add(&[2.0, 4.0, 6.0, 8.0, 10.0], [&[1.0, 2.0, 3.0, 4.0, 5.0]])?; // f = 2h, h = H
    /// assert_eq!((moments.channels(), moments.count()), (5, 1));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn of_piece(channels: usize, piece: usize, integral: impl Fn(usize) -> [f64; K]) -> Self {
        Self(core::array::from_fn(|k| V::Wide::from_fn(|lane| integral(channel_of::<V>(channels, piece, lane))[k])))
    }
}

impl<'a, V: Lanes, B: Kernel> Slices<'a, V, B> {
    /// `channels` channels in as many accumulators as they fill, `channels.div_ceil(V::LANES)`.
    ///
    /// # Errors
    /// [`Error::Parameter`] if there are more or fewer.
    pub fn new(pieces: &'a mut [Blocked<V, B>], channels: usize) -> Result<Self, Error> {
        if V::LANES == 0 || pieces.len() != channels.div_ceil(V::LANES) {
            let needed = "the number of channels divided by the lanes of one accumulator, rounded up";
            return Err(Error::Parameter { parameter: "the number of accumulators", got: pieces.len() as f64, needed });
        }
        Ok(Self { pieces, channels })
    }

    /// The number of channels.
    pub const fn channels(&self) -> usize {
        self.channels
    }

    /// The number of draws so far; 0 where there are no channels.
    pub fn count(&self) -> u64 {
        self.pieces.first().map_or(0, Moments::count)
    }

    /// Appends the draws of `later`, as if they had come after one's own; see [`Merge`].
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless there are as many channels in both; then nothing is merged.
    pub fn merge(&mut self, later: &Slices<'_, V, B>) -> Result<(), Error> {
        same_length("the list of channels to be merged", self.channels, later.channels)?;
        for (piece, later) in self.pieces.iter_mut().zip(&*later.pieces) {
            piece.merge(later);
        }
        Ok(())
    }

    /// Calls `each` with every channel in order and its estimate; `integrals` says the known integrals
    /// of a channel.
    ///
    /// # Errors
    /// As of [`Estimator::estimate`]; the channels before the bad one have been handed out.
    pub fn estimate<E: Estimator<<B::State as State>::Channel, K>, const K: usize>(
        &self,
        estimator: &E,
        integrals: impl Fn(usize) -> [f64; K],
        mut each: impl FnMut(usize, ChannelEstimate),
    ) -> Result<(), Error> {
        let epsilon = <V::Scalar as FloatCore>::epsilon().widen();
        for (i, piece) in self.pieces.iter().enumerate() {
            let closed = piece.closed();
            let count = closed.count();
            let first = channel_of::<V>(self.channels, i, 0);
            for channel in (i * V::LANES..self.channels).take(V::LANES) {
                let sample = Sample { channel, count, epsilon, moments: &closed.channel(channel - first) };
                let integrals = integrals(channel);
                estimator.check(&sample, &integrals).map_err(|error| match error {
                    Error::OtherAuxiliary { estimator, .. } => Error::OtherAuxiliary { estimator, channel },
                    other => other,
                })?;
                each(channel, estimator.estimate_channel(&sample, &integrals));
            }
        }
        Ok(())
    }
}

impl<V: Lanes, B: Kernel> Slices<'_, V, B> {
    /// Adds one draw: f, and each auxiliary, of every channel.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless each has as many entries as there are channels; then nothing is added.
    #[inline]
    pub fn add<const K: usize>(&mut self, f: &[V::Scalar], h: [&[V::Scalar]; K]) -> Result<(), Error>
    where
        B: Takes<Draw<V, K>>,
    {
        same_length("f", self.channels, f.len())?;
        self.add_batch(f, h)
    }

    /// Adds draws in order, a row of all channels each: `f[i * channels + channel]`, and so each auxiliary.
    ///
    /// The same bits as [`add_batch`](Accumulate::add_batch) of an accumulator of `Spectrum<_, M>`. Takes
    /// 64 KiB of stack for co-moments of 16 lanes in `f32`, in proportion for others.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] if a row is not complete, or an auxiliary has more or fewer of them than f;
    /// then nothing is added.
    #[inline]
    pub fn add_batch<const K: usize>(&mut self, f: &[V::Scalar], h: [&[V::Scalar]; K]) -> Result<(), Error>
    where
        B: Takes<Draw<V, K>>,
    {
        let draws = f.len().checked_div(self.channels).unwrap_or(0);
        if f.len() != draws * self.channels {
            let expected = (draws + usize::from(self.channels > 0)) * self.channels;
            return Err(Error::LengthMismatch { what: "f", expected, got: f.len() });
        }
        for h in h {
            same_length("h", f.len(), h.len())?;
        }
        let Some(first) = self.pieces.first() else { return Ok(()) };
        let partials = planted!("slices_partials": partials(self.channels), partials(V::LANES));
        let rows = Rows { f, h, row: self.channels, draws };
        let mut parts = [[B::empty(&first.state); PARTS]; 2];
        let (whole, last) = self.pieces.split_at_mut(self.channels / V::LANES);
        let at_once = PARTS / partials;
        for (i, pieces) in whole.chunks_mut(at_once).enumerate() {
            add_in_order(pieces, &rows.from(i * at_once * V::LANES), &mut parts, partials);
        }
        // It overlaps the one before, and is not in line with it.
        add_in_order(last, &rows.from(self.channels.saturating_sub(V::LANES)), &mut parts, partials);
        Ok(())
    }
}

/// Draws, row by row.
#[derive(Clone, Copy)]
struct Rows<'d, S, const K: usize> {
    f: &'d [S],
    h: [&'d [S]; K],
    /// Entries in a row.
    row: usize,
    draws: usize,
}

impl<'d, S: Scalar, const K: usize> Rows<'d, S, K> {
    /// From entry `entry` on.
    #[inline(always)]
    fn from(&self, entry: usize) -> Self {
        let from = |entries: &'d [S]| entries.get(entry..).unwrap_or_default();
        Self { f: from(self.f), h: self.h.map(from), ..*self }
    }

    /// Draws `draw..draw + draws`.
    #[inline(always)]
    fn part(&self, draw: usize, draws: usize) -> Self {
        Self { draws, ..self.from(draw * self.row) }
    }

    /// The lanes from entry `entry` on. Where a row is shorter than the lanes, those to spare hold what comes
    /// next; if nothing does, which only happens if `careful`, 0.
    #[inline(always)]
    fn draw<V: Lanes<Scalar = S>>(&self, entry: usize, careful: bool) -> Option<Draw<V, K>> {
        let lanes = |entries: &[S]| {
            if careful {
                let rest = entries.get(entry..)?;
                return Some(V::from_fn(|i| rest.get(i).copied().unwrap_or(S::ZERO)));
            }
            let entries = entries.get(entry..entry + V::LANES)?;
            Some(V::from_fn(|i| entries[i]))
        };
        let mut draw = Draw { f: lanes(self.f)?, h: [V::ZERO; K] };
        for (h, entries) in draw.h.iter_mut().zip(self.h) {
            *h = lanes(entries)?;
        }
        Some(draw)
    }
}

/// Draws in the order of `Blocked::add_batch`: the first ones singly, blocks, then what is left; `rows` from
/// the first channel of the pieces on.
#[inline(always)]
fn add_in_order<V: Lanes, B: Takes<Draw<V, K>>, const K: usize>(
    pieces: &mut [Blocked<V, B>],
    rows: &Rows<'_, V::Scalar, K>,
    [sums, of_run]: &mut [[B; PARTS]; 2],
    partials: usize,
) {
    let Some(piece) = pieces.first() else { return };
    let singles = piece.singles(rows.draws);
    add_singly(pieces, &rows.part(0, singles));
    let used = partials * pieces.len();
    let full = (rows.draws - singles) / BLOCK * BLOCK;
    if let (Some(sums), Some(of_run)) = (sums.get_mut(..used), of_run.get_mut(..used)) {
        let mut done = 0;
        while done < full {
            let block = BLOCK * pieces.first().map_or(1, |piece| piece.runs_at_once((full - done) / BLOCK));
            add_block(pieces, &rows.part(singles + done, block), sums, of_run);
            done += block;
        }
    }
    add_singly(pieces, &rows.part(singles + full, rows.draws - singles - full));
}

fn add_singly<V: Lanes, B: Takes<Draw<V, K>>, const K: usize>(
    pieces: &mut [Blocked<V, B>],
    rows: &Rows<'_, V::Scalar, K>,
) {
    for draw in 0..rows.draws {
        for (i, piece) in pieces.iter_mut().enumerate() {
            if let Some(draw) = rows.draw(draw * rows.row + i * V::LANES, true) {
                piece.add(draw);
            }
        }
    }
}

/// One block of pieces side by side: `sums` are those of all its runs, part by part, `of_run` those of one.
#[inline(always)]
fn add_block<V: Lanes, B: Takes<Draw<V, K>>, const K: usize>(
    pieces: &mut [Blocked<V, B>],
    rows: &Rows<'_, V::Scalar, K>,
    sums: &mut [B],
    of_run: &mut [B],
) {
    let count = pieces.len();
    for piece in &mut *pieces {
        piece.close();
    }
    begin(pieces, rows, sums);
    for run in (0..rows.draws).step_by(BLOCK) {
        begin(pieces, rows, of_run);
        let rows_of_run = rows.part(run, BLOCK);
        // Only the last rows of short ones may lack room for all lanes.
        if (BLOCK - 1) * rows.row + count * V::LANES <= rows_of_run.f.len() {
            add_run(rows_of_run, run, count, of_run, false);
        } else {
            add_run(rows_of_run, run, count, of_run, true);
        }
        for (sums, of_run) in sums.iter_mut().zip(&*of_run) {
            sums.fold(of_run);
        }
    }
    let mut width = sums.len() / 2;
    while width >= count {
        let (left, right) = sums.split_at_mut(width);
        for (left, right) in left.iter_mut().zip(right) {
            left.fold(right);
        }
        width /= 2;
    }
    for (piece, sums) in pieces.iter_mut().zip(sums) {
        let state = sums.close(&piece.state, rows.draws as u64);
        piece.absorb(&state, rows.draws as u64);
    }
}

/// Empty sums, part by part, that know the first draws of a block.
#[inline(always)]
fn begin<V: Lanes, B: Takes<Draw<V, K>>, const K: usize>(
    pieces: &[Blocked<V, B>],
    rows: &Rows<'_, V::Scalar, K>,
    parts: &mut [B],
) {
    for (i, piece) in pieces.iter().enumerate() {
        let mut empty = B::empty(&piece.state);
        for index in 0..2 {
            if let Some(draw) = rows.draw(index * rows.row + i * V::LANES, true) {
                empty.begin(index, &draw);
            }
        }
        for part in parts.iter_mut().skip(i).step_by(pieces.len()) {
            *part = empty;
        }
    }
}

/// Adds a run, whose first draw is the `start`-th of its block.
#[inline(always)]
fn add_run<V: Lanes, B: Takes<Draw<V, K>>, const K: usize>(
    rows: Rows<'_, V::Scalar, K>,
    start: usize,
    pieces: usize,
    parts: &mut [B],
    careful: bool,
) {
    let partials = parts.len() / pieces.max(1);
    // Seen from outside, as in `Blocked`: otherwise the loop is not vectorised.
    let parts = core::hint::black_box(parts);
    for (column, parts) in parts.chunks_exact_mut(pieces).enumerate() {
        for first in (column..BLOCK).step_by(ROWS * partials) {
            // A few rows at once: their sums are read and written once.
            for (i, part) in parts.iter_mut().enumerate() {
                let mut sums = *part;
                for row in 0..ROWS {
                    let index = first + row * partials;
                    let Some(draw) = rows.draw(index * rows.row + i * V::LANES, careful) else { return };
                    sums.add(start + index, &draw);
                }
                *part = sums;
            }
        }
    }
}
