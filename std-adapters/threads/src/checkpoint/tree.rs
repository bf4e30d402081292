//! The merged chunks of a run as words.

use crate::checkpoint::{CheckpointFile, Identity};
use crate::error::{Error, Fault};
use crate::integrate::CHUNK;
use crate::merge_tree::MergeTree;
use ratiocv_core::moments::{Moments, Save};
use ratiocv_core::planted;
use std::path::PathBuf;

/// Where a run is kept.
pub(crate) struct Checkpoint {
    file: CheckpointFile,
    draws: u64,
}

impl Checkpoint {
    pub(crate) fn new(path: PathBuf, identity: Identity) -> Self {
        Self { file: CheckpointFile::new(path, identity.settings), draws: identity.draws }
    }

    /// How far the run got; `None` if there is no file yet. `empty` makes moments to be filled.
    pub(crate) fn load<M: Save + Moments>(&self, empty: impl Fn() -> M) -> Result<Option<MergeTree<M>>, Error> {
        let Some(words) = self.file.load()? else { return Ok(None) };
        self.tree(&words, empty).map(Some).map_err(|fault| self.file.error(fault))
    }

    /// Replaces the file.
    pub(crate) fn save<M: Save + Clone>(&self, tree: &MergeTree<M>) -> Result<(), Error> {
        let mut words = vec![tree.parts()];
        for moments in tree.subtrees() {
            moments.clone().words(&mut |word| words.push(*word));
        }
        self.file.save(&words)
    }

    fn tree<M: Save + Moments>(&self, words: &[u64], empty: impl Fn() -> M) -> Result<MergeTree<M>, Fault> {
        let mut rest = words.iter();
        let mut next = || rest.next().copied().ok_or(Fault::Damaged("its parts are longer than the whole"));
        let parts = next()?;
        if parts > self.draws.div_ceil(CHUNK) {
            return Err(Fault::Damaged("it has more chunks than its run"));
        }
        let (mut subtrees, mut start) = (Vec::new(), 0_u64);
        for bit in (0..u64::BITS).rev().filter(|bit| parts >> bit & 1 == 1) {
            let mut moments = empty();
            let mut all = Ok(());
            moments.words(&mut |word| match next() {
                Ok(read) => *word = read,
                Err(fault) => all = Err(fault),
            });
            all?;
            let end = self.draws.min(start.saturating_add(CHUNK.saturating_mul(1 << bit)));
            if planted!("checkpoint_counts": moments.count() != end - start, false) {
                return Err(Fault::Damaged("the number of draws is not that of its chunks"));
            }
            subtrees.push(moments);
            start = end;
        }
        let tree = MergeTree::from_subtrees(parts, subtrees).filter(|_| rest.len() == 0);
        tree.ok_or(Fault::Damaged("there is something after its end"))
    }
}
