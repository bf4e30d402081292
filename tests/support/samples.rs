//! Draws for tests.

use ratiocv_core::moments::Accumulate;
use ratiocv_core::{Draw, Lanes, Scalar};

/// `empty` with `draws` added one by one.
pub fn filled<M: Accumulate<Draw<V>>, V: Lanes>(mut empty: M, draws: impl IntoIterator<Item = (V, V)>) -> M {
    for (f, h) in draws {
        empty.add(Draw::new(f, h));
    }
    empty
}

/// A fixed sequence of numbers in [0, 1) that looks random: SplitMix64 (Steele, Lea, Flood 2014).
#[derive(Clone, Debug)]
pub struct Noise(pub u64);

impl Noise {
    /// The next number.
    pub fn next_unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// `count` draws with h in [½, 1½) and f = h·(1 + noise), every channel its own.
    pub fn draws<V: Lanes>(&mut self, count: usize) -> Vec<Draw<V>> {
        (0..count)
            .map(|_| {
                let h = V::from_fn(|_| V::Scalar::from_f64(0.5 + self.next_unit()));
                let f = V::from_fn(|_| V::Scalar::from_f64(0.75 + 0.5 * self.next_unit())) * h;
                Draw::new(f, h)
            })
            .collect()
    }
}
