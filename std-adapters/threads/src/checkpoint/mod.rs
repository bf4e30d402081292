//! Runs outlive their processes: the merged chunks of a run in a file.

mod file;
mod format;
mod identity;

pub(crate) use file::Checkpoint;
pub(crate) use identity::Identity;
