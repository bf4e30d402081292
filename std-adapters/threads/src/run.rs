//! The driver loop for hours: progress, cancellation, a time budget, checkpoints.

use crate::checkpoint::{Checkpoint, Identity};
use crate::chunks::merge_chunks;
use crate::error::Error;
use crate::integrate::{CHUNK, accumulated};
use crate::merge_tree::MergeTree;
use crate::progress::{Callback, Progress};
use core::fmt;
use core::sync::atomic::{AtomicBool, Ordering::Relaxed};
use core::time::Duration;
use ratiocv_core::moments::Moments;
use ratiocv_core::{Auxiliaries, Estimate, Estimator, Integrand, Lanes, Problem, Proposal, Reads};
use std::path::PathBuf;
use std::time::Instant;

/// [`integrate`](crate::integrate()) that can be watched, stopped, and resumed, with the same bits.
///
/// ```
/// use core::{sync::atomic::AtomicBool, time::Duration};
/// use ratiocv_core::{Mickey, Problem, Uniform, WithIntegral};
/// use ratiocv_threads::{Run, Stopped};
///
/// let problem = Problem::new(|x: &f64| x * x).auxiliary(WithIntegral::new(|x: &f64| *x, 0.5)).proposal(Uniform);
/// let folder = tempfile::tempdir()?;
/// let stop = AtomicBool::new(false); // set it from a signal handler, a window, another thread
///
/// let run = || {
///     Run::new(1_000_000, 1)
///         .progress(|done, total| eprint!("\r{:3} %", 100 * done / total))
///         .cancel(&stop)
///         .time_budget(Duration::from_secs(3600))
///         .checkpoint(folder.path().join("x-squared.checkpoint"), Duration::from_secs(60))
///         .fingerprint("x squared") // what the problem depends on
/// };
/// let outcome = run().integrate(&problem, &Mickey)?;
/// match outcome.stopped {
///     Stopped::Finished => println!("{} ± {}", outcome.estimate.value, outcome.estimate.std_error),
///     Stopped::Cancelled | Stopped::OutOfTime => println!("{} draws so far: call it again", outcome.draws),
/// }
/// // The same call again: it goes on from the file, here from its end.
/// assert_eq!(run().integrate(&problem, &Mickey)?.estimate.value, outcome.estimate.value);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Run<'a> {
    draws: u64,
    seed: u64,
    progress: Option<Callback<'a>>,
    cancel: Option<&'a AtomicBool>,
    time_budget: Option<Duration>,
    checkpoint: Option<(PathBuf, Duration)>,
    fingerprint: String,
}

impl fmt::Debug for Run<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { draws, seed, cancel, time_budget, checkpoint, fingerprint, .. } = self;
        f.debug_struct("Run")
            .field("draws", draws)
            .field("seed", seed)
            .field("cancel", cancel)
            .field("time_budget", time_budget)
            .field("checkpoint", checkpoint)
            .field("fingerprint", fingerprint)
            .finish_non_exhaustive()
    }
}

/// What a [`Run`] came to.
#[derive(Clone, Copy, Debug)]
pub struct Outcome<V: Lanes> {
    /// The estimate of the draws that were made: of a whole number of chunks from the first on, the same
    /// bits as of a run that was to make no more than these.
    pub estimate: Estimate<V>,
    /// How many draws that are, those of earlier sittings included.
    pub draws: u64,
    /// Why there are no more.
    pub stopped: Stopped,
}

/// Why a [`Run`] stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// All draws were made.
    Finished,
    /// It was cancelled.
    Cancelled,
    /// Its time was up.
    OutOfTime,
}

impl<'a> Run<'a> {
    /// A run of `draws` draws with random streams of `seed`.
    pub fn new(draws: u64, seed: u64) -> Self {
        Self {
            draws,
            seed,
            progress: None,
            cancel: None,
            time_budget: None,
            checkpoint: None,
            fingerprint: String::new(),
        }
    }

    /// Calls `callback` with the number of draws done, those of earlier sittings included, and their total:
    /// at the beginning, after chunks, and at the end.
    ///
    /// By any of the threads, one call at a time, never with less than before. No thread waits for the
    /// callback: while it is busy, other chunks are not told of one by one.
    #[must_use]
    pub fn progress(mut self, callback: impl FnMut(u64, u64) + Send + 'a) -> Self {
        self.progress = Some(Box::new(callback));
        self
    }

    /// Stops soon after `flag` is set: each thread finishes the chunk that it is at.
    #[must_use]
    pub fn cancel(mut self, flag: &'a AtomicBool) -> Self {
        self.cancel = Some(flag);
        self
    }

    /// Stops soon after `budget` has passed: each thread finishes the chunk that it is at. Each sitting
    /// of a resumed run has the whole budget.
    #[must_use]
    pub fn time_budget(mut self, budget: Duration) -> Self {
        self.time_budget = Some(budget);
        self
    }

    /// Keeps what is done in the file `path`, and goes on from there if it exists.
    ///
    /// The file is written at the beginning, so that a bad path is known before hours of work, `every`
    /// so often, and when the run stops, for whatever reason but a panic. It is replaced as a whole:
    /// whenever the process is killed, no more is lost than the work of the last interval and the
    /// chunks that were being worked on (and a small `.ratiocv-checkpoint-…` may be left beside it).
    /// A resumed run has the bits of one that was never interrupted, whatever the number of threads in
    /// either.
    ///
    /// A file that is truncated, damaged, no checkpoint, or that of another run is an error, and stays
    /// as it is. A run is told from others by seed, draws, estimator, channels, auxiliaries, known
    /// integrals, the moments' parameters, the version of this crate, a checksum of the first 8 draws, and
    /// its [`fingerprint`](Self::fingerprint). The file of a finished run answers at once.
    #[must_use]
    pub fn checkpoint(mut self, path: impl Into<PathBuf>, every: Duration) -> Self {
        self.checkpoint = Some((path.into(), every));
        self
    }

    /// Says what the problem depends on, such as the name and parameters of a scene, so that a checkpoint
    /// of another one is refused even where the first 8 draws are alike.
    #[must_use]
    pub fn fingerprint(mut self, text: impl Into<String>) -> Self {
        self.fingerprint = text.into();
        self
    }

    /// The estimate of `estimator` from draws of `problem`, on all of the pool's threads: the same bits
    /// as [`integrate`](crate::integrate()).
    ///
    /// If the integrand, or the callback, panics, so does this, once each thread has finished its chunk.
    /// The last checkpoint stays; a resumed run comes to the same draw again, and panics again unless
    /// the integrand was mended (which its first 8 draws must not notice).
    ///
    /// # Errors
    /// [`Error::Estimate`] as [`Estimator::estimate`], also for a run that was stopped before its first
    /// chunk; [`Error::Checkpoint`] if the checkpoint cannot be read or written, or is not of this run.
    pub fn integrate<F, A, P, X, E, const K: usize>(
        self,
        problem: &Problem<F, A, P, X>,
        estimator: &E,
    ) -> Result<Outcome<F::Value>, Error>
    where
        F: Integrand<X> + Sync,
        A: Auxiliaries<X, F::Value, K> + Sync,
        P: Proposal<Point = X> + Sync,
        E: Reads<K> + Estimator<<E::ErrorBar<F::Value> as Moments>::Channel, K> + Sync,
        E::ErrorBar<F::Value>: Send,
    {
        let begun = Instant::now();
        let Self { draws, seed, progress, cancel, time_budget, checkpoint, fingerprint } = self;
        let integrals = problem.integrals();
        let empty = || estimator.error_bar(&integrals);

        let (path, every) = checkpoint.unzip();
        let checkpoint =
            path.map(|path| Checkpoint::new(path, Identity::new(problem, estimator, draws, seed, &fingerprint)));
        let save = |tree: &MergeTree<_>| checkpoint.as_ref().map_or(Ok(()), |checkpoint| checkpoint.save(tree));
        let mut tree = match checkpoint.as_ref().map(|checkpoint| checkpoint.load(empty)).transpose()?.flatten() {
            Some(tree) => tree,
            None => {
                let nothing = MergeTree::default();
                save(&nothing)?;
                nothing
            }
        };

        let done = |tree: &MergeTree<_>| draws.min(tree.parts().saturating_mul(CHUNK));
        let progress = Progress::new(draws, progress);
        progress.add(done(&tree));

        let cancelled = || cancel.is_some_and(|flag| flag.load(Relaxed));
        let out_of_time = || time_budget.is_some_and(|budget| begun.elapsed() >= budget);
        let stopped = loop {
            let (since, before, any) = (Instant::now(), tree.parts(), AtomicBool::new(false));
            let due = || any.load(Relaxed) && every.is_some_and(|every| since.elapsed() >= every);
            merge_chunks(
                &mut tree,
                draws,
                CHUNK,
                || cancelled() || out_of_time() || due(),
                |chunk| {
                    let moments = accumulated(problem, empty(), seed, chunk);
                    any.store(true, Relaxed);
                    progress.add(chunk.count);
                    moments
                },
            );
            if tree.parts() > before {
                save(&tree)?;
            }
            if done(&tree) == draws {
                break Stopped::Finished;
            } else if cancelled() {
                break Stopped::Cancelled;
            } else if out_of_time() {
                break Stopped::OutOfTime;
            }
        };
        progress.add(0);
        let draws = done(&tree);
        let estimate = estimator.estimate(&tree.merged().unwrap_or_else(empty), &integrals)?;
        Ok(Outcome { estimate, draws, stopped })
    }
}
