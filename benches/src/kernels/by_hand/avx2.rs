//! Five co-moments of 16 channels in AVX2.

use super::state::{BLOCK, Block, Draw16, State};
use crate::answer::Answer;
use crate::contender::Contender;
use core::arch::x86_64::*;

/// Lanes of a pack of `f32`.
const LANES: usize = 8;
const PACKS: usize = 16 / LANES;
/// Lanes of a pack of `f64`.
const WIDE: usize = LANES / 2;

/// Blocks as long as ours, about their first draw in `f32`, merged in `f64` (Chan, Golub, LeVeque 1983).
pub(crate) struct Avx2(State);

/// The sums alone, one block of all draws: what cannot be done faster.
pub(crate) struct BareAvx2(Block);

impl Avx2 {
    pub(crate) fn new() -> Option<Self> {
        is_x86_feature_detected!("avx2").then(|| Self(State::default()))
    }
}

impl BareAvx2 {
    pub(crate) fn new() -> Option<Self> {
        is_x86_feature_detected!("avx2").then(|| Self(Block::default()))
    }
}

impl Contender<Draw16> for Avx2 {
    fn pass(&mut self, draws: &[Draw16]) {
        for block in draws.chunks(BLOCK) {
            // SAFETY: `new` found AVX2.
            unsafe {
                let block = sums(block);
                merge(&mut self.0, &block);
            }
        }
    }
    fn answer(&self) -> Vec<Answer> {
        self.0.answer()
    }
}

impl Contender<Draw16> for BareAvx2 {
    fn pass(&mut self, draws: &[Draw16]) {
        // SAFETY: `new` found AVX2.
        self.0 = unsafe { sums(draws) };
    }
    fn answer(&self) -> Vec<Answer> {
        self.0.answer()
    }
}

#[inline]
#[target_feature(enable = "avx2")]
fn load(x: &[f32; 16], pack: usize) -> __m256 {
    let lanes = &x.as_chunks::<LANES>().0[pack];
    // SAFETY: `lanes` is 8 numbers.
    unsafe { _mm256_loadu_ps(lanes.as_ptr()) }
}

#[inline]
#[target_feature(enable = "avx2")]
fn store(x: &mut [f32; 16], packs: [__m256; PACKS]) {
    for (lanes, pack) in x.as_chunks_mut::<LANES>().0.iter_mut().zip(packs) {
        // SAFETY: `lanes` is 8 numbers.
        unsafe { _mm256_storeu_ps(lanes.as_mut_ptr(), pack) };
    }
}

/// The sums of a block: two packs of 8 lanes: 10 sums in registers, 10 operations a pack and draw.
#[target_feature(enable = "avx2")]
fn sums(draws: &[Draw16]) -> Block {
    let mut block = Block::about_first_of(draws);
    let shift: [[__m256; PACKS]; 2] = core::array::from_fn(|i| core::array::from_fn(|p| load(&block.shift[i], p)));
    let zero = [_mm256_setzero_ps(); PACKS];
    let [mut sum_f, mut sum_h, mut sum_ff, mut sum_fh, mut sum_hh] = [zero; 5];
    for draw in draws {
        for p in 0..PACKS {
            let f = _mm256_sub_ps(load(&draw.f.0, p), shift[0][p]);
            let h = _mm256_sub_ps(load(&draw.h[0].0, p), shift[1][p]);
            sum_f[p] = _mm256_add_ps(sum_f[p], f);
            sum_h[p] = _mm256_add_ps(sum_h[p], h);
            sum_ff[p] = _mm256_add_ps(sum_ff[p], _mm256_mul_ps(f, f));
            sum_fh[p] = _mm256_add_ps(sum_fh[p], _mm256_mul_ps(f, h));
            sum_hh[p] = _mm256_add_ps(sum_hh[p], _mm256_mul_ps(h, h));
        }
    }
    for (x, packs) in block.sums.iter_mut().zip([sum_f, sum_h, sum_ff, sum_fh, sum_hh]) {
        store(x, packs);
    }
    block
}

#[inline]
#[target_feature(enable = "avx2")]
fn widen(x: &[f32; 16], pack: usize) -> __m256d {
    let lanes = &x.as_chunks::<WIDE>().0[pack];
    // SAFETY: `lanes` is 4 numbers.
    unsafe { _mm256_cvtps_pd(_mm_loadu_ps(lanes.as_ptr())) }
}

/// x ← change(x) in one pack of `f64`.
#[inline]
#[target_feature(enable = "avx2")]
fn update(x: &mut [f64; 16], pack: usize, add: impl FnOnce(__m256d) -> __m256d) {
    let lanes = &mut x.as_chunks_mut::<WIDE>().0[pack];
    // SAFETY: `lanes` is 4 numbers, read and written.
    unsafe { _mm256_storeu_pd(lanes.as_mut_ptr(), add(_mm256_loadu_pd(lanes.as_ptr()))) };
}

/// Appends a block.
#[target_feature(enable = "avx2")]
fn merge(state: &mut State, block: &Block) {
    let total = state.count + block.count;
    let per_draw = _mm256_set1_pd(1.0 / block.count);
    let fraction = _mm256_set1_pd(block.count / total);
    let weight = _mm256_set1_pd(state.count * (block.count / total));
    state.count = total;
    for p in 0..16 / WIDE {
        let [f, h, ff, fh, hh] = &block.sums;
        let (sum_f, sum_h) = (widen(f, p), widen(h, p));
        let (sum_ff, sum_fh, sum_hh) = (widen(ff, p), widen(fh, p), widen(hh, p));
        let (f, h) = (_mm256_mul_pd(sum_f, per_draw), _mm256_mul_pd(sum_h, per_draw));
        let ff = _mm256_sub_pd(sum_ff, _mm256_mul_pd(sum_f, f));
        let fh = _mm256_sub_pd(sum_fh, _mm256_mul_pd(sum_f, h));
        let hh = _mm256_sub_pd(sum_hh, _mm256_mul_pd(sum_h, h));
        let (mut df, mut dh) = (_mm256_setzero_pd(), _mm256_setzero_pd());
        update(&mut state.f, p, |mean| {
            df = _mm256_sub_pd(_mm256_add_pd(widen(&block.shift[0], p), f), mean);
            _mm256_add_pd(mean, _mm256_mul_pd(df, fraction))
        });
        update(&mut state.h, p, |mean| {
            dh = _mm256_sub_pd(_mm256_add_pd(widen(&block.shift[1], p), h), mean);
            _mm256_add_pd(mean, _mm256_mul_pd(dh, fraction))
        });
        let (wf, wh) = (_mm256_mul_pd(df, weight), _mm256_mul_pd(dh, weight));
        update(&mut state.ff, p, |sum| _mm256_add_pd(sum, _mm256_add_pd(ff, _mm256_mul_pd(df, wf))));
        update(&mut state.fh, p, |sum| _mm256_add_pd(sum, _mm256_add_pd(fh, _mm256_mul_pd(df, wh))));
        update(&mut state.hh, p, |sum| _mm256_add_pd(sum, _mm256_add_pd(hh, _mm256_mul_pd(dh, wh))));
    }
}
