//! `statrs`: a statistic at a time over an iterator of `f64`.

use crate::answer::Answer;
use crate::contender::Contender;
use ratiocv_core::{Draw, Lanes};
use statrs::statistics::Statistics;

/// Mean, variance and covariance, each a walk over one channel. The draws are put into columns of `f64`
/// beforehand, which it is not charged for.
pub(crate) struct Statrs {
    columns: Vec<[Vec<f64>; 2]>,
    answers: Vec<Answer>,
}

impl Statrs {
    pub(crate) fn new<V: Lanes<Scalar = f32>>(draws: &[Draw<V>]) -> Self {
        let column = |of: &dyn Fn(&Draw<V>) -> f32| draws.iter().map(|draw| f64::from(of(draw))).collect();
        let channel = |i| [column(&|draw| draw.f.get(i)), column(&|draw| draw.h[0].get(i))];
        Self { columns: (0..V::LANES).map(channel).collect(), answers: Vec::new() }
    }
}

impl<D> Contender<D> for Statrs {
    fn pass(&mut self, _: &[D]) {
        self.answers.clear();
        for [f, h] in &self.columns {
            self.answers.push(Answer::comoments([
                f.mean(),
                h.mean(),
                f.population_variance(),
                f.population_covariance(h),
                h.population_variance(),
            ]));
        }
    }
    fn answer(&self) -> Vec<Answer> {
        self.answers.clone()
    }
}
