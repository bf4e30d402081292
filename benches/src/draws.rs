//! The draws that everything is measured on.

use core::ops::Deref;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use ratiocv_core::{Draw, Lanes};

/// Draws that begin at a cache line: where an allocator puts them must not decide a comparison.
pub(crate) struct Draws<V> {
    chunks: Vec<Chunk<V>>,
    count: usize,
}

const CHUNK: usize = 32;

/// 32 draws, for channels of 4 or 8 bytes a multiple of the alignment.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Chunk<V>([Draw<V>; CHUNK]);

impl<V: Lanes> Draws<V> {
    /// `count` draws with h in \[0.25, 1.75) and f/h about 1, correlated by 0.9 in each channel: neither
    /// zeros nor cancellation, so that inaccurate rivals are right too. `number` rounds.
    pub(crate) fn new(count: usize, number: impl Fn(f64) -> V::Scalar) -> Self {
        const { assert!(size_of::<Chunk<V>>() == CHUNK * size_of::<Draw<V>>()) };
        let mut rng = Pcg64::seed_from_u64(11);
        let mut uniform = || (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        let mut draw = |_| {
            let h: Vec<f64> = (0..V::LANES).map(|_| 0.25 + 1.5 * uniform()).collect();
            let f: Vec<f64> = h.iter().map(|h| 0.1 + 0.7 * h + 0.5 * uniform()).collect();
            Draw::new(V::from_fn(|i| number(f[i])), V::from_fn(|i| number(h[i])))
        };
        let chunks = (0..count.div_ceil(CHUNK)).map(|_| Chunk(core::array::from_fn(&mut draw))).collect();
        Self { chunks, count }
    }
}

impl<V> Deref for Draws<V> {
    type Target = [Draw<V>];
    fn deref(&self) -> &[Draw<V>] {
        // SAFETY: chunks are arrays of draws without anything between them (`new` asserts it), and hold
        // at least `count` draws.
        unsafe { core::slice::from_raw_parts(self.chunks.as_ptr().cast(), self.count) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratiocv_core::Spectrum;

    #[test]
    fn draws_begin_at_a_cache_line_and_are_as_described() {
        for count in [0, 1, 31, 32, 33, 100] {
            let draws = Draws::<Spectrum<f32, 3>>::new(count, |x| x as f32);
            assert_eq!(draws.len(), count);
            assert_eq!(draws.as_ptr().addr() % 64, 0);
            for draw in draws.iter() {
                let (f, h) = (draw.f.0, draw.h[0].0);
                assert!(
                    (0..3).all(|i| (0.25..1.75).contains(&h[i]) && (0.8..2.1).contains(&(f[i] - 0.7 * h[i] + 1.0)))
                );
            }
        }
    }

    #[test]
    fn the_correlation_is_0_9() {
        let draws = Draws::<f64>::new(10_000, |x| x);
        let answer = crate::Answer::reference(&draws)[0];
        let [ff, fh, hh] = [answer.ff, answer.fh, answer.hh].map(|x| x.expect("the reference says all"));
        let correlation = fh / (ff * hh).sqrt();
        assert!((correlation - 0.9).abs() < 0.01, "{correlation}");
    }
}
