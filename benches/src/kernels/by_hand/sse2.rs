//! The naive loop as a default build has it, whatever this build is for: two lanes of `f64` at a time.

use super::state::Draw16;
use crate::answer::Answer;
use crate::contender::Contender;
use core::arch::x86_64::*;

/// Raw sums of f, h, f², fh and h² of 16 channels in SSE2, which every x86-64 has.
#[derive(Default)]
pub(crate) struct NaiveSse2 {
    count: f64,
    sums: [[f64; 16]; 5],
}

impl Contender<Draw16> for NaiveSse2 {
    fn pass(&mut self, draws: &[Draw16]) {
        // SAFETY: every x86-64 has SSE2.
        unsafe { add(&mut self.sums, draws) };
        self.count += draws.len() as f64;
    }
    fn answer(&self) -> Vec<Answer> {
        (0..16).map(|i| Answer::from_sums(self.sums.map(|sums| sums[i]), [0.0; 2], self.count)).collect()
    }
}

#[target_feature(enable = "sse2")]
fn add(sums: &mut [[f64; 16]; 5], draws: &[Draw16]) {
    for draw in draws {
        for pair in 0..8 {
            let (f, h) = (widen(&draw.f.0, pair), widen(&draw.h[0].0, pair));
            let terms = [f, h, _mm_mul_pd(f, f), _mm_mul_pd(f, h), _mm_mul_pd(h, h)];
            for (sums, term) in sums.iter_mut().zip(terms) {
                let sums = &mut sums.as_chunks_mut::<2>().0[pair];
                // SAFETY: two numbers are read and written.
                unsafe { _mm_storeu_pd(sums.as_mut_ptr(), _mm_add_pd(_mm_loadu_pd(sums.as_ptr()), term)) };
            }
        }
    }
}

#[inline]
#[target_feature(enable = "sse2")]
fn widen(x: &[f32; 16], pair: usize) -> __m128d {
    let pair = &x.as_chunks::<2>().0[pair];
    // SAFETY: two numbers, 8 bytes, are read.
    let pair = unsafe { _mm_loadl_epi64(pair.as_ptr().cast()) };
    _mm_cvtps_pd(_mm_castsi128_ps(pair))
}
