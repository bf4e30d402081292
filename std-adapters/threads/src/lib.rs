//! All cores, the same bits.
//!
//! Work is cut into chunks of a fixed size. A chunk has a random stream of its own, given by the
//! seed and the chunk's number, and starts from nothing; chunks are merged in a fixed binary tree.
//! So neither the number of threads nor who took which chunk can change a bit.

mod chunks;
mod integrate;

pub use chunks::{Chunk, map_chunks, merge_tree, stream};
pub use integrate::{CHUNK, integrate};
