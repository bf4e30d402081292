//! Five co-moments of 16 channels with intrinsics, written once for every width of vectors.

/// `$merged`, blocks merged into `f64` state, and `$bare`, the sums of one block alone, by these intrinsics.
macro_rules! comoments {
    (
        $merged:ident, $bare:ident, $feature:tt, $lanes:literal,
        $f32:ident: $zero_ps:ident $load_ps:ident $store_ps:ident $add_ps:ident $sub_ps:ident $mul_ps:ident,
        $f64:ident: $zero_pd:ident $splat_pd:ident $load_pd:ident $store_pd:ident $add_pd:ident $sub_pd:ident
            $mul_pd:ident,
        $convert:ident $load_half:ident
    ) => {
        use super::state::{BLOCK, Block, Draw16, State};
        use crate::answer::Answer;
        use crate::contender::Contender;
        use core::arch::x86_64::*;

        /// Lanes of a pack of `f32`.
        const LANES: usize = $lanes;
        const PACKS: usize = 16 / LANES;
        /// Lanes of a pack of `f64`.
        const WIDE: usize = LANES / 2;

        /// Blocks as long as ours, about their first draw in `f32`, merged in `f64` (Chan, Golub, LeVeque 1983).
        pub(crate) struct $merged(State);

        /// The sums alone, one block of all draws: what cannot be done faster.
        pub(crate) struct $bare(Block);

        impl $merged {
            pub(crate) fn new() -> Option<Self> {
                is_x86_feature_detected!($feature).then(|| Self(State::default()))
            }
        }

        impl $bare {
            pub(crate) fn new() -> Option<Self> {
                is_x86_feature_detected!($feature).then(|| Self(Block::default()))
            }
        }

        impl Contender<Draw16> for $merged {
            fn pass(&mut self, draws: &[Draw16]) {
                for block in draws.chunks(BLOCK) {
                    // SAFETY: `new` found the feature.
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

        impl Contender<Draw16> for $bare {
            fn pass(&mut self, draws: &[Draw16]) {
                // SAFETY: `new` found the feature.
                self.0 = unsafe { sums(draws) };
            }
            fn answer(&self) -> Vec<Answer> {
                self.0.answer()
            }
        }

        #[inline]
        #[target_feature(enable = $feature)]
        fn load(x: &[f32; 16], pack: usize) -> $f32 {
            let lanes = &x.as_chunks::<LANES>().0[pack];
            // SAFETY: `lanes` is a pack of numbers.
            unsafe { $load_ps(lanes.as_ptr()) }
        }

        #[inline]
        #[target_feature(enable = $feature)]
        fn store(x: &mut [f32; 16], packs: [$f32; PACKS]) {
            for (lanes, pack) in x.as_chunks_mut::<LANES>().0.iter_mut().zip(packs) {
                // SAFETY: `lanes` is a pack of numbers.
                unsafe { $store_ps(lanes.as_mut_ptr(), pack) };
            }
        }

        /// The sums of a block: 5 sums a pack in registers, 10 operations a pack and draw.
        #[target_feature(enable = $feature)]
        fn sums(draws: &[Draw16]) -> Block {
            let mut block = Block::about_first_of(draws);
            let shift: [[$f32; PACKS]; 2] =
                core::array::from_fn(|i| core::array::from_fn(|p| load(&block.shift[i], p)));
            let zero = [$zero_ps(); PACKS];
            let [mut sum_f, mut sum_h, mut sum_ff, mut sum_fh, mut sum_hh] = [zero; 5];
            for draw in draws {
                for p in 0..PACKS {
                    let f = $sub_ps(load(&draw.f.0, p), shift[0][p]);
                    let h = $sub_ps(load(&draw.h[0].0, p), shift[1][p]);
                    sum_f[p] = $add_ps(sum_f[p], f);
                    sum_h[p] = $add_ps(sum_h[p], h);
                    sum_ff[p] = $add_ps(sum_ff[p], $mul_ps(f, f));
                    sum_fh[p] = $add_ps(sum_fh[p], $mul_ps(f, h));
                    sum_hh[p] = $add_ps(sum_hh[p], $mul_ps(h, h));
                }
            }
            for (x, packs) in block.sums.iter_mut().zip([sum_f, sum_h, sum_ff, sum_fh, sum_hh]) {
                store(x, packs);
            }
            block
        }

        #[inline]
        #[target_feature(enable = $feature)]
        fn widen(x: &[f32; 16], pack: usize) -> $f64 {
            let lanes = &x.as_chunks::<WIDE>().0[pack];
            // SAFETY: `lanes` is a pack of numbers.
            unsafe { $convert($load_half(lanes.as_ptr())) }
        }

        /// x ← change(x) in one pack of `f64`.
        #[inline]
        #[target_feature(enable = $feature)]
        fn update(x: &mut [f64; 16], pack: usize, add: impl FnOnce($f64) -> $f64) {
            let lanes = &mut x.as_chunks_mut::<WIDE>().0[pack];
            // SAFETY: `lanes` is a pack of numbers, read and written.
            unsafe { $store_pd(lanes.as_mut_ptr(), add($load_pd(lanes.as_ptr()))) };
        }

        /// Appends a block.
        #[target_feature(enable = $feature)]
        fn merge(state: &mut State, block: &Block) {
            let total = state.count + block.count;
            let per_draw = $splat_pd(1.0 / block.count);
            let fraction = $splat_pd(block.count / total);
            let weight = $splat_pd(state.count * (block.count / total));
            state.count = total;
            for p in 0..16 / WIDE {
                let [f, h, ff, fh, hh] = &block.sums;
                let (sum_f, sum_h) = (widen(f, p), widen(h, p));
                let (sum_ff, sum_fh, sum_hh) = (widen(ff, p), widen(fh, p), widen(hh, p));
                let (f, h) = ($mul_pd(sum_f, per_draw), $mul_pd(sum_h, per_draw));
                let ff = $sub_pd(sum_ff, $mul_pd(sum_f, f));
                let fh = $sub_pd(sum_fh, $mul_pd(sum_f, h));
                let hh = $sub_pd(sum_hh, $mul_pd(sum_h, h));
                let (mut df, mut dh) = ($zero_pd(), $zero_pd());
                update(&mut state.f, p, |mean| {
                    df = $sub_pd($add_pd(widen(&block.shift[0], p), f), mean);
                    $add_pd(mean, $mul_pd(df, fraction))
                });
                update(&mut state.h, p, |mean| {
                    dh = $sub_pd($add_pd(widen(&block.shift[1], p), h), mean);
                    $add_pd(mean, $mul_pd(dh, fraction))
                });
                let (wf, wh) = ($mul_pd(df, weight), $mul_pd(dh, weight));
                update(&mut state.ff, p, |sum| $add_pd(sum, $add_pd(ff, $mul_pd(df, wf))));
                update(&mut state.fh, p, |sum| $add_pd(sum, $add_pd(fh, $mul_pd(df, wh))));
                update(&mut state.hh, p, |sum| $add_pd(sum, $add_pd(hh, $mul_pd(dh, wh))));
            }
        }
    };
}
pub(super) use comoments;
