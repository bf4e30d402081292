//! A report as text, files and a page.

mod coverage;
mod csv;
mod exhibits;
mod headings;
mod json;
mod page;
mod picture;
mod plots;
mod poor;
mod scene;
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

    /// Writes `report.json`, `report.csv` and `index.html`, and `exhibits.csv` and the pictures of the exhibits
    /// where these were measured, into `dir`, which is made if need be; returns their paths.
    ///
    /// # Errors
    /// Whatever the file system says.
    pub fn write(&self, dir: &Path) -> io::Result<Vec<PathBuf>> {
        fs::create_dir_all(dir)?;
        let mut files = vec![
            ("report.json".into(), json::json(self)?.into_bytes()),
            ("report.csv".into(), csv::csv(self)?.into_bytes()),
            ("index.html".into(), page::page(self).into_bytes()),
        ];
        if let Some(measured) = &self.exhibits {
            files.push(("exhibits.csv".into(), exhibits::csv(measured)?.into_bytes()));
            for picture in exhibits::pictures(measured) {
                files.push((format!("{}.png", picture.name), picture.png()?));
            }
        }
        let mut paths = Vec::new();
        for (name, bytes) in files {
            let path = dir.join(name);
            fs::write(&path, bytes)?;
            paths.push(path);
        }
        Ok(paths)
    }
}
