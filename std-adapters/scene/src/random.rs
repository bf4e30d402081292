//! Random numbers of a block of samples.

use crate::lanes::{LANES, Lane, in_memory};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro128PlusPlus;

/// The random stream of one block of one pixel, so that an image does not depend on threads or tiles.
pub(crate) struct Random(Xoshiro128PlusPlus);

/// The finisher of SplitMix64 (Steele, Lea and Flood 2014), one to one.
fn mixed(z: u64) -> u64 {
    let z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The upper 24 bits as a number in [0, 1).
#[inline(always)]
const fn unit(bits: u32) -> f32 {
    (bits >> 8) as i32 as f32 * (f32::EPSILON / 2.0)
}

impl Random {
    /// Blocks of one seed differ in the first half of their state if their pixels do, in the second if their
    /// numbers do: no two start alike.
    pub(crate) fn new(seed: u64, [x, y]: [u32; 2], block: u64) -> Self {
        let pixel = u64::from(y) << 32 | u64::from(x);
        // Mixed once more than pixel and block, which may be the same numbers.
        let key = mixed(mixed(seed));
        let halves = [mixed(key ^ mixed(pixel)), mixed(mixed(key) ^ mixed(!block))];
        let mut state = [0; 16];
        for (bytes, half) in state.as_chunks_mut().0.iter_mut().zip(halves) {
            *bytes = half.to_le_bytes();
        }
        Self(Xoshiro128PlusPlus::from_seed(state))
    }

    /// Uniform in [0, 1), a multiple of 2⁻²⁴.
    #[inline(always)]
    pub(crate) fn uniform(&mut self) -> f32 {
        unit(self.0.next_u32())
    }

    /// Eight of them.
    #[inline(always)]
    pub(crate) fn lane(&mut self) -> Lane {
        let mut bits = [0; LANES];
        for bits in &mut bits {
            *bits = self.0.next_u32();
        }
        in_memory(&mut bits);
        let mut lane = bits.map(unit);
        in_memory(&mut lane);
        lane
    }

    #[inline(always)]
    pub(crate) fn uniforms(&mut self) -> [f32; 2] {
        [self.uniform(), self.uniform()]
    }

    /// One of `n`, which must be at most 2¹⁶: exact to 2⁻³².
    #[inline(always)]
    pub(crate) fn below(&mut self, n: usize) -> usize {
        ((u64::from(self.0.next_u32()) * n as u64) >> 32) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_have_streams_of_their_own() {
        let first = |seed, pixel, block| Random::new(seed, pixel, block).0.next_u32();
        let mut seen = std::collections::BTreeSet::new();
        for seed in 0..4 {
            for pixel in [[0, 0], [1, 0], [0, 1], [1, 1]] {
                for block in 0..4 {
                    seen.insert(first(seed, pixel, block));
                }
            }
        }
        assert_eq!(seen.len(), 64);
        assert_eq!(first(1, [2, 3], 4), first(1, [2, 3], 4));
    }

    #[test]
    fn uniform_numbers_stay_below_1_and_choices_in_range() {
        let mut random = Random::new(1, [0, 0], 0);
        let mut counts = [0; 3];
        for _ in 0..30_000 {
            let u = random.uniform();
            assert!((0.0..1.0).contains(&u));
            counts[random.below(3)] += 1;
        }
        // N = 30 000, binomial with σ = 81.6; 6σ: α = 6e-9 for the three.
        assert!(counts.iter().all(|n| (n - 10_000_i32).abs() <= 490), "{counts:?}");
    }
}
