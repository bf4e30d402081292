//! Chunks of work, their random streams, and the tree in which their results meet.

use rand_pcg::Pcg64;
use ratiocv_core::moments::Merge;
use rayon::prelude::*;

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
    (0..total.div_ceil(size))
        .into_par_iter()
        .map(|index| {
            let start = index * size;
            work(Chunk { index, start, count: size.min(total - start) })
        })
        .collect()
}

/// Merges neighbours, then neighbours of those, until one is left; `None` of nothing.
pub fn merge_tree<M: Merge>(mut parts: Vec<M>) -> Option<M> {
    while parts.len() > 1 {
        let mut pairs = Vec::with_capacity(parts.len().div_ceil(2));
        let mut parts_in_order = parts.into_iter();
        while let Some(mut left) = parts_in_order.next() {
            if let Some(right) = parts_in_order.next() {
                left.merge(&right);
            }
            pairs.push(left);
        }
        parts = pairs;
    }
    parts.pop()
}
