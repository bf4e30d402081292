//! Σf and Σh of 16 channels in AVX2: nothing shifted, nothing merged, all in `f32`.

use super::state::Draw16;
use crate::answer::Answer;
use crate::contender::Contender;
use core::arch::x86_64::*;

/// Sums of f and h over the draws of the last pass.
pub(crate) struct RawSums {
    count: f64,
    sums: [[f32; 8]; 4],
}

impl RawSums {
    pub(crate) fn new() -> Option<Self> {
        is_x86_feature_detected!("avx2").then_some(Self { count: 0.0, sums: [[0.0; 8]; 4] })
    }
}

impl Contender<Draw16> for RawSums {
    fn pass(&mut self, draws: &[Draw16]) {
        self.count = draws.len() as f64;
        // SAFETY: `new` found AVX2.
        self.sums = unsafe { sums(draws) };
    }
    fn answer(&self) -> Vec<Answer> {
        let mean = |i: usize, half: usize| Some(f64::from(self.sums[half + i / 8][i % 8]) / self.count);
        (0..16).map(|i| Answer { f: mean(i, 0), h: mean(i, 2), ..Answer::default() }).collect()
    }
}

/// Two draws at a time: eight sums hide the latency of an addition.
#[target_feature(enable = "avx2")]
fn sums(draws: &[Draw16]) -> [[f32; 8]; 4] {
    let mut even = [_mm256_setzero_ps(); 4];
    let mut odd = even;
    let (pairs, rest) = draws.as_chunks::<2>();
    for pair in pairs {
        for (sum, x) in even.iter_mut().zip(packs(&pair[0])) {
            *sum = _mm256_add_ps(*sum, x);
        }
        for (sum, x) in odd.iter_mut().zip(packs(&pair[1])) {
            *sum = _mm256_add_ps(*sum, x);
        }
    }
    for draw in rest {
        for (sum, x) in even.iter_mut().zip(packs(draw)) {
            *sum = _mm256_add_ps(*sum, x);
        }
    }
    let mut sums = [[0.0; 8]; 4];
    for i in 0..4 {
        // SAFETY: 8 numbers are written to 8.
        unsafe { _mm256_storeu_ps(sums[i].as_mut_ptr(), _mm256_add_ps(even[i], odd[i])) };
    }
    sums
}

/// f and h, two packs each.
#[inline]
#[target_feature(enable = "avx2")]
fn packs(draw: &Draw16) -> [__m256; 4] {
    let (f, h) = (&draw.f.0, &draw.h[0].0);
    [load(f, 0), load(f, 1), load(h, 0), load(h, 1)]
}

#[inline]
#[target_feature(enable = "avx2")]
fn load(x: &[f32; 16], pack: usize) -> __m256 {
    let lanes = &x.as_chunks::<8>().0[pack];
    // SAFETY: `lanes` is 8 numbers.
    unsafe { _mm256_loadu_ps(lanes.as_ptr()) }
}
