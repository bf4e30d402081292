//! The divider's bound: independent divisions f/h of loaded numbers in AVX2, and their sum.

use crate::answer::Answer;
use crate::contender::Contender;
use core::arch::x86_64::*;
use ratiocv_core::{Draw, Spectrum};

/// Σf/h over the draws of the last pass, of 16 channels.
pub(crate) struct Divider<T> {
    count: f64,
    sums: [T; 16],
}

impl<T: Default + Copy> Divider<T> {
    pub(crate) fn new() -> Option<Self> {
        is_x86_feature_detected!("avx2").then(|| Self { count: 0.0, sums: [T::default(); 16] })
    }
}

macro_rules! divider {
    ($float:ty, $lanes:literal, $kernel:ident, $zero:ident, $load:ident, $divide:ident, $add:ident, $store:ident) => {
        impl Contender<Draw<Spectrum<$float, 16>>> for Divider<$float> {
            fn pass(&mut self, draws: &[Draw<Spectrum<$float, 16>>]) {
                self.count = draws.len() as f64;
                // SAFETY: `new` found AVX2.
                self.sums = unsafe { $kernel(draws) };
            }
            fn answer(&self) -> Vec<Answer> {
                let answer = |sum| Answer { r: Some(f64::from(sum) / self.count), ..Answer::default() };
                self.sums.into_iter().map(answer).collect()
            }
        }

        #[target_feature(enable = "avx2")]
        fn $kernel(draws: &[Draw<Spectrum<$float, 16>>]) -> [$float; 16] {
            let mut packs = [$zero(); 16 / $lanes];
            for draw in draws {
                let (f, h) = (draw.f.0.as_chunks::<$lanes>().0, draw.h[0].0.as_chunks::<$lanes>().0);
                for (sum, (f, h)) in packs.iter_mut().zip(f.iter().zip(h)) {
                    // SAFETY: each is as many numbers as are loaded.
                    let (f, h) = unsafe { ($load(f.as_ptr()), $load(h.as_ptr())) };
                    *sum = $add(*sum, $divide(f, h));
                }
            }
            let mut sums = [0.0; 16];
            for (lanes, pack) in sums.as_chunks_mut::<$lanes>().0.iter_mut().zip(packs) {
                // SAFETY: as many numbers are written.
                unsafe { $store(lanes.as_mut_ptr(), pack) };
            }
            sums
        }
    };
}

divider!(f32, 8, singles, _mm256_setzero_ps, _mm256_loadu_ps, _mm256_div_ps, _mm256_add_ps, _mm256_storeu_ps);
divider!(f64, 4, doubles, _mm256_setzero_pd, _mm256_loadu_pd, _mm256_div_pd, _mm256_add_pd, _mm256_storeu_pd);
