//! What goes wrong: where, what, and what to do about it.

use core::fmt;
use std::io;

/// The exit code where the data or a file is bad.
pub const BAD_DATA: u8 = 1;
/// The exit code where the command line is wrong; clap uses the same.
pub const BAD_USAGE: u8 = 2;

/// A failure of a command. `Display` says the place, what is wrong there, and the remedy.
#[derive(Debug)]
pub struct Fault {
    kind: Kind,
    what: String,
    so_far: Option<String>,
    remedy: String,
}

#[derive(Debug, PartialEq)]
enum Kind {
    Data,
    Usage,
    BrokenPipe,
}

impl Fault {
    /// The data or a file is bad.
    pub fn data(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { kind: Kind::Data, what: what.into(), so_far: None, remedy: remedy.into() }
    }

    /// The command line is wrong.
    pub fn usage(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { kind: Kind::Usage, ..Self::data(what, remedy) }
    }

    /// Output could not be written.
    pub fn output(error: &io::Error) -> Self {
        let kind = if error.kind() == io::ErrorKind::BrokenPipe { Kind::BrokenPipe } else { Kind::Data };
        let what = format!("cannot write the output: {error}");
        Self { kind, ..Self::data(what, "check that the disk has room and that the place may be written to") }
    }

    /// With a remark on what had been done before the failure.
    pub fn after(self, so_far: impl Into<String>) -> Self {
        Self { so_far: Some(so_far.into()), ..self }
    }

    /// The process's exit code.
    pub fn exit_code(&self) -> u8 {
        match self.kind {
            Kind::Data => BAD_DATA,
            Kind::Usage => BAD_USAGE,
            // `ratiocv … | head`: the reader has what it wanted.
            Kind::BrokenPipe => 0,
        }
    }

    /// Whether there is nothing to tell the user: whoever read the output has stopped reading.
    pub fn is_silent(&self) -> bool {
        self.kind == Kind::BrokenPipe
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.what)?;
        if let Some(so_far) = &self.so_far {
            write!(f, "\n  {so_far}")?;
        }
        write!(f, "\n  help: {}", self.remedy)
    }
}

impl core::error::Error for Fault {}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        Self::output(&error)
    }
}
