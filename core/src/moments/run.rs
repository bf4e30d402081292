//! Runs: draws of a batch that are summed in one go, in the one loop that must be fast.

use crate::draw::Draw;
use crate::lanes::Lanes;
use crate::moments::kernel::Takes;
use core::hint::black_box;

/// Draws that are summed in one go: a run of a batch, or the block that draws make one by one.
///
/// 64 draws keep `f32` sums short enough for an error of a few units in the last place.
pub const BLOCK: usize = 64;

/// [`BLOCK`] draws of a batch, wherever they lie.
pub(crate) trait Run<D> {
    /// Draw `i`; panics beyond the last one.
    fn draw(&self, i: usize) -> D;
}

impl<D: Copy> Run<D> for &[D; BLOCK] {
    #[inline(always)]
    fn draw(&self, i: usize) -> D {
        self[i]
    }
}

impl<D: Copy> Run<D> for [D; BLOCK] {
    #[inline(always)]
    fn draw(&self, i: usize) -> D {
        self[i]
    }
}

impl<V: Lanes> Run<Draw<V>> for (&[V; BLOCK], &[V; BLOCK]) {
    #[inline(always)]
    fn draw(&self, i: usize) -> Draw<V> {
        Draw::new(self.0[i], self.1[i])
    }
}

/// Adds the sums of a run, whose first draw is the `start`-th of the block, to those of the runs before.
#[inline(always)]
pub(crate) fn add_run<D, B: Takes<D>, R: Run<D>, const P: usize>(
    sums: &mut B::Beside<P>,
    empty: &B::Beside<P>,
    start: usize,
    run: &R,
) {
    // Seen from outside, sums are in memory before and after the loop. Otherwise what becomes of them in
    // `f64` halves the width of the vectors that the compiler makes of the loop, or prevents them: 12
    // instructions per sample and channel of co-moments, not 3.
    let mut of_run = *black_box(empty);
    for row in 0..BLOCK / P {
        let draws: [D; P] = core::array::from_fn(|column| run.draw(P * row + column));
        B::add_beside(&mut of_run, start + P * row, &draws);
    }
    B::fold_beside(sums, &of_run);
    black_box(sums);
}
