//! A hash of results.

use num_traits::float::FloatCore;
use ratiocv_core::{ChannelEstimate, Flags};

/// FNV-1a (Fowler, Noll, Vo 1991), 64 bits at a time.
pub(crate) struct Hash(pub(crate) u64);

impl Hash {
    pub(crate) const EMPTY: Self = Self(0xcbf2_9ce4_8422_2325);

    /// The sign and the payload of a NaN are the processor's choice (IEEE 754-2019, 6.2), so every NaN is one.
    pub(crate) fn word(&mut self, word: u64) {
        let word =
            if f64::from_bits(word).is_nan() { <f64 as FloatCore>::nan().to_bits() & (u64::MAX >> 1) } else { word };
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        self.0 ^= self.0 >> 32;
    }

    pub(crate) fn estimate(&mut self, estimate: &ChannelEstimate) {
        self.word(estimate.value.to_bits());
        self.word(estimate.std_error.to_bits());
        let flags = Flags::ALL.iter().fold(0, |bits, (flag, _)| 2 * bits + u64::from(estimate.flags.contains(*flag)));
        self.word(flags);
    }
}
