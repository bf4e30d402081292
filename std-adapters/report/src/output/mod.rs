//! A report as text, files and a page.

mod coverage;
mod csv;
mod headings;
mod json;
mod page;
mod plots;
mod poor;
mod selection;
mod summary;
mod table;
#[cfg(test)]
mod tests;
mod words;

use crate::Report;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub use table::TableOptions;

impl Report {
    /// For a terminal: a summary, one table per problem, and where error bars are poor, at most 110 columns wide.
    pub fn table(&self, options: TableOptions) -> String {
        table::table(self, options)
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
