//! `average::Covariance`: Welford's updates, a draw and a channel at a time, with two divisions each.

use crate::answer::Answer;
use crate::contender::Contender;
use average::Covariance;
use ratiocv_core::{Draw, Lanes};

/// Pixels of `M` channels each, lane `channel * pixels + pixel`: pixel by pixel, as a renderer would, the
/// channels of a pixel side by side.
pub(crate) struct Average<const M: usize> {
    pixels: Vec<[Covariance; M]>,
}

impl<const M: usize> Average<M> {
    pub(crate) fn new(pixels: usize) -> Self {
        Self { pixels: (0..pixels).map(|_| core::array::from_fn(|_| Covariance::new())).collect() }
    }
}

impl<V: Lanes<Scalar = f32>, const M: usize> Contender<Draw<V>> for Average<M> {
    fn pass(&mut self, draws: &[Draw<V>]) {
        let width = self.pixels.len();
        for (pixel, channels) in self.pixels.iter_mut().enumerate() {
            for draw in draws {
                for (i, channel) in channels.iter_mut().enumerate() {
                    let lane = i * width + pixel;
                    channel.add(f64::from(draw.f.get(lane)), f64::from(draw.h[0].get(lane)));
                }
            }
        }
    }
    fn answer(&self) -> Vec<Answer> {
        let answer = |of: &Covariance| {
            let (ff, hh) = (of.population_variance_x(), of.population_variance_y());
            Answer::comoments([of.mean_x(), of.mean_y(), ff, of.population_covariance(), hh])
        };
        (0..M).flat_map(|i| self.pixels.iter().map(move |channels| answer(&channels[i]))).collect()
    }
}
