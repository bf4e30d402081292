//! What is wrong with a scene file, and where.

use core::fmt;

/// Why there is no scene: the place, what is wrong, and what would be right.
///
/// ```
/// use ratiocv_scene::{Description, Leniency};
/// let text = "<scene version='3.0.0'>\n  <shape type='torus'/>\n</scene>";
/// let error = Description::parse(text, "scene.xml", Leniency::Strict).unwrap_err();
/// assert_eq!((error.line(), error.column()), (Some(2), Some(3)));
/// assert_eq!(
///     error.to_string(),
///     r#"scene.xml, line 2, column 3: <shape type="torus">: not supported; supported are sphere, rectangle, cube, obj, ply"#
/// );
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    pub(super) file: String,
    pub(super) position: Option<(usize, usize)>,
    pub(super) element: String,
    pub(super) what: String,
    pub(super) unsupported: bool,
}

impl Error {
    /// Something that concerns a file as a whole.
    pub(super) fn of_file(file: impl fmt::Display, what: impl fmt::Display) -> Self {
        Self {
            file: file.to_string(),
            position: None,
            element: String::new(),
            what: what.to_string(),
            unsupported: false,
        }
    }

    /// The line, from 1; `None` if the file as a whole is meant.
    pub fn line(&self) -> Option<usize> {
        self.position.map(|(line, _)| line)
    }

    /// The column, from 1, in bytes.
    pub fn column(&self) -> Option<usize> {
        self.position.map(|(_, column)| column)
    }

    /// The file is in order as far as Mitsuba goes, but asks for something that is not there; a
    /// [lenient](super::Leniency::Lenient) reading leaves it out.
    pub fn is_unsupported(&self) -> bool {
        self.unsupported
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if let Some((line, column)) = self.position {
            write!(f, ", line {line}, column {column}")?;
        }
        if !self.element.is_empty() {
            write!(f, ": {}", self.element)?;
        }
        write!(f, ": {}", self.what)
    }
}

impl core::error::Error for Error {}

/// What was read differently from what the file says, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Warning {
    pub(super) error: Error,
    pub(super) instead: &'static str,
}

impl Warning {
    /// What could not be read as it stands.
    pub fn error(&self) -> &Error {
        &self.error
    }

    /// What was done instead.
    pub fn instead(&self) -> &str {
        self.instead
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.error, self.instead)
    }
}
