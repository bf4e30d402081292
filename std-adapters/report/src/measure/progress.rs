//! How far a run has got.

/// Is told how far a run has got.
///
/// *Implemented by* progress bars, and by `()`, which is silent; *called by* [`run`](crate::run), from
/// one thread, some hundred times.
pub trait Progress: Sync {
    /// `done` of `total` units of work are done; `doing` comes next.
    fn report(&self, done: u64, total: u64, doing: &str);
}

impl Progress for () {
    fn report(&self, _: u64, _: u64, _: &str) {}
}
