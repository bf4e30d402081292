//! Work outlives its process: what was done, in a file.

mod file;
mod format;
mod identity;
mod tree;

pub use file::CheckpointFile;
pub(crate) use identity::Identity;
pub(crate) use tree::Checkpoint;
