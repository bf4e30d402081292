//! `average::Covariance`: Welford's updates, a draw and a channel at a time, with two divisions each.

use crate::answer::Answer;
use crate::contender::Contender;
use average::Covariance;
use ratiocv_core::{Draw, Lanes};

/// `P` pixels of `M` channels each, lane `channel * P + pixel`: pixel by pixel, as a renderer would, the
/// channels of a pixel side by side.
pub(crate) struct Average<const M: usize, const P: usize> {
    pixels: [[Covariance; M]; P],
}

impl<const M: usize, const P: usize> Default for Average<M, P> {
    fn default() -> Self {
        Self { pixels: core::array::from_fn(|_| core::array::from_fn(|_| Covariance::new())) }
    }
}

impl<V: Lanes<Scalar = f32>, const M: usize, const P: usize> Contender<Draw<V>> for Average<M, P> {
    fn pass(&mut self, draws: &[Draw<V>]) {
        for (pixel, channels) in self.pixels.iter_mut().enumerate() {
            for draw in draws {
                for (i, channel) in channels.iter_mut().enumerate() {
                    let lane = i * P + pixel;
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
