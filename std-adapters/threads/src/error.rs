//! What can be wrong with a run.

use core::fmt;
use std::io;
use std::path::PathBuf;

/// Why a [`Run`](crate::Run) gives no outcome; `Display` says what to do about it.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// There is no estimate: too few draws, or a bad parameter. What was done is in the checkpoint, if
    /// there is one.
    Estimate(ratiocv_core::Error),
    /// The checkpoint cannot be written or read, or is not one of this run. It was left as it is.
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        fault: Fault,
    },
}

/// What is wrong with a checkpoint.
#[derive(Debug)]
#[non_exhaustive]
pub enum Fault {
    /// The operating system says no.
    Io {
        /// To what.
        doing: &'static str,
        /// Why.
        source: io::Error,
    },
    /// It begins with something else than a checkpoint does.
    Foreign,
    /// Its end is missing.
    Truncated {
        /// The bytes that are there.
        bytes: u64,
        /// The bytes that should be, at least.
        of: u64,
    },
    /// Its checksum is not that of its contents, or the contents contradict themselves.
    Damaged(&'static str),
    /// It has another format version.
    Version {
        /// Its version.
        file: u32,
        /// The one version that is read here.
        here: u32,
    },
    /// It is a checkpoint of a run with other settings.
    OtherRun {
        /// The first setting that differs.
        setting: String,
        /// Its value in this run.
        here: String,
        /// Its value in the file.
        file: String,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Estimate(error) => error.fmt(f),
            Self::Checkpoint { path, fault } => write!(f, "checkpoint {}: {fault}", path.display()),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const RESTORE: &str = "restore a copy of it, or delete it to start anew";
        match self {
            Self::Io { doing, source } => {
                write!(f, "cannot {doing}: {source}: give a file name in a folder that exists and may be written to")
            }
            Self::Foreign => f.write_str("this is not a checkpoint of ratiocv: give another file name"),
            Self::Truncated { bytes, of } => write!(f, "truncated: {bytes} of {of} bytes: {RESTORE}"),
            Self::Damaged(what) => write!(f, "damaged: {what}: {RESTORE}"),
            Self::Version { file, here } => write!(
                f,
                "format version {file}, and this program reads version {here}: resume with the program that wrote it, \
                 or delete it to start anew"
            ),
            Self::OtherRun { setting, here, file } => write!(
                f,
                "made by another run: {setting} is {here} here and {file} in the file: resume with the settings of the \
                 file, or give another file name to start anew"
            ),
        }
    }
}

impl core::error::Error for Error {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Estimate(error) => Some(error),
            Self::Checkpoint { fault: Fault::Io { source, .. }, .. } => Some(source),
            Self::Checkpoint { .. } => None,
        }
    }
}

impl From<ratiocv_core::Error> for Error {
    fn from(error: ratiocv_core::Error) -> Self {
        Self::Estimate(error)
    }
}
