//! The numbers of an accumulator, one by one: what a file, a message or another process needs of it.

use crate::draw::Draw;
use crate::lanes::Lanes;
use crate::planted::planted;

/// Shows all its numbers, to be saved or replaced: one visit serves writing and reading alike.
///
/// *Implemented by* every accumulator of draws; *called by* whoever keeps accumulators outside of
/// memory, such as the checkpoints of `ratiocv-threads`.
///
/// # Laws
/// The number of words and their order depend on the type alone: not on the draws, nor on how the
/// lanes are packed. An accumulator that was given the words of another one of its type *is* that one,
/// [closed](crate::moments::Moments::closed): the same estimates, parameters such as a defensive weight
/// included, and further draws and merges give the same bits.
///
/// # Implementing
/// Implement [`State`](crate::moments::State) and use [`Blocked`](crate::moments::Blocked).
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments, Save}, Draw, Estimator, Integrals, RatioOfMeans};
/// let mut pixel = Comoments::<f64>::default();
/// for (f, h) in [(1.0, 0.9), (0.2, 0.3), (2.0, 1.8)] {
///     pixel.add(Draw::new(f, h));
/// }
/// let mut words = Vec::new();
/// pixel.words(&mut |word| words.push(*word));
///
/// let mut saved = words.into_iter();
/// let mut loaded = Comoments::<f64>::default();
/// loaded.words(&mut |word| *word = saved.next().unwrap_or_default());
/// let value = |moments| RatioOfMeans.estimate(moments, &Integrals::ONE).map(|estimate| estimate.value);
/// assert_eq!(value(&loaded), value(&pixel));
/// ```
pub trait Save {
    /// Closes an open block, as a merge does, then calls `each` with every number in turn, an `f64`
    /// as its bits.
    ///
    /// Words that no accumulator of this type has had make one that is not sensible, never a panic
    /// here; a count beyond 2⁶³ may overflow later. Protect what is kept by a checksum.
    fn words(&mut self, each: &mut dyn FnMut(&mut u64));
}

/// Each lane's number; every NaN as the one of `f64::NAN`, because signs and payloads of NaNs are the processor's
/// choice (IEEE 754-2019, 6.2) and checkpoints are not.
pub(crate) fn lanes<W: Lanes<Scalar = f64>>(lanes: &mut W, each: &mut dyn FnMut(&mut u64)) {
    *lanes = W::from_fn(|lane| {
        let number = lanes.get(lane);
        let mut word = if planted!("save_nan": number.is_nan(), false) { f64::NAN.to_bits() } else { number.to_bits() };
        each(&mut word);
        f64::from_bits(word)
    });
}

/// The numbers of f, then of each h.
pub(crate) fn draw<W: Lanes<Scalar = f64>, const K: usize>(draw: &mut Draw<W, K>, each: &mut dyn FnMut(&mut u64)) {
    lanes(&mut draw.f, each);
    all(&mut draw.h, each);
}

/// The numbers of each of `several`.
pub(crate) fn all<W: Lanes<Scalar = f64>>(several: &mut [W], each: &mut dyn FnMut(&mut u64)) {
    for one in several {
        lanes(one, each);
    }
}

/// Each lane's number, in the precision of draws.
pub(crate) fn narrow<V: Lanes>(narrow: &mut V, each: &mut dyn FnMut(&mut u64)) {
    let mut wide = planted!("save_parameters": *narrow, V::ZERO).widen();
    lanes(&mut wide, each);
    *narrow = V::narrow(wide);
}
