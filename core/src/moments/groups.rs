//! Means of f and of each h in each of `G` groups of draws, dealt round robin.

use crate::draw::Draw;
use crate::lanes::Lanes;
use crate::moments::blocked::Blocked;
use crate::moments::kernel::{Kernel, State, Takes, add_to_each, kernels_beside};
use crate::moments::read::{Group, HasGroups, HasMeans, Means};
use crate::moments::save;
use crate::planted::planted;

/// Group means of f and `K` auxiliaries: draw `i` of the stream belongs to group `i % G`.
///
/// Grouped Mickey reads all `G`; Quenouille's halves are the even- and odd-numbered groups. A merge
/// deals the later part's groups on from where the earlier part stopped, so that whole and parts
/// agree. A group that has no draw yet has the means 0.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Groups}, Draw, Estimator, Integrals, Mickey};
/// let mut pixel = Groups::<f64, 8>::default();
/// for i in 0..64 {
///     let h = 0.5 + f64::from(i % 7) / 7.0;
///     pixel.add(Draw::new(3.0 * h, h));
/// }
/// let mickey = Mickey.estimate(&pixel, &Integrals::ONE)?;
/// assert!((mickey.value - 3.0).abs() < 1e-14);
/// assert!(mickey.std_error.is_nan()); // group means alone: the value tier
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
pub type Groups<V, const G: usize, const K: usize = 1> = Blocked<V, GroupsBlock<V, G, K>>;

/// The block kernel of [`Groups`]: plain sums, no shift. A group may hold small numbers alone, and
/// its mean is divided by; about a shift it would lose its relative precision.
#[derive(Clone, Copy, Debug)]
pub struct GroupsBlock<V, const G: usize, const K: usize = 1> {
    sums: [Draw<V, K>; G],
}

/// The state of [`Groups`]: the mean of each group, dealt from the stream's first draw.
#[derive(Clone, Copy, Debug)]
pub struct GroupsState<W, const G: usize, const K: usize = 1> {
    means: [Draw<W, K>; G],
}

/// The number of draws in group `group` of `groups`, of a stream of `count`.
#[inline(always)]
pub(crate) const fn size(count: u64, group: usize, groups: usize) -> u64 {
    (count + (groups - 1 - group) as u64) / groups as u64
}

impl<W: Lanes, const G: usize, const K: usize> Default for GroupsState<W, G, K> {
    fn default() -> Self {
        Self { means: [Draw::ZERO; G] }
    }
}

impl<V: Lanes, const G: usize, const K: usize> Kernel for GroupsBlock<V, G, K> {
    type State = GroupsState<V::Wide, G, K>;
    // The groups are partial sums already.
    const PARTIALS: usize = 1;
    const LEARNS: bool = false;
    kernels_beside!();

    #[inline(always)]
    fn empty(_: &Self::State) -> Self {
        const { assert!(G >= 2, "groups are compared with each other: at least 2") };
        Self { sums: [Draw::ZERO; G] }
    }
    #[inline(always)]
    fn fold(&mut self, other: &Self) {
        for (sum, other) in self.sums.iter_mut().zip(other.sums) {
            *sum = sum.zip(other, V::add);
        }
    }
    #[inline(always)]
    fn close(&self, _: &Self::State, count: u64) -> Self::State {
        GroupsState {
            means: core::array::from_fn(|group| {
                // An empty group stays 0, not 0/0.
                let size = V::Wide::splat(size(count, group, G).max(1) as f64);
                self.sums[group].map(|sum| sum.widen() / size)
            }),
        }
    }
}

impl<V: Lanes, const G: usize, const K: usize> Takes<Draw<V, K>> for GroupsBlock<V, G, K> {
    #[inline(always)]
    fn begin(&mut self, _: usize, _: &Draw<V, K>) {}
    #[inline(always)]
    fn add(&mut self, index: usize, draw: &Draw<V, K>) {
        let sum = &mut self.sums[index % G];
        *sum = sum.zip(*draw, V::add);
    }
    #[inline(always)]
    fn add_beside<const P: usize>(parts: &mut Self::Beside<P>, index: usize, draws: &[Draw<V, K>; P]) {
        add_to_each(parts, index, draws);
    }
}

impl<W: Lanes<Scalar = f64>, const G: usize, const K: usize> State for GroupsState<W, G, K> {
    type Channel = GroupsState<f64, G, K>;

    #[inline(always)]
    fn merge(&mut self, count: u64, later: &Self, later_count: u64) {
        let start = planted!("groups_rotation": (count % G as u64) as usize, 0);
        for (i, theirs) in later.means.iter().enumerate() {
            let group = (start + i) % G;
            let (here, there) = (size(count, group, G), size(later_count, i, G));
            if there > 0 {
                let fraction = W::splat(there as f64 / (here + there) as f64);
                let mine = self.means[group];
                self.means[group] = mine.zip(*theirs, |mine, theirs| mine + (theirs - mine) * fraction);
            }
        }
    }
    fn channel(&self, channel: usize) -> GroupsState<f64, G, K> {
        GroupsState { means: core::array::from_fn(|group| self.means[group].channel(channel)) }
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        for mean in &mut self.means {
            save::draw(mean, each);
        }
    }
}

impl<const G: usize, const K: usize> HasMeans<K> for GroupsState<f64, G, K> {
    fn means(&self, count: u64) -> Means<K> {
        let share = |g: usize| size(count, g, G) as f64 / count as f64;
        let mean = |entry: &dyn Fn(&Draw<f64, K>) -> f64| (0..G).map(|g| share(g) * entry(&self.means[g])).sum();
        Means { f: mean(&|draw| draw.f), h: core::array::from_fn(|k| mean(&|draw| draw.h[k])) }
    }
}

impl<const G: usize, const K: usize> HasGroups<K> for GroupsState<f64, G, K> {
    fn groups(&self) -> usize {
        G
    }
    // Inlined, an index that a loop counts needs no check: firmware links without panics.
    #[inline(always)]
    fn group(&self, count: u64, group: usize) -> Group<K> {
        Group { count: size(count, group, G), f: self.means[group].f, h: self.means[group].h }
    }
}

#[cfg(test)]
mod tests {
    use super::size;

    #[test]
    fn groups_are_dealt_round_robin() {
        for count in 0..40_u64 {
            for groups in [2, 3, 8] {
                for group in 0..groups {
                    let dealt = (0..count).filter(|i| *i as usize % groups == group).count() as u64;
                    assert_eq!(size(count, group, groups), dealt, "{count} draws, group {group} of {groups}");
                }
            }
        }
    }
}
