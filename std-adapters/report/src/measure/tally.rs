//! Sums of errors over replicates.

use crate::measure::Coverage;
use crate::measure::coverage::{Counts, Hits};
use ratiocv_core::{ChannelEstimate, Lanes};

/// Mean of a number and the standard error of that mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Average {
    pub(super) mean: f64,
    pub(super) std_error: f64,
}

/// Σx and Σx² of a number x that scatters about 0 or is a square: nothing cancels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Sum {
    first: f64,
    second: f64,
}

impl Sum {
    fn add(&mut self, x: f64) {
        self.first += x;
        self.second += x * x;
    }

    fn append(&mut self, later: &Self) {
        self.first += later.first;
        self.second += later.second;
    }

    fn average(&self, count: u64) -> Average {
        let n = count as f64;
        let mean = self.first / n;
        let variance = ((self.second - n * mean * mean) / (n - 1.0)).max(0.0);
        Average { mean, std_error: libm::sqrt(variance / n) }
    }
}

/// Error and squared error, in units of F, and how intervals did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Errors {
    bias: Sum,
    mse: Sum,
    hits: Hits,
}

/// The errors of one estimator: of each channel, and of their mean.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tally {
    channels: Vec<Errors>,
    all: Errors,
}

impl Tally {
    pub(super) fn new(channels: usize) -> Self {
        Self { channels: vec![Errors::default(); channels], all: Errors::default() }
    }

    /// One estimate, `value`, of `exact`.
    pub(super) fn add<V: Lanes<Scalar = f64>>(&mut self, value: &V, exact: &V) {
        let (mut errors, mut squares) = (0.0, 0.0);
        for (channel, tally) in self.channels.iter_mut().enumerate() {
            let f = exact.get(channel);
            let error = (value.get(channel) - f) / f;
            tally.bias.add(error);
            tally.mse.add(error * error);
            errors += error;
            squares += error * error;
        }
        let channels = self.channels.len() as f64;
        self.all.bias.add(errors / channels);
        self.all.mse.add(squares / channels);
    }

    /// The intervals of one estimate: `channel` gives that of a channel, and what it is an estimate of.
    pub(super) fn judge(&mut self, channel: impl Fn(usize) -> (ChannelEstimate, f64)) {
        let mut counts = Counts::default();
        for (index, tally) in self.channels.iter_mut().enumerate() {
            let (estimate, exact) = channel(index);
            let of_channel = Counts::of(estimate, exact);
            tally.hits.add(of_channel);
            counts.append(&of_channel);
        }
        self.all.hits.add(counts);
    }

    pub(super) fn append(&mut self, later: &Self) {
        for (mine, theirs) in self.channels.iter_mut().zip(&later.channels) {
            mine.append(theirs);
        }
        self.all.append(&later.all);
    }

    /// Bias and MSE of `count` estimates: the mean over channels.
    pub(super) fn all(&self, count: u64) -> (Average, Average) {
        self.all.averages(count)
    }

    /// Bias and MSE of each channel.
    pub(super) fn channels(&self, count: u64) -> impl Iterator<Item = (Average, Average)> {
        self.channels.iter().map(move |errors| errors.averages(count))
    }

    /// Of all channels together; `None` if intervals were not judged.
    pub(super) fn coverage(&self) -> Option<Coverage> {
        self.all.hits.coverage()
    }

    /// Of each channel.
    pub(super) fn coverages(&self) -> impl Iterator<Item = Option<Coverage>> {
        self.channels.iter().map(|errors| errors.hits.coverage())
    }
}

impl Errors {
    fn append(&mut self, later: &Self) {
        self.bias.append(&later.bias);
        self.mse.append(&later.mse);
        self.hits.append(&later.hits);
    }

    fn averages(&self, count: u64) -> (Average, Average) {
        (self.bias.average(count), self.mse.average(count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratiocv_core::Spectrum;

    #[test]
    fn errors_are_in_units_of_the_integral() {
        let mut tally = Tally::new(2);
        let exact = Spectrum([2.0, -10.0]);
        tally.add(&Spectrum([3.0, -10.0]), &exact);
        tally.add(&Spectrum([2.0, -5.0]), &exact);
        let (bias, mse) = tally.all(2);
        assert_eq!((bias.mean, mse.mean), (0.0, 0.125));
        let channels: Vec<_> = tally.channels(2).collect();
        assert_eq!((channels[0].0.mean, channels[0].1.mean), (0.25, 0.125));
        assert_eq!((channels[1].0.mean, channels[1].1.mean), (-0.25, 0.125));
        // Errors 0.5 and 0: variance 1/8, of the mean 1/16.
        assert_eq!(channels[0].0.std_error, 0.25);
    }

    #[test]
    fn parts_append_to_the_whole() {
        let (mut whole, mut left, mut right) = (Tally::new(1), Tally::new(1), Tally::new(1));
        for (part, value) in [(0, 1.5), (0, 0.5), (1, 4.0)] {
            whole.add(&value, &1.0);
            if part == 0 { &mut left } else { &mut right }.add(&value, &1.0);
        }
        left.append(&right);
        assert_eq!(left, whole);
    }
}
