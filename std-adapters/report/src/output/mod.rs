//! A report as text, files and a page.

use crate::Report;
use std::path::{Path, PathBuf};

impl Report {
    /// For the terminal.
    pub fn table(&self) -> String {
        String::new()
    }

    /// Writes.
    ///
    /// # Errors
    /// What the file system says.
    pub fn write(&self, dir: &Path) -> std::io::Result<Vec<PathBuf>> {
        std::fs::create_dir_all(dir)?;
        Ok(vec![])
    }
}
