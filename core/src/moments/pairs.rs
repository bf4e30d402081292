//! Group means of several pairs (f, h) per draw: depths, techniques, each with an auxiliary of its own.

use crate::draw::Draw;
use crate::lanes::Lanes;
use crate::moments::blocked::Blocked;
use crate::moments::groups::{GroupsBlock, GroupsState};
use crate::moments::kernel::{Kernel, State, Takes, add_to_each, kernels_beside};
use crate::moments::read::{Group, HasGroups, HasPairs};

/// One sample's contributions to `K` integrals that are summed in the end: `0[k]` is the draw of
/// depth or technique k, f already multiplied by that technique's weight, h not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pairs<V, const K: usize>(pub [Draw<V>; K]);

impl<V: Lanes, const K: usize> Pairs<V, K> {
    /// Technique k takes w_k·f and its own auxiliary h_k; w_k per channel.
    ///
    /// ```
    /// use ratiocv_core::{moments::Pairs, Draw};
    /// let pairs = Pairs::weighted(Draw { f: 2.0, h: [1.0, 3.0] }, [0.25, 0.75]);
    /// assert_eq!(pairs.0, [Draw::new(0.5, 1.0), Draw::new(1.5, 3.0)]);
    /// ```
    #[inline(always)]
    pub fn weighted(draw: Draw<V, K>, weights: [V; K]) -> Self {
        // A weight of 0 leaves no trace, not even of an f that is not a number.
        let part = |k: usize| (weights[k] * draw.f).except(V::equal(weights[k], V::ZERO));
        Self(core::array::from_fn(|k| Draw::new(part(k), draw.h[k])))
    }
}

/// Means of `K` pairs in each of `G` groups of draws, dealt round robin.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, GroupedPairs, Pairs}, Draw, Estimator, Integrals, DeterministicMixture};
/// let mut moments = GroupedPairs::<f64, 2, 8>::default();
/// for i in 0..64 {
///     let x = (f64::from(i) + 0.5) / 64.0;
///     moments.add(Pairs([Draw::new(x, 2.0 * x), Draw::new(3.0 - 3.0 * x, 1.0 - x)]));
/// }
/// let sum = DeterministicMixture.estimate(&moments, &Integrals::new([1.0, 0.5]))?;
/// assert!((sum.value - 2.0).abs() < 1e-12); // each f is a multiple of its h
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
pub type GroupedPairs<V, const K: usize, const G: usize> = Blocked<V, PairsBlock<V, K, G>>;

/// The block kernel of [`GroupedPairs`].
#[derive(Clone, Copy, Debug)]
pub struct PairsBlock<V, const K: usize, const G: usize>([GroupsBlock<V, G>; K]);

/// The state of [`GroupedPairs`].
#[derive(Clone, Copy, Debug)]
pub struct PairsState<W, const K: usize, const G: usize>([GroupsState<W, G>; K]);

impl<W: Lanes, const K: usize, const G: usize> Default for PairsState<W, K, G> {
    fn default() -> Self {
        Self([GroupsState::default(); K])
    }
}

impl<V: Lanes, const K: usize, const G: usize> Kernel for PairsBlock<V, K, G> {
    type State = PairsState<V::Wide, K, G>;
    const PARTIALS: usize = 1;
    const LEARNS: bool = false;
    kernels_beside!();

    #[inline(always)]
    fn empty(state: &Self::State) -> Self {
        Self(Kernel::empty(&state.0))
    }
    #[inline(always)]
    fn fold(&mut self, other: &Self) {
        self.0.fold(&other.0);
    }
    #[inline(always)]
    fn close(&self, state: &Self::State, count: u64) -> Self::State {
        PairsState(self.0.close(&state.0, count))
    }
}

impl<V: Lanes, const K: usize, const G: usize> Takes<Pairs<V, K>> for PairsBlock<V, K, G> {
    #[inline(always)]
    fn begin(&mut self, _: usize, _: &Pairs<V, K>) {}
    #[inline(always)]
    fn add(&mut self, index: usize, pairs: &Pairs<V, K>) {
        for (groups, draw) in self.0.iter_mut().zip(&pairs.0) {
            groups.add(index, draw);
        }
    }
    #[inline(always)]
    fn add_beside<const P: usize>(parts: &mut Self::Beside<P>, index: usize, draws: &[Pairs<V, K>; P]) {
        add_to_each(parts, index, draws);
    }
}

impl<W: Lanes<Scalar = f64>, const K: usize, const G: usize> State for PairsState<W, K, G> {
    type Channel = PairsState<f64, K, G>;

    #[inline(always)]
    fn merge(&mut self, count: u64, later: &Self, later_count: u64) {
        self.0.merge(count, &later.0, later_count);
    }
    fn channel(&self, channel: usize) -> Self::Channel {
        PairsState(self.0.channel(channel))
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        self.0.words(each);
    }
}

impl<const K: usize, const G: usize> HasPairs<K> for PairsState<f64, K, G> {
    fn groups(&self) -> usize {
        G
    }
    fn group_of_pair(&self, count: u64, pair: usize, group: usize) -> Group {
        self.0[pair].group(count, group)
    }
}
