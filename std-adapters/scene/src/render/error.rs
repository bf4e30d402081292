//! What can be wrong with a render.

use crate::SceneError;
use core::fmt;

/// Why there is no image; `Display` says what to do about it.
#[derive(Debug)]
#[non_exhaustive]
pub enum RenderError {
    /// The scene cannot be rendered.
    Scene(SceneError),
    /// The file that the render is kept in.
    Checkpoint(ratiocv_threads::Error),
    /// Images of different scenes, sizes or settings cannot be merged.
    Mismatch,
    /// A setting makes no sense.
    Setting {
        /// Its name.
        setting: &'static str,
        /// What it must be.
        needed: &'static str,
    },
}

impl fmt::Display for RenderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Checkpoint(error) => error.fmt(f),
            Self::Mismatch => {
                f.write_str("the images differ in size or in what was kept: merge images of one scene and one method")
            }
            Self::Setting { setting, needed } => write!(f, "{setting} must be {needed}"),
        }
    }
}

impl core::error::Error for RenderError {}

impl From<SceneError> for RenderError {
    fn from(error: SceneError) -> Self {
        Self::Scene(error)
    }
}

impl From<ratiocv_threads::Error> for RenderError {
    fn from(error: ratiocv_threads::Error) -> Self {
        Self::Checkpoint(error)
    }
}
