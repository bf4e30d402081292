//! How far a run is, to be told while threads go on.

use core::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::Mutex;

/// What is called with the number of draws done and their total.
pub(crate) type Callback<'a> = Box<dyn FnMut(u64, u64) + Send + 'a>;

/// Counts draws and tells a callback, one call at a time and never backwards.
pub(crate) struct Progress<'a> {
    done: AtomicU64,
    total: u64,
    /// The last number told, and whom.
    told: Option<Mutex<(Option<u64>, Callback<'a>)>>,
}

impl<'a> Progress<'a> {
    pub(crate) fn new(total: u64, callback: Option<Callback<'a>>) -> Self {
        Self { done: AtomicU64::new(0), total, told: callback.map(|callback| Mutex::new((None, callback))) }
    }

    /// `draws` more are done.
    pub(crate) fn add(&self, draws: u64) {
        self.done.fetch_add(draws, Relaxed);
        // Nobody waits for a slow callback: what it misses, the next call tells.
        if let Some(Ok(mut told)) = self.told.as_ref().map(Mutex::try_lock) {
            let done = self.done.load(Relaxed);
            let (last, callback) = &mut *told;
            if *last < Some(done) {
                *last = Some(done);
                callback(done, self.total);
            }
        }
    }
}
