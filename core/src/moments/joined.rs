//! Several kernels in one pass over the draws: one accumulator, one count, one block.

use crate::moments::blocked::Blocked;
use crate::moments::extremes::MayHaveTails;
use crate::moments::kernel::{Kernel, State, Takes};
use crate::moments::read::{
    Group, HasComoments, HasFolds, HasGroups, HasMeans, HasRatioMean, HasThirdMoments, Means, RatioMoments, Spread,
    Tails, ThirdMoments,
};

/// Moments of several kinds side by side; each place is a kernel, or `()`, which takes no space and
/// no time.
///
/// | place | capability | kernels |
/// |---|---|---|
/// | `B` | means, spread | `SumsBlock`, `ComomentsBlock`, `UnivariateBlock` of f |
/// | `R` | mean of f/h | `UnivariateBlock` of the ratio, or an array of them, raw and defensive |
/// | `G` | group means | `GroupsBlock` |
/// | `E` | tails (the diagnostic tier) | `ExtremesBlock` |
/// | `T` | third moments | `ThirdBlock` |
/// | `F` | moments of two folds | `FoldsBlock` |
///
/// As an accumulator it is `Blocked<Joined<…>>`; `Default`, or [`Blocked::with_ratios`] where the ratios are
/// on a defensive auxiliary. As a state and as a channel it is `Joined` of the parts' states.
#[derive(Clone, Copy, Debug, Default)]
pub struct Joined<B, R = (), G = (), E = (), T = (), F = ()> {
    /// Means, and what spreads about them.
    pub base: B,
    /// Ratios f/h.
    pub ratios: R,
    /// Group means.
    pub groups: G,
    /// Tails.
    pub extremes: E,
    /// Third moments.
    pub third: T,
    /// Folds.
    pub folds: F,
}

impl Kernel for () {
    type State = ();
    const PARTIALS: usize = 1;
    const LEARNS: bool = false;
    type Beside<const P: usize> = ();
    #[inline(always)]
    fn empty((): &()) {}
    #[inline(always)]
    fn fold(&mut self, (): &()) {}
    #[inline(always)]
    fn close(&self, (): &(), _: u64) {}
    #[inline(always)]
    fn beside<const P: usize>(&self) {}
    #[inline(always)]
    fn part<const P: usize>((): &(), _: usize) {}
    #[inline(always)]
    fn fold_beside<const P: usize>((): &mut (), (): &()) {}
}

impl<D> Takes<D> for () {
    #[inline(always)]
    fn begin(&mut self, _: usize, _: &D) {}
    #[inline(always)]
    fn add(&mut self, _: usize, _: &D) {}
    #[inline(always)]
    fn add_beside<const P: usize>((): &mut (), _: usize, _: &[D; P]) {}
}

impl State for () {
    type Channel = ();
    #[inline(always)]
    fn merge(&mut self, _: u64, (): &(), _: u64) {}
    fn channel(&self, _: usize) {}
    fn words(&mut self, _: &mut dyn FnMut(&mut u64)) {}
}

/// Several kernels of one kind, such as ratios on auxiliaries of different defensive weights.
impl<B: Kernel, const L: usize> Kernel for [B; L] {
    type State = [B::State; L];
    const PARTIALS: usize = B::PARTIALS;
    const LEARNS: bool = B::LEARNS;
    type Beside<const P: usize> = [B::Beside<P>; L];
    #[inline(always)]
    fn empty(state: &Self::State) -> Self {
        core::array::from_fn(|i| B::empty(&state[i]))
    }
    #[inline(always)]
    fn fold(&mut self, other: &Self) {
        for (block, other) in self.iter_mut().zip(other) {
            block.fold(other);
        }
    }
    #[inline(always)]
    fn close(&self, state: &Self::State, count: u64) -> Self::State {
        core::array::from_fn(|i| self[i].close(&state[i], count))
    }
    #[inline(always)]
    fn beside<const P: usize>(&self) -> Self::Beside<P> {
        core::array::from_fn(|i| self[i].beside())
    }
    #[inline(always)]
    fn part<const P: usize>(parts: &Self::Beside<P>, part: usize) -> Self {
        core::array::from_fn(|i| B::part(&parts[i], part))
    }
    #[inline(always)]
    fn fold_beside<const P: usize>(parts: &mut Self::Beside<P>, others: &Self::Beside<P>) {
        for (part, other) in parts.iter_mut().zip(others) {
            B::fold_beside(part, other);
        }
    }
}

impl<D, B: Takes<D>, const L: usize> Takes<D> for [B; L] {
    #[inline(always)]
    fn begin(&mut self, index: usize, draw: &D) {
        for block in self {
            block.begin(index, draw);
        }
    }
    #[inline(always)]
    fn add(&mut self, index: usize, draw: &D) {
        for block in self {
            block.add(index, draw);
        }
    }
    #[inline(always)]
    fn add_beside<const P: usize>(parts: &mut Self::Beside<P>, index: usize, draws: &[D; P]) {
        for part in parts {
            B::add_beside(part, index, draws);
        }
    }
}

impl<S: State, const L: usize> State for [S; L] {
    type Channel = [S::Channel; L];
    #[inline(always)]
    fn merge(&mut self, count: u64, later: &Self, later_count: u64) {
        for (state, later) in self.iter_mut().zip(later) {
            state.merge(count, later, later_count);
        }
    }
    fn channel(&self, channel: usize) -> Self::Channel {
        core::array::from_fn(|i| self[i].channel(channel))
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        for state in self {
            state.words(each);
        }
    }
}

impl<B: Kernel, R: Kernel, G: Kernel, E: Kernel, T: Kernel, F: Kernel> Kernel for Joined<B, R, G, E, T, F> {
    type State = Joined<B::State, R::State, G::State, E::State, T::State, F::State>;
    const PARTIALS: usize = B::PARTIALS;
    const LEARNS: bool = B::LEARNS || R::LEARNS || G::LEARNS || E::LEARNS || T::LEARNS || F::LEARNS;
    type Beside<const P: usize> =
        Joined<B::Beside<P>, R::Beside<P>, G::Beside<P>, E::Beside<P>, T::Beside<P>, F::Beside<P>>;
    #[inline(always)]
    fn empty(state: &Self::State) -> Self {
        Self {
            base: B::empty(&state.base),
            ratios: R::empty(&state.ratios),
            groups: G::empty(&state.groups),
            extremes: E::empty(&state.extremes),
            third: T::empty(&state.third),
            folds: F::empty(&state.folds),
        }
    }
    #[inline(always)]
    fn fold(&mut self, other: &Self) {
        self.base.fold(&other.base);
        self.ratios.fold(&other.ratios);
        self.groups.fold(&other.groups);
        self.extremes.fold(&other.extremes);
        self.third.fold(&other.third);
        self.folds.fold(&other.folds);
    }
    #[inline(always)]
    fn close(&self, state: &Self::State, count: u64) -> Self::State {
        Joined {
            base: self.base.close(&state.base, count),
            ratios: self.ratios.close(&state.ratios, count),
            groups: self.groups.close(&state.groups, count),
            extremes: self.extremes.close(&state.extremes, count),
            third: self.third.close(&state.third, count),
            folds: self.folds.close(&state.folds, count),
        }
    }
    #[inline(always)]
    fn beside<const P: usize>(&self) -> Self::Beside<P> {
        Joined {
            base: self.base.beside(),
            ratios: self.ratios.beside(),
            groups: self.groups.beside(),
            extremes: self.extremes.beside(),
            third: self.third.beside(),
            folds: self.folds.beside(),
        }
    }
    #[inline(always)]
    fn part<const P: usize>(parts: &Self::Beside<P>, part: usize) -> Self {
        Self {
            base: B::part(&parts.base, part),
            ratios: R::part(&parts.ratios, part),
            groups: G::part(&parts.groups, part),
            extremes: E::part(&parts.extremes, part),
            third: T::part(&parts.third, part),
            folds: F::part(&parts.folds, part),
        }
    }
    #[inline(always)]
    fn fold_beside<const P: usize>(parts: &mut Self::Beside<P>, others: &Self::Beside<P>) {
        B::fold_beside(&mut parts.base, &others.base);
        R::fold_beside(&mut parts.ratios, &others.ratios);
        G::fold_beside(&mut parts.groups, &others.groups);
        E::fold_beside(&mut parts.extremes, &others.extremes);
        T::fold_beside(&mut parts.third, &others.third);
        F::fold_beside(&mut parts.folds, &others.folds);
    }
}

impl<D, B, R, G, E, T, F> Takes<D> for Joined<B, R, G, E, T, F>
where
    B: Takes<D>,
    R: Takes<D>,
    G: Takes<D>,
    E: Takes<D>,
    T: Takes<D>,
    F: Takes<D>,
{
    #[inline(always)]
    fn begin(&mut self, index: usize, draw: &D) {
        self.base.begin(index, draw);
        self.ratios.begin(index, draw);
        self.groups.begin(index, draw);
        self.extremes.begin(index, draw);
        self.third.begin(index, draw);
        self.folds.begin(index, draw);
    }
    #[inline(always)]
    fn add(&mut self, index: usize, draw: &D) {
        self.base.add(index, draw);
        self.ratios.add(index, draw);
        self.groups.add(index, draw);
        self.extremes.add(index, draw);
        self.third.add(index, draw);
        self.folds.add(index, draw);
    }
    #[inline(always)]
    fn add_beside<const P: usize>(parts: &mut Self::Beside<P>, index: usize, draws: &[D; P]) {
        B::add_beside(&mut parts.base, index, draws);
        R::add_beside(&mut parts.ratios, index, draws);
        G::add_beside(&mut parts.groups, index, draws);
        E::add_beside(&mut parts.extremes, index, draws);
        T::add_beside(&mut parts.third, index, draws);
        F::add_beside(&mut parts.folds, index, draws);
    }
}

impl<B: State, R: State, G: State, E: State, T: State, F: State> State for Joined<B, R, G, E, T, F> {
    type Channel = Joined<B::Channel, R::Channel, G::Channel, E::Channel, T::Channel, F::Channel>;
    #[inline(always)]
    fn merge(&mut self, count: u64, later: &Self, later_count: u64) {
        self.base.merge(count, &later.base, later_count);
        self.ratios.merge(count, &later.ratios, later_count);
        self.groups.merge(count, &later.groups, later_count);
        self.extremes.merge(count, &later.extremes, later_count);
        self.third.merge(count, &later.third, later_count);
        self.folds.merge(count, &later.folds, later_count);
    }
    fn channel(&self, channel: usize) -> Self::Channel {
        Joined {
            base: self.base.channel(channel),
            ratios: self.ratios.channel(channel),
            groups: self.groups.channel(channel),
            extremes: self.extremes.channel(channel),
            third: self.third.channel(channel),
            folds: self.folds.channel(channel),
        }
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        self.base.words(each);
        self.ratios.words(each);
        self.groups.words(each);
        self.extremes.words(each);
        self.third.words(each);
        self.folds.words(each);
    }
}

impl<V, B: Kernel, R: Kernel, G: Kernel, E: Kernel, T: Kernel, F: Kernel> Blocked<V, Joined<B, R, G, E, T, F>>
where
    B::State: Default,
    G::State: Default,
    E::State: Default,
    T::State: Default,
    F::State: Default,
{
    /// An empty accumulator with the parameters of the (empty) ratio accumulator `ratios`.
    pub fn with_ratios(ratios: Blocked<V, R>) -> Self {
        Self::with_parameters(Joined {
            base: B::State::default(),
            ratios: ratios.parameters(),
            groups: G::State::default(),
            extremes: E::State::default(),
            third: T::State::default(),
            folds: F::State::default(),
        })
    }
}

impl<V, B: Kernel> Blocked<V, [B; 2]> {
    /// Two (empty) accumulators of one kind as one.
    pub fn both(first: Blocked<V, B>, second: Blocked<V, B>) -> Self {
        Self::with_parameters([first.parameters(), second.parameters()])
    }
}

impl<B: HasMeans<K>, R, G, E: MayHaveTails, T, F, const K: usize> HasMeans<K> for Joined<B, R, G, E, T, F> {
    fn means(&self, count: u64) -> Means<K> {
        self.base.means(count)
    }
    fn spread(&self) -> Option<Spread<K>> {
        self.base.spread()
    }
    fn tails(&self) -> Option<Tails> {
        self.extremes.tails()
    }
}

impl<B: HasComoments<K>, R, G, E: MayHaveTails, T, F, const K: usize> HasComoments<K> for Joined<B, R, G, E, T, F> {
    fn comoments(&self) -> Spread<K> {
        self.base.comoments()
    }
}

impl<B, R: HasRatioMean, G, E, T, F> HasRatioMean for Joined<B, R, G, E, T, F> {
    fn ratio(&self, weight: f64, integral: f64) -> Option<RatioMoments> {
        self.ratios.ratio(weight, integral)
    }
}

/// The first that was accumulated for the auxiliary asked for.
impl<R: HasRatioMean, const L: usize> HasRatioMean for [R; L] {
    fn ratio(&self, weight: f64, integral: f64) -> Option<RatioMoments> {
        self.iter().find_map(|ratios| ratios.ratio(weight, integral))
    }
}

impl<B, R, G: HasGroups<K>, E, T, F, const K: usize> HasGroups<K> for Joined<B, R, G, E, T, F> {
    fn groups(&self) -> usize {
        self.groups.groups()
    }
    fn group(&self, count: u64, group: usize) -> Group<K> {
        self.groups.group(count, group)
    }
}

impl<B, R, G, E, T: HasThirdMoments, F> HasThirdMoments for Joined<B, R, G, E, T, F> {
    fn third(&self) -> ThirdMoments {
        self.third.third()
    }
}

impl<B, R, G, E, T, F: HasFolds> HasFolds for Joined<B, R, G, E, T, F> {
    type Fold = F::Fold;
    fn fold(&self, fold: usize) -> &F::Fold {
        self.folds.fold(fold)
    }
}
