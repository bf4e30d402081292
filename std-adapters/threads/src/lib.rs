//! All cores, the same bits.
//!
//! Work is cut into chunks of a fixed size. A chunk has a random stream of its own, given by the
//! seed and the chunk's number, and starts from nothing; chunks are merged in a fixed binary tree.
//! So neither the number of threads nor who took which chunk can change a bit, and a run can be
//! stopped after any chunk and go on in another process.
//!
//! [`integrate()`] is one call; a [`Run`] is the same for hours, with progress, cancellation, a time budget
//! and checkpoints:
//!
//! ```
//! use core::time::Duration;
//! use ratiocv_core::{Mickey, Problem, Reads, Uniform, WithIntegral};
//! use ratiocv_threads::{Run, Stopped, integrate};
//!
//! let problem = Problem::new(|x: &f64| x.sqrt()).auxiliary(WithIntegral::new(|x: &f64| *x, 0.5)).proposal(Uniform);
//! let mickey = Mickey.defensive(0.01)?;
//! let folder = tempfile::tempdir()?;
//! let file = folder.path().join("sqrt.checkpoint");
//!
//! // One minute at a time, one file; a kill costs ten seconds.
//! let outcome = loop {
//!     let sitting = Run::new(200_000, 7)
//!         .time_budget(Duration::from_secs(60))
//!         .checkpoint(&file, Duration::from_secs(10))
//!         .integrate(&problem, &mickey)?;
//!     if sitting.stopped == Stopped::Finished {
//!         break sitting;
//!     }
//! };
//! assert_eq!(outcome.estimate.value, integrate(&problem, &mickey, 200_000, 7)?.value);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod checkpoint;
mod chunks;
mod error;
mod integrate;
mod merge_tree;
mod progress;
mod run;

pub use checkpoint::CheckpointFile;
pub use chunks::{Chunk, map_chunks, stream};
pub use error::{Error, Fault};
pub use integrate::{CHUNK, integrate};
pub use merge_tree::{MergeTree, merge_tree};
pub use run::{Outcome, Run, Stopped};
