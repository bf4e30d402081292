//! Our accumulators.

use crate::answer::Answer;
use crate::contender::Contender;
use ratiocv_core::moments::{Accumulate, HasComoments, HasMeans, HasRatioMean, Moments};

/// An accumulator, the call that hands it a slice of draws, and what to read off its channels.
pub(crate) struct Ours<D, M: Moments> {
    moments: M,
    add: fn(&mut M, &[D]),
    read: fn(&M::Channel, f64) -> Answer,
}

impl<D, M: Moments + Accumulate<D>> Ours<D, M> {
    /// Fed by [`Accumulate::add_batch`].
    pub(crate) fn new(moments: M, read: fn(&M::Channel, f64) -> Answer) -> Self {
        Self::fed_by(moments, M::add_batch, read)
    }
}

impl<D, M: Moments> Ours<D, M> {
    /// Fed by `add`.
    pub(crate) fn fed_by(moments: M, add: fn(&mut M, &[D]), read: fn(&M::Channel, f64) -> Answer) -> Self {
        Self { moments, add, read }
    }
}

impl<D, M: Moments> Contender<D> for Ours<D, M> {
    fn pass(&mut self, draws: &[D]) {
        (self.add)(&mut self.moments, draws);
    }
    fn answer(&self) -> Vec<Answer> {
        let (moments, count) = (self.moments.closed(), self.moments.count() as f64);
        let channels = <M::Lanes as ratiocv_core::Lanes>::LANES;
        (0..channels).map(|channel| (self.read)(&moments.channel(channel), count)).collect()
    }
}

/// Means.
pub(crate) fn means<C: HasMeans>(channel: &C, count: f64) -> Answer {
    let means = channel.means(count as u64);
    Answer { f: Some(means.f), h: Some(means.h[0]), ..Answer::default() }
}

/// The five co-moments.
pub(crate) fn comoments<C: HasComoments>(channel: &C, count: f64) -> Answer {
    let (means, spread) = (channel.means(count as u64), channel.comoments());
    let [ff, fh, hh] = [spread.ff(), spread.fh(0), spread.hh[0][0]].map(|sum| sum / count);
    Answer::comoments([means.f, means.h[0], ff, fh, hh])
}

/// Mean of f/h and, where it is kept, its variance.
pub(crate) fn ratios<C: HasRatioMean>(channel: &C, count: f64) -> Answer {
    let ratio = channel.ratio(0.0, 1.0).expect("the auxiliary is a raw one");
    Answer { r: Some(ratio.mean), rr: ratio.squares.map(|sum| sum / count), ..Answer::default() }
}

/// Means and the mean of f/h.
pub(crate) fn means_and_ratio<C: HasMeans + HasRatioMean>(channel: &C, count: f64) -> Answer {
    Answer { r: ratios(channel, count).r, ..means(channel, count) }
}

/// The five co-moments and the mean of f/h.
pub(crate) fn comoments_and_ratio<C: HasComoments + HasRatioMean>(channel: &C, count: f64) -> Answer {
    Answer { r: ratios(channel, count).r, ..comoments(channel, count) }
}
