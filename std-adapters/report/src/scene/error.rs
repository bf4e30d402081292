//! What can be wrong with the report of a scene.

use core::fmt;
use ratiocv_scene::RenderError;

/// Why there is no report; `Display` says what to do about it.
#[derive(Debug)]
#[non_exhaustive]
pub enum SceneFault {
    /// The scene cannot be rendered.
    Render(RenderError),
    /// The kept reference cannot be read or written.
    Reference(ratiocv_threads::Error),
}

impl fmt::Display for SceneFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Render(error) => error.fmt(f),
            Self::Reference(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for SceneFault {}

impl From<RenderError> for SceneFault {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}
