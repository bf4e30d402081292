//! Random words to order.

use core::convert::Infallible;
use rand_core::TryRng;

/// Random words from a function of their number, instead of a generator.
pub(crate) struct Words<F>(pub(crate) F, u64);

impl<F: FnMut(u64) -> u64> Words<F> {
    pub(crate) fn new(word: F) -> Self {
        Self(word, 0)
    }
}

impl<F: FnMut(u64) -> u64> TryRng for Words<F> {
    type Error = Infallible;
    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        self.try_next_u64().map(|word| (word >> 32) as u32)
    }
    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        self.1 += 1;
        Ok((self.0)(self.1 - 1))
    }
    fn try_fill_bytes(&mut self, _: &mut [u8]) -> Result<(), Infallible> {
        unimplemented!("no one asks for bytes")
    }
}

/// Any seed will do.
pub(crate) fn generator(seed: u64) -> rand_pcg::Pcg64 {
    rand_core::SeedableRng::seed_from_u64(seed)
}
