//! Plain Monte Carlo as one would write it for M channels of `f32` alone: the same blocks and the same `f64`
//! state as ours, no traits.

/// The mean of f of M channels: anchor, mean relative to it, number of draws.
#[derive(Debug)]
pub(crate) struct PlainByHand<const M: usize> {
    anchor: [f64; M],
    relative: [f64; M],
    count: u64,
}

impl<const M: usize> PlainByHand<M> {
    pub(crate) const EMPTY: Self = Self { anchor: [0.0; M], relative: [0.0; M], count: 0 };

    /// Adds a multiple of 1024 draws.
    pub(crate) fn add_batch(&mut self, draws: &[[f32; M]]) {
        for block in draws.as_chunks::<1024>().0 {
            let shift = block[0];
            let mut sums = [0.0_f32; M];
            for run in block.as_chunks::<64>().0 {
                add_run(&mut sums, &shift, run);
            }
            self.merge(&shift, &sums, 1024);
        }
    }

    #[inline(never)]
    fn merge(&mut self, shift: &[f32; M], sums: &[f32; M], count: u64) {
        let total = (self.count + count) as f64;
        for (i, shift) in shift.iter().map(|shift| f64::from(*shift)).enumerate() {
            let mean = f64::from(sums[i]) / count as f64;
            if self.count == 0 {
                (self.anchor[i], self.relative[i]) = (shift, mean);
            } else {
                let apart = (shift - self.anchor[i]) + (mean - self.relative[i]);
                self.relative[i] += apart * (count as f64 / total);
            }
        }
        self.count += count;
    }
}

// A function of its own: inlined, it would be compiled together with the `f64` half, and to half the width.
#[inline(never)]
fn add_run<const M: usize>(sums: &mut [f32; M], shift: &[f32; M], run: &[[f32; M]; 64]) {
    let mut of_run = [0.0_f32; M];
    for draw in run {
        for i in 0..M {
            of_run[i] += draw[i] - shift[i];
        }
    }
    for i in 0..M {
        sums[i] += of_run[i];
    }
}
