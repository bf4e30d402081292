//! Errors of several estimators over independent replicates.

use rand_pcg::Pcg64;
use ratiocv_core::moments::{Accumulate, Merge, Variance};
use ratiocv_core::{Draw, Estimate, Estimator, Integrals, Lanes, Plain};
use ratiocv_threads::{map_chunks, merge_tree, stream};

/// Replicates in a chunk of work.
const CHUNK: u64 = 256;

/// The mean of some numbers per channel and its standard error, which is what plain Monte Carlo gives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Averages<V: Lanes, const L: usize>([Variance<V, 0>; L]);

impl<V: Lanes, const L: usize> Averages<V, L> {
    pub(super) fn new() -> Self {
        Self([Variance::default(); L])
    }

    /// One replicate's numbers.
    pub(super) fn add(&mut self, numbers: [V; L]) {
        for (average, f) in self.0.iter_mut().zip(numbers) {
            average.add(Draw { f, h: [] });
        }
    }

    pub(super) fn estimates(&self) -> [Estimate<V>; L] {
        self.0.each_ref().map(|average| Plain.estimate_anyway(average, &Integrals::NONE))
    }
}

impl<V: Lanes, const L: usize> Merge for Averages<V, L> {
    fn merge(&mut self, later: &Self) {
        for (mine, theirs) in self.0.iter_mut().zip(&later.0) {
            mine.merge(theirs);
        }
    }
}

/// The averages of `L` numbers over `count` replicates, each with a random stream of its own.
///
/// The same bits for any number of threads.
pub(super) fn average<V: Lanes, const L: usize>(
    seed: u64,
    count: u64,
    replicate: impl Fn(&mut Pcg64) -> [V; L] + Sync,
) -> [Estimate<V>; L] {
    let parts = map_chunks(count, CHUNK, |chunk| {
        let mut averages = Averages::new();
        for number in chunk.start..chunk.start + chunk.count {
            averages.add(replicate(&mut stream(seed, number)));
        }
        averages
    });
    merge_tree(parts).unwrap_or_else(Averages::new).estimates()
}
