//! Chunks of work and their random streams.

use crate::merge_tree::MergeTree;
use core::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use rand_pcg::Pcg64;
use ratiocv_core::moments::Merge;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// A piece of work: `count` items, the first of them number `start`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chunk {
    /// The chunk's number.
    pub index: u64,
    /// The number of its first item.
    pub start: u64,
    /// How many items it has.
    pub count: u64,
}

fn chunk(index: u64, total: u64, size: u64) -> Chunk {
    let start = index * size;
    Chunk { index, start, count: size.min(total - start) }
}

/// The random stream `index` of `seed`.
///
/// PCG streams of one seed are the same sequence of states with another increment; the seed's bits
/// and the index's are spread over both, by SplitMix64 (Steele, Lea and Flood 2014), so that
/// neighbouring seeds and indices share nothing.
pub fn stream(seed: u64, index: u64) -> Pcg64 {
    let mut state = seed;
    let mut next = |salt: u64| {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15).wrapping_add(salt);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        u128::from(z ^ (z >> 31))
    };
    let state = (next(0) << 64) | next(index);
    let increment = (next(0) << 64) | u128::from(index);
    Pcg64::new(state, increment)
}

/// `work` of each chunk of `total` items, `size` at a time, on all of the pool's threads; results
/// in the order of the chunks.
pub fn map_chunks<T: Send>(total: u64, size: u64, work: impl Fn(Chunk) -> T + Sync) -> Vec<T> {
    let size = size.max(1);
    (0..total.div_ceil(size)).into_par_iter().map(|index| work(chunk(index, total, size))).collect()
}

/// Chunks that each thread works off before their results are merged: the wait for the last of them is
/// small beside the work of this many, and few results are held at a time.
const WAVE: u64 = 64;

/// Goes on with `work` on the chunks of `total` items, `size` at a time, from the first that `tree` does
/// not hold yet, until it holds all of them or `pause` says so.
///
/// `pause` is asked before each chunk. Threads take the chunks in order, and finish those that they
/// have taken: what was worked off is merged, without gaps, and nothing is lost.
pub(crate) fn merge_chunks<M: Merge + Send>(
    tree: &mut MergeTree<M>,
    total: u64,
    size: u64,
    pause: impl Fn() -> bool + Sync,
    work: impl Fn(Chunk) -> M + Sync,
) {
    let size = size.max(1);
    let chunks = total.div_ceil(size);
    while tree.parts() < chunks {
        let end = chunks.min(tree.parts().saturating_add(WAVE * rayon::current_num_threads() as u64));
        let next = AtomicU64::new(tree.parts());
        let panicked = AtomicBool::new(false);
        let results = Mutex::new(Vec::new());
        let worker = || {
            let on_panic = OnPanic(&panicked);
            while !panicked.load(Relaxed) && !pause() {
                let index = next.fetch_add(1, Relaxed);
                if index >= end {
                    break;
                }
                let result = work(chunk(index, total, size));
                results.lock().unwrap_or_else(PoisonError::into_inner).push((index, result));
            }
            core::mem::forget(on_panic);
        };
        rayon::scope(|scope| (0..rayon::current_num_threads()).for_each(|_| scope.spawn(|_| worker())));
        let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
        results.sort_unstable_by_key(|(index, _)| *index);
        results.into_iter().for_each(|(_, result)| tree.push(result));
        if tree.parts() < end {
            return;
        }
    }
}

/// Dropped by a panic alone, it tells the other threads, so that the panic is not held back until they
/// have done all their chunks.
struct OnPanic<'a>(&'a AtomicBool);

impl Drop for OnPanic<'_> {
    fn drop(&mut self) {
        self.0.store(true, Relaxed);
    }
}
