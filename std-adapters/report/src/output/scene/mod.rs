//! The report of a scene as text, files and a page.

mod files;
mod images;
mod page;
mod table;

use crate::scene::SceneReport;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

impl SceneReport {
    /// For a terminal: errors, gains and run times by method and samples.
    pub fn table(&self) -> String {
        table::table(self)
    }

    /// Writes `scene.html`, `scene.csv`, `scene.json` and the images as PNG into `dir`, which is made if need be; returns
    /// their paths.
    ///
    /// # Errors
    /// Whatever the file system says.
    pub fn write(&self, dir: &Path) -> io::Result<Vec<PathBuf>> {
        fs::create_dir_all(dir)?;
        let mut files = vec![
            ("scene.html".to_owned(), page::page(self).into_bytes()),
            ("scene.csv".to_owned(), files::csv(self)?.into_bytes()),
            ("scene.json".to_owned(), files::json(self)?.into_bytes()),
        ];
        for (picture, _) in images::pictures(self) {
            files.push((format!("{}.png", picture.name), picture.png()?));
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
