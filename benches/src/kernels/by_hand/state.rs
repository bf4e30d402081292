//! What the kernels by hand keep and share.

use crate::answer::Answer;
use ratiocv_core::{Draw, Spectrum};

/// Draws of a block: as many as of ours, 16 runs.
pub(super) const BLOCK: usize = 16 * ratiocv_core::moments::BLOCK;

/// 16 channels of `f32`.
pub(super) type Draw16 = Draw<Spectrum<f32, 16>>;

/// Sums over one block, in `f32`, of f, h, f², fh and h² relative to its first draw.
#[derive(Default)]
pub(super) struct Block {
    pub(super) shift: [[f32; 16]; 2],
    pub(super) sums: [[f32; 16]; 5],
    pub(super) count: f64,
}

impl Block {
    /// Before the sums: about the first of these draws.
    #[inline(always)]
    pub(super) fn about_first_of(draws: &[Draw16]) -> Self {
        let shift = draws.first().map_or([[0.0; 16]; 2], |first| [first.f.0, first.h[0].0]);
        Self { shift, sums: [[0.0; 16]; 5], count: draws.len() as f64 }
    }

    pub(super) fn answer(&self) -> Vec<Answer> {
        let channel = |i: usize| {
            let sums = self.sums.map(|sums| f64::from(sums[i]));
            Answer::from_sums(sums, self.shift.map(|shift| f64::from(shift[i])), self.count)
        };
        (0..16).map(channel).collect()
    }
}

/// All draws so far: means of f and h, sums of squares and products about them.
#[derive(Default)]
pub(super) struct State {
    pub(super) count: f64,
    pub(super) f: [f64; 16],
    pub(super) h: [f64; 16],
    pub(super) ff: [f64; 16],
    pub(super) fh: [f64; 16],
    pub(super) hh: [f64; 16],
}

impl State {
    pub(super) fn answer(&self) -> Vec<Answer> {
        let channel = |i: usize| {
            let [ff, fh, hh] = [self.ff[i], self.fh[i], self.hh[i]].map(|sum| sum / self.count);
            Answer::comoments([self.f[i], self.h[i], ff, fh, hh])
        };
        (0..16).map(channel).collect()
    }
}
