//! The file of a checkpoint: replaced as a whole, or not at all.

use crate::checkpoint::Identity;
use crate::checkpoint::format::{MAGIC, decoded, encoded};
use crate::error::{Error, Fault};
use crate::merge_tree::MergeTree;
use ratiocv_core::moments::{Moments, Save};
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// Where a run is kept.
pub(crate) struct Checkpoint {
    pub(crate) path: PathBuf,
    pub(crate) identity: Identity,
}

impl Checkpoint {
    /// How far the run got; `None` if there is no file yet.
    pub(crate) fn load<M: Save + Moments>(&self, empty: impl Fn() -> M) -> Result<Option<MergeTree<M>>, Error> {
        let bytes = match self.read() {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(self.error(Fault::Io { doing: "read it", source })),
        };
        decoded(&bytes, &self.identity, empty).map(Some).map_err(|fault| self.error(fault))
    }

    /// Replaces the file: whenever the process is killed, there is the old one or the new one.
    pub(crate) fn save<M: Save + Clone>(&self, tree: &MergeTree<M>) -> Result<(), Error> {
        let written = self.replace(&encoded(&self.identity, tree));
        written.map_err(|source| self.error(Fault::Io { doing: "write it", source }))
    }

    fn error(&self, fault: Fault) -> Error {
        Error::Checkpoint { path: self.path.clone(), fault }
    }

    fn read(&self) -> io::Result<Vec<u8>> {
        let (mut file, mut bytes) = (File::open(&self.path)?, Vec::new());
        (&file).take(MAGIC.len() as u64).read_to_end(&mut bytes)?;
        // What is something else may be large, or endless.
        if bytes == MAGIC {
            file.read_to_end(&mut bytes)?;
        }
        Ok(bytes)
    }

    fn replace(&self, bytes: &[u8]) -> io::Result<()> {
        let folder = self.path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        // In the same folder: a rename across file systems would be a copy.
        let mut file = tempfile::Builder::new().prefix(".ratiocv-checkpoint-").tempfile_in(folder)?;
        file.write_all(bytes)?;
        // Before the rename: the new name must not reach the disk ahead of the contents.
        file.as_file().sync_all()?;
        file.persist(&self.path)?;
        // The rename itself is an entry of the folder, which only Unix can be asked to write down.
        #[cfg(unix)]
        File::open(folder)?.sync_all()?;
        Ok(())
    }
}
