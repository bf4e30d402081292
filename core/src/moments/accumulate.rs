//! What every accumulator of draws can do.

use crate::draw::Draw;
use crate::error::Error;
use crate::lanes::Lanes;
use crate::moments::read::Means;
use crate::moments::save::Save;

/// Takes draws of type `D` and keeps moments of them.
///
/// *Implemented by* the accumulators of this folder; *called by* the driver loop
/// ([`Problem::integrate`](crate::Problem::integrate)) and by renderers that already hold draws.
///
/// # Laws
/// The same calls give the same bits, on every platform and for any lane width. The same draws
/// split into other calls (`add` one by one, `add_batch` in pieces) give the same moments up to
/// rounding: each mean to 41 units of the last place of the lane's precision, times the range of the
/// numbers (a block is summed about its first draw, which may be the outlier), and of `f64`'s two for
/// each block, times the range, and one, times the largest. A channel that receives NaN or an infinity
/// leaves every other channel's bits alone. These are the functions of `conformance`.
///
/// # Implementing
/// Implement [`Takes`](crate::moments::Takes) and use [`Blocked`](crate::moments::Blocked). Otherwise, leave
/// `add_from` as it is only if `add_batch` adds one by one too.
pub trait Accumulate<D> {
    /// Adds one draw.
    fn add(&mut self, draw: D);
    /// Adds draws in order: faster than one by one from 64 draws on, fastest from 1024 on.
    fn add_batch(&mut self, draws: &[D]);
    /// Adds `count` draws that are made one after another: the bits of [`add_batch`](Self::add_batch) of all of
    /// them at once, in the memory of 64.
    ///
    /// ```
    /// use ratiocv_core::{moments::{Accumulate, Moments, Sums}, Draw};
    /// let (mut moments, mut x) = (Sums::<f64>::default(), 0.0);
    /// moments.add_from(1000, || {
    ///     x += 1.0;
    ///     Draw::new(x, 2.0)
    /// });
    /// assert_eq!((moments.count(), x), (1000, 1000.0));
    /// ```
    fn add_from(&mut self, count: u64, mut draw: impl FnMut() -> D) {
        for _ in 0..count {
            self.add(draw());
        }
    }
}

/// The entry for renderers that keep f and h of their samples in arrays of their own.
///
/// *Implemented by* every accumulator of draws with one auxiliary; *called by* such renderers.
pub trait AccumulateSlices<V: Lanes>: Accumulate<Draw<V>> {
    /// Adds the draws (`f[i]`, `h[i]`) in order: the same bits as [`add_batch`](Accumulate::add_batch) of them.
    ///
    /// ```
    /// use ratiocv_core::{moments::{AccumulateSlices, Moments, Sums}, Error};
    /// let mut moments = Sums::<f32>::default();
    /// moments.add_slices(&[1.0, 2.0, 3.0], &[0.5, 1.0, 1.5])?;
    /// assert_eq!(moments.count(), 3);
    /// let error = moments.add_slices(&[1.0, 2.0], &[0.5]).unwrap_err();
    /// assert_eq!(error, Error::LengthMismatch { what: "h", expected: 2, got: 1 });
    /// assert_eq!(moments.count(), 3); // nothing was added, nothing was lost
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] if there are not as many `h` as `f`; then nothing is added.
    fn add_slices(&mut self, f: &[V], h: &[V]) -> Result<(), Error>;
}

/// An error unless `got` is `expected`.
pub(crate) fn same_length(what: &'static str, expected: usize, got: usize) -> Result<(), Error> {
    if got == expected { Ok(()) } else { Err(Error::LengthMismatch { what, expected, got }) }
}

/// Appends what another accumulator has seen.
///
/// *Implemented by* every accumulator; *called by* whoever ran several in parallel.
///
/// # Laws
/// Merging an empty accumulator, on either side, changes no bit. Whole = the parts merged in
/// order, up to rounding; the same merges give the same bits, so merge in a fixed tree.
pub trait Merge {
    /// Appends the draws that `later` has seen, as if they had come after one's own.
    fn merge(&mut self, later: &Self);
}

/// Hands its moments out, channel by channel, to estimators.
///
/// *Implemented by* every accumulator; *called by* [`Estimator::estimate`](crate::Estimator::estimate).
///
/// # Laws
/// `channel(i)` depends on channel `i` of the draws alone.
pub trait Moments: Sized {
    /// The draws' lanes.
    type Lanes: Lanes;
    /// The moments of one channel.
    type Channel;

    /// The number of draws so far.
    fn count(&self) -> u64;
    /// The same moments with nothing left to merge: to be taken once, before the channels are read.
    #[must_use]
    fn closed(&self) -> Self;
    /// Whether nothing is left to merge, so that the channels may be read as they are.
    ///
    /// ```
    /// use ratiocv_core::{moments::{Accumulate, Moments, Sums}, Draw};
    /// let mut moments = Sums::<f64>::default();
    /// for i in 0..5 {
    ///     moments.add(Draw::new(f64::from(i), 1.0));
    /// }
    /// assert!(!moments.is_closed() && moments.closed().is_closed());
    /// ```
    fn is_closed(&self) -> bool;
    /// The moments of channel `channel`; panics if there is no such channel.
    fn channel(&self, channel: usize) -> Self::Channel;
    /// The means of channel `channel`, with `K` auxiliaries, of closed moments that keep nothing else; `None` of all
    /// others.
    ///
    /// ```
    /// use ratiocv_core::{moments::{Accumulate, Comoments, Moments, Sums}, Draw};
    /// let (mut sums, mut more) = (Sums::<f64>::default(), Comoments::<f64>::default());
    /// for f in [1.0, 3.0] {
    ///     sums.add(Draw::new(f, 1.0));
    ///     more.add(Draw::new(f, 1.0));
    /// }
    /// let means = sums.means_alone::<1>(0).expect("sums");
    /// assert_eq!((means.f, means.h), (2.0, [1.0]));
    /// assert!(more.means_alone::<1>(0).is_none());
    /// assert!(sums.means_alone::<0>(0).is_none()); // other auxiliaries
    /// ```
    #[inline]
    fn means_alone<const K: usize>(&self, channel: usize) -> Option<Means<K>> {
        let _ = channel;
        None
    }
}

/// `f64` blocks for `f32` draws: widens each draw, exactly, before it is added.
///
/// For data whose squares leave the range of `f32`, or where the eighth digit of a variance matters;
/// slower and larger than `f32` blocks.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments, Widened}, Draw, Estimator, Integrals, RatioOfMeans};
/// let mut exact = Widened::<f32, Comoments<f64>>::default();
/// for h in [1e30_f32, 3e30] {
///     exact.add(Draw::new(h, h)); // (2e30)² is beyond f32
/// }
/// let estimate = RatioOfMeans.estimate(&exact, &Integrals::new([2.0]))?;
/// assert_eq!((estimate.value, estimate.std_error), (2.0, 0.0));
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Widened<V, A> {
    inner: A,
    narrow: core::marker::PhantomData<V>,
}

impl<V, A> Widened<V, A> {
    /// Wraps an accumulator of wide draws.
    pub const fn new(inner: A) -> Self {
        Self { inner, narrow: core::marker::PhantomData }
    }
}

impl<V, A: Default> Default for Widened<V, A> {
    fn default() -> Self {
        Self::new(A::default())
    }
}

impl<V: Lanes, A: Accumulate<Draw<V::Wide, K>>, const K: usize> Accumulate<Draw<V, K>> for Widened<V, A> {
    #[inline]
    fn add(&mut self, draw: Draw<V, K>) {
        self.inner.add(draw.widen());
    }
    #[inline]
    fn add_batch(&mut self, draws: &[Draw<V, K>]) {
        let mut draws = draws.iter();
        let count = draws.len() as u64;
        self.inner.add_from(count, || draws.next().map_or(Draw::ZERO, Draw::widen));
    }
    #[inline]
    fn add_from(&mut self, count: u64, mut draw: impl FnMut() -> Draw<V, K>) {
        self.inner.add_from(count, || draw().widen());
    }
}

impl<V: Lanes, A: Accumulate<Draw<V::Wide>>> AccumulateSlices<V> for Widened<V, A> {
    fn add_slices(&mut self, f: &[V], h: &[V]) -> Result<(), Error> {
        same_length("h", f.len(), h.len())?;
        let mut draws = f.iter().zip(h);
        self.inner.add_from(f.len() as u64, || draws.next().map_or(Draw::ZERO, |(f, h)| Draw::new(*f, *h).widen()));
        Ok(())
    }
}

impl<V, A: Merge> Merge for Widened<V, A> {
    fn merge(&mut self, later: &Self) {
        self.inner.merge(&later.inner);
    }
}

impl<V, A: Save> Save for Widened<V, A> {
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        self.inner.words(each);
    }
}

impl<V, A: Moments> Moments for Widened<V, A> {
    type Lanes = A::Lanes;
    type Channel = A::Channel;
    fn count(&self) -> u64 {
        self.inner.count()
    }
    fn closed(&self) -> Self {
        Self::new(self.inner.closed())
    }
    fn is_closed(&self) -> bool {
        self.inner.is_closed()
    }
    fn channel(&self, channel: usize) -> Self::Channel {
        self.inner.channel(channel)
    }
    fn means_alone<const K: usize>(&self, channel: usize) -> Option<Means<K>> {
        self.inner.means_alone(channel)
    }
}
