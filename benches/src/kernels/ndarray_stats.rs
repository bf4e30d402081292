//! `ndarray-stats`: the covariance matrix of f and h, a channel at a time.

use crate::answer::Answer;
use crate::contender::Contender;
use ndarray::{Array2, Axis};
use ndarray_stats::CorrelationExt;
use ratiocv_core::{Draw, Lanes};

/// Means and covariance matrix of a 2×N matrix of `f64` per channel, made beforehand, which it is not
/// charged for. One matrix of all channels would do 16 times the work.
pub(crate) struct NdarrayStats {
    channels: Vec<Array2<f64>>,
    answers: Vec<Answer>,
}

impl NdarrayStats {
    pub(crate) fn new<V: Lanes<Scalar = f32>>(draws: &[Draw<V>]) -> Self {
        let channel = |i| {
            Array2::from_shape_fn((2, draws.len()), |(row, draw)| {
                let draw = &draws[draw];
                f64::from(if row == 0 { draw.f.get(i) } else { draw.h[0].get(i) })
            })
        };
        Self { channels: (0..V::LANES).map(channel).collect(), answers: Vec::new() }
    }
}

impl<D> Contender<D> for NdarrayStats {
    fn pass(&mut self, _: &[D]) {
        self.answers.clear();
        for channel in &self.channels {
            let means = channel.mean_axis(Axis(1)).expect("there are draws");
            let matrix = channel.cov(0.0).expect("there are draws");
            let comoments = [means[0], means[1], matrix[[0, 0]], matrix[[0, 1]], matrix[[1, 1]]];
            self.answers.push(Answer::comoments(comoments));
        }
    }
    fn answer(&self) -> Vec<Answer> {
        self.answers.clone()
    }
}
