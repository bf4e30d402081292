//! A report as text, files and a page.

mod csv;
mod json;
mod page;
mod plots;
mod summary;
mod table;
mod words;

use crate::Report;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

impl Report {
    /// For a terminal: a summary, then one table per problem, at most 110 columns wide.
    pub fn table(&self) -> String {
        table::table(self)
    }

    /// Writes `report.json`, `report.csv` and `index.html` into `dir`, which is made if need be, and returns
    /// their paths.
    ///
    /// # Errors
    /// Whatever the file system says.
    pub fn write(&self, dir: &Path) -> io::Result<Vec<PathBuf>> {
        fs::create_dir_all(dir)?;
        let files =
            [("report.json", json::json(self)?), ("report.csv", csv::csv(self)?), ("index.html", page::page(self))];
        let mut paths = Vec::new();
        for (name, text) in files {
            let path = dir.join(name);
            fs::write(&path, text)?;
            paths.push(path);
        }
        Ok(paths)
    }
}
