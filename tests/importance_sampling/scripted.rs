//! Random numbers that are written down.

use core::convert::Infallible;
use rand_core::TryRng;
use ratiocv_core::Proposal;
use ratiocv_core::sampling::Discrete;

/// One unit of what a random number in [0, 1) can tell apart.
pub(crate) const PART: f64 = f64::EPSILON / 2.0;

/// Yields the numbers of a script, which must be multiples of 2⁻⁵³ in [0, 1), and panics beyond its end.
#[derive(Debug)]
pub(crate) struct Scripted<'a>(pub(crate) &'a [f64]);

impl TryRng for Scripted<'_> {
    type Error = Infallible;
    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        panic!("only u64 are drawn");
    }
    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        let (first, rest) = self.0.split_first().expect("a number more than the script has");
        self.0 = rest;
        Ok(((first / PART) as u64) << 11)
    }
    fn try_fill_bytes(&mut self, _: &mut [u8]) -> Result<(), Infallible> {
        panic!("only u64 are drawn");
    }
}

/// What `draw` makes of `script`, all of which it must use.
pub(crate) fn played<T>(script: &[f64], draw: impl FnOnce(&mut Scripted<'_>) -> T) -> T {
    let mut rng = Scripted(script);
    let result = draw(&mut rng);
    assert!(rng.0.is_empty(), "{} numbers were not drawn", rng.0.len());
    result
}

/// The first and the last number that make `choice` choose `index`; `None` if it has probability 0.
pub(crate) fn first_and_last<const B: usize>(choice: &Discrete<B>, index: usize) -> Option<[f64; 2]> {
    let below: f64 = (0..index).map(|i| choice.pdf(&i)).sum(); // exact: multiples of 2⁻⁵³
    let p = choice.pdf(&index);
    (p > 0.0).then_some([below, below + p - PART])
}
