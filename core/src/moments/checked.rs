//! What becomes of draws that are not finite numbers.

use crate::draw::Draw;
use crate::error::Error;
use crate::lanes::Lanes;
use crate::moments::{Accumulate, Means, Merge, Moments, Pairs};
use core::marker::PhantomData;
use num_traits::float::FloatCore;

/// A draw that knows whether its numbers are finite.
///
/// *Implemented by* [`Draw`] and [`Pairs`]; *called by* [`Checked`].
pub trait Finite {
    /// Whether every number of every channel is finite.
    fn is_finite(&self) -> bool;
}

fn finite<V: Lanes>(lanes: &V) -> bool {
    (0..V::LANES).all(|lane| FloatCore::is_finite(lanes.get(lane)))
}

impl<V: Lanes, const K: usize> Finite for Draw<V, K> {
    fn is_finite(&self) -> bool {
        finite(&self.f) && self.h.iter().all(finite)
    }
}

impl<V: Lanes, const K: usize> Finite for Pairs<V, K> {
    fn is_finite(&self) -> bool {
        self.0.iter().all(Finite::is_finite)
    }
}

/// Draws that are not finite are left out, and counted.
#[derive(Clone, Copy, Debug)]
pub struct Skip;

/// One draw that is not finite, and there are no moments any more.
#[derive(Clone, Copy, Debug)]
pub struct Refuse;

/// An accumulator that looks at each draw before it takes it: `P` says what becomes of one that has a number
/// that is not finite.
///
/// Without it, such a number poisons its channel, the estimate of which is NaN or the plain mean, flagged
/// NONFINITE; no other channel changes a bit. That costs nothing, hides nothing, and is the rule. [`Skip`] is
/// for renderers whose users want an image all the same: the *whole* draw is left out, because channels share
/// their number of draws, and what is estimated is the integral without the places where that happens. [`Refuse`]
/// is for pipelines in which it must not happen.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Checked, Refuse, Skip, Sums}, Draw, Error, Estimator, Integrals, RatioOfMeans};
/// let draws = [Draw::new(1.0, 2.0), Draw::new(f64::NAN, 2.0), Draw::new(3.0, 2.0)];
/// let mut pixel = Checked::<Sums<f64>, Skip>::default();
/// pixel.add_batch(&draws);
/// assert_eq!((pixel.skipped(), RatioOfMeans.estimate(&pixel, &Integrals::ONE)?.value), (1, 1.0));
/// let mut pixel = Checked::<Sums<f64>, Refuse>::default();
/// pixel.add_batch(&draws);
/// assert_eq!(pixel.moments().unwrap_err(), Error::NotFinite { draw: 1 });
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Checked<M, P> {
    moments: M,
    seen: u64,
    skipped: u64,
    /// The number of the first draw that was left out.
    first: Option<u64>,
    policy: PhantomData<P>,
}

impl<M: Default, P> Default for Checked<M, P> {
    fn default() -> Self {
        Self::new(M::default())
    }
}

impl<M, P> Checked<M, P> {
    /// The accumulator `moments`, which looks at draws from now on.
    pub const fn new(moments: M) -> Self {
        Self { moments, seen: 0, skipped: 0, first: None, policy: PhantomData }
    }

    /// How many draws were left out.
    pub const fn skipped(&self) -> u64 {
        self.skipped
    }
}

impl<M> Checked<M, Refuse> {
    /// The moments of all draws.
    ///
    /// # Errors
    /// [`Error::NotFinite`] with the number of the first draw that is not finite, counted from 0 over all that
    /// were added and merged.
    pub fn moments(&self) -> Result<&M, Error> {
        match self.first {
            None => Ok(&self.moments),
            Some(draw) => Err(Error::NotFinite { draw }),
        }
    }
}

impl<D: Finite + Copy, M: Accumulate<D>, P> Accumulate<D> for Checked<M, P> {
    fn add(&mut self, draw: D) {
        if draw.is_finite() {
            self.moments.add(draw);
        } else {
            self.first = self.first.or(Some(self.seen));
            self.skipped += 1;
        }
        self.seen += 1;
    }
    fn add_batch(&mut self, draws: &[D]) {
        if draws.iter().all(Finite::is_finite) {
            self.moments.add_batch(draws);
            self.seen += draws.len() as u64;
        } else {
            draws.iter().for_each(|draw| self.add(*draw));
        }
    }
}

impl<M: Merge, P> Merge for Checked<M, P> {
    fn merge(&mut self, later: &Self) {
        self.moments.merge(&later.moments);
        self.first = self.first.or(later.first.map(|draw| self.seen + draw));
        self.seen += later.seen;
        self.skipped += later.skipped;
    }
}

/// The moments of the draws that are finite; [`Refuse`] hands out its own by [`Checked::moments`] alone.
impl<M: Moments> Moments for Checked<M, Skip> {
    type Lanes = M::Lanes;
    type Channel = M::Channel;

    fn count(&self) -> u64 {
        self.moments.count()
    }
    fn closed(&self) -> Self {
        Self { moments: self.moments.closed(), policy: PhantomData, ..*self }
    }
    fn is_closed(&self) -> bool {
        self.moments.is_closed()
    }
    fn channel(&self, channel: usize) -> M::Channel {
        self.moments.channel(channel)
    }
    fn means_alone<const K: usize>(&self, channel: usize) -> Option<Means<K>> {
        self.moments.means_alone(channel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::moments::{Comoments, Mean};
    use crate::spectrum::Spectrum;

    #[test]
    fn every_number_of_a_draw_is_looked_at() {
        let right = Draw { f: Spectrum([1.0_f32, 2.0]), h: [Spectrum([3.0, 4.0]); 2] };
        assert!(right.is_finite());
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for place in 0..6 {
                let mut draw = right;
                let lanes = if place < 2 { &mut draw.f } else { &mut draw.h[place / 2 - 1] };
                lanes[place % 2] = bad;
                assert!(!draw.is_finite(), "{bad} at {place}");
                let pairs = [right.auxiliary(0), draw.auxiliary(place.saturating_sub(2) / 2)];
                assert!(!Pairs(pairs).is_finite() && Pairs([pairs[0]; 2]).is_finite(), "{bad} at {place}");
            }
        }
    }

    #[test]
    fn sound_draws_have_the_bits_of_the_bare_accumulator() {
        let draws: [Draw<f32>; 200] = core::array::from_fn(|i| Draw::new((i * 7 % 11) as f32, (i % 5) as f32));
        let (mut bare, mut checked) = (Comoments::<f32>::default(), Checked::<Comoments<f32>, Refuse>::default());
        bare.add_batch(&draws);
        checked.add_batch(&draws);
        let state = |moments: &Comoments<f32>| std::format!("{:?}", moments.closed());
        assert_eq!(checked.moments().map(state), Ok(state(&bare)));
    }

    #[test]
    fn the_first_bad_draw_is_named_across_merges() {
        let add = |draws: &[f64]| {
            let mut checked = Checked::<Mean<f64, 0>, Refuse>::default();
            draws.iter().for_each(|f| checked.add(Draw { f: *f, h: [] }));
            checked
        };
        let mut all = add(&[1.0, 2.0]);
        all.merge(&add(&[3.0, f64::NAN, f64::NAN]));
        all.merge(&add(&[f64::INFINITY]));
        assert_eq!((all.moments().map(|_| ()), all.skipped()), (Err(Error::NotFinite { draw: 3 }), 3));
    }
}
