//! The file of a checkpoint: replaced as a whole, or not at all.

use crate::checkpoint::format::{MAGIC, decoded, encoded};
use crate::error::{Error, Fault};
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// Numbers in a file, with a version, a checksum, and the settings that tell whose they are: what a
/// [`Run`](crate::Run) keeps its moments in, for other long work to do the same.
///
/// ```
/// use ratiocv_threads::{CheckpointFile, Error, Fault};
/// let folder = tempfile::tempdir()?;
/// let file = |seed: u64| CheckpointFile::new(folder.path().join("work"), vec![("the seed".into(), seed.to_string())]);
/// assert_eq!(file(1).load()?, None); // there is none yet
/// file(1).save(&[1, 2, 3])?;
/// assert_eq!(file(1).load()?, Some(vec![1, 2, 3]));
/// assert!(matches!(file(2).load(), Err(Error::Checkpoint { fault: Fault::OtherRun { .. }, .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CheckpointFile {
    path: PathBuf,
    settings: Vec<(String, String)>,
}

impl CheckpointFile {
    /// The file `path` of work with these settings, names and values, in any order.
    pub fn new(path: impl Into<PathBuf>, settings: Vec<(String, String)>) -> Self {
        Self { path: path.into(), settings }
    }

    /// What was saved; `None` if there is no file yet.
    ///
    /// # Errors
    /// [`Error::Checkpoint`] if it cannot be read, is truncated, damaged, no checkpoint, or of other settings.
    pub fn load(&self) -> Result<Option<Vec<u64>>, Error> {
        let bytes = match self.read() {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(self.error(Fault::Io { doing: "read it", source })),
        };
        decoded(&bytes, &self.settings).map(Some).map_err(|fault| self.error(fault))
    }

    /// Replaces the file: whenever the process is killed, there is the old one or the new one.
    ///
    /// # Errors
    /// [`Error::Checkpoint`] if it cannot be written; then the old one stays.
    pub fn save(&self, words: &[u64]) -> Result<(), Error> {
        let written = self.replace(&encoded(&self.settings, words));
        written.map_err(|source| self.error(Fault::Io { doing: "write it", source }))
    }

    /// That `fault` is wrong with it.
    pub fn error(&self, fault: Fault) -> Error {
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
