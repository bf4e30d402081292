//! Means of the integrand and of each auxiliary: the value tier.

use crate::draw::Draw;
use crate::lanes::Lanes;
use crate::moments::blocked::Blocked;
use crate::moments::kernel::{Kernel, State, Takes, larger_first, partials};
use crate::moments::read::{HasMeans, Means};
use crate::moments::save;
use crate::planted::planted;

/// Means of f and of `K` auxiliaries, and nothing else: what plain Monte Carlo (`K = 0`) and the
/// ratio of means (`K = 1`) need for a value. The standard error is unknown (NaN).
///
/// After 0 draws the means are 0/0 and no estimator accepts them; after 1 draw they are that draw,
/// to the bit. NaN or an infinity in a channel makes that channel's mean NaN.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Sums}, Draw, Estimator, Integrals, RatioOfMeans, Spectrum};
/// let mut pixel = Sums::<Spectrum<f32, 3>>::default();
/// pixel.add(Draw::new(Spectrum([1.0, 2.0, 3.0]), Spectrum([0.5, 1.0, 1.5])));
/// pixel.add(Draw::new(Spectrum([3.0, 2.0, 1.0]), Spectrum([1.5, 1.0, 0.5])));
/// let rgb = RatioOfMeans.estimate(&pixel, &Integrals::ONE)?.value;
/// assert_eq!(rgb, Spectrum([2.0, 2.0, 2.0])); // f = 2h: no noise is left
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
pub type Sums<V, const K: usize = 1> = Blocked<V, SumsBlock<V, K>>;

/// The block kernel of [`Sums`]: sums about the block's first draw.
///
/// The shift keeps Σ of large equal numbers from overflowing and makes constants exact.
#[derive(Clone, Copy, Debug)]
pub struct SumsBlock<V, const K: usize> {
    shift: Draw<V, K>,
    sum: Draw<V, K>,
}

/// The state of [`Sums`]: an anchor (the stream's first draw) and the means relative to it.
#[derive(Clone, Copy, Debug)]
pub struct SumsState<W, const K: usize> {
    anchor: Draw<W, K>,
    relative: Draw<W, K>,
}

impl<W: Lanes, const K: usize> Default for SumsState<W, K> {
    fn default() -> Self {
        Self { anchor: Draw::ZERO, relative: Draw::ZERO }
    }
}

/// Several [`SumsBlock`]s side by side, in the order in which draws lie in memory: whole vectors of them are added
/// as they are, f and h alike, without a shuffle.
#[derive(Clone, Copy, Debug)]
pub struct SumsBeside<V, const K: usize, const P: usize> {
    shift: Draw<V, K>,
    sum: [Draw<V, K>; P],
}

impl<V: Lanes, const K: usize> Kernel for SumsBlock<V, K> {
    type State = SumsState<V::Wide, K>;
    const PARTIALS: usize = partials(V::LANES);
    const LEARNS: bool = false;
    type Beside<const P: usize> = SumsBeside<V, K, P>;

    #[inline(always)]
    fn empty(_: &Self::State) -> Self {
        Self { shift: Draw::ZERO, sum: Draw::ZERO }
    }
    #[inline(always)]
    fn close(&self, _: &Self::State, count: u64) -> Self::State {
        let count = V::Wide::splat(count as f64);
        SumsState { anchor: self.shift.map(V::widen), relative: self.sum.map(|sum| sum.widen() / count) }
    }
    #[inline(always)]
    fn fold(&mut self, other: &Self) {
        self.sum = self.sum.zip(other.sum, V::add);
    }
    #[inline(always)]
    fn beside<const P: usize>(&self) -> SumsBeside<V, K, P> {
        SumsBeside { shift: self.shift, sum: [self.sum; P] }
    }
    #[inline(always)]
    fn part<const P: usize>(parts: &SumsBeside<V, K, P>, part: usize) -> Self {
        Self { shift: parts.shift, sum: parts.sum[part] }
    }
    #[inline(always)]
    fn fold_beside<const P: usize>(parts: &mut SumsBeside<V, K, P>, others: &SumsBeside<V, K, P>) {
        for (sum, other) in parts.sum.iter_mut().zip(&others.sum) {
            *sum = sum.zip(*other, V::add);
        }
    }
}

impl<V: Lanes, const K: usize> Takes<Draw<V, K>> for SumsBlock<V, K> {
    #[inline(always)]
    fn begin(&mut self, index: usize, draw: &Draw<V, K>) {
        if index == 0 {
            self.shift = *draw;
        }
    }
    #[inline(always)]
    fn add(&mut self, _: usize, draw: &Draw<V, K>) {
        self.sum = self.sum.zip(draw.zip(self.shift, V::sub), V::add);
    }
    #[inline(always)]
    fn add_beside<const P: usize>(parts: &mut SumsBeside<V, K, P>, _: usize, draws: &[Draw<V, K>; P]) {
        let shift = parts.shift;
        for (sum, draw) in parts.sum.iter_mut().zip(draws) {
            *sum = sum.zip(draw.zip(shift, V::sub), V::add);
        }
    }
}

impl<W: Lanes<Scalar = f64>, const K: usize> State for SumsState<W, K> {
    type Channel = SumsState<f64, K>;

    #[inline(always)]
    fn merge(&mut self, count: u64, later: &Self, later_count: u64) {
        let (large, small, fraction) = larger_first(*self, count, *later, later_count);
        let apart = small.anchor.zip(large.anchor, W::sub).zip(small.relative.zip(large.relative, W::sub), W::add);
        let relative = large
            .relative
            .zip(apart, |mean, apart| mean + apart * W::splat(planted!("sums_fraction": fraction, 1.0 - fraction)));
        *self = Self { relative, ..large };
    }
    #[inline(always)]
    fn channel(&self, channel: usize) -> SumsState<f64, K> {
        SumsState { anchor: self.anchor.channel(channel), relative: self.relative.channel(channel) }
    }
    #[inline(always)]
    fn means_alone<const L: usize>(&self, channel: usize) -> Option<Means<L>> {
        let Means { f, h } = self.channel(channel).means(0);
        (L == K).then(|| Means { f, h: core::array::from_fn(|k| h[k]) })
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        save::draw(&mut self.anchor, each);
        save::draw(&mut self.relative, each);
    }
}

impl<const K: usize> HasMeans<K> for SumsState<f64, K> {
    #[inline(always)]
    fn means(&self, _: u64) -> Means<K> {
        let mean = self.anchor.zip(self.relative, |anchor, relative| anchor + relative);
        Means { f: mean.f, h: mean.h }
    }
}
