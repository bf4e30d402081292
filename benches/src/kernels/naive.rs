//! The loop that one writes first: raw sums in `f64`. Fast enough, and wrong as soon as the mean is large
//! beside the spread.

use crate::answer::Answer;
use crate::contender::Contender;
use ratiocv_core::{Draw, Spectrum};

/// Raw sums of f, h, f², fh and h² of 16 channels, as the compiler makes them.
#[derive(Default)]
pub(crate) struct Naive {
    count: f64,
    sums: [[f64; 16]; 5],
}

impl Contender<Draw<Spectrum<f32, 16>>> for Naive {
    fn pass(&mut self, draws: &[Draw<Spectrum<f32, 16>>]) {
        let [sum_f, sum_h, sum_ff, sum_fh, sum_hh] = &mut self.sums;
        for draw in draws {
            for i in 0..16 {
                let (f, h) = (f64::from(draw.f[i]), f64::from(draw.h[0][i]));
                sum_f[i] += f;
                sum_h[i] += h;
                sum_ff[i] += f * f;
                sum_fh[i] += f * h;
                sum_hh[i] += h * h;
            }
        }
        self.count += draws.len() as f64;
    }
    fn answer(&self) -> Vec<Answer> {
        (0..16).map(|i| Answer::from_sums(self.sums.map(|sums| sums[i]), [0.0; 2], self.count)).collect()
    }
}
