//! The exhibits on the page and in files. One file each.

mod nested;
mod rows;
mod shadow;
mod two_techniques;

pub(super) use rows::csv;

use crate::exhibits::Exhibits;
use crate::output::picture::Picture;

/// The sections of the page.
pub(super) fn sections(exhibits: &Exhibits) -> String {
    nested::section(&exhibits.nested)
        + &shadow::section(&exhibits.shadow)
        + &two_techniques::section(&exhibits.two_techniques)
}

/// The pictures that are written beside the page.
pub(super) fn pictures(exhibits: &Exhibits) -> Vec<Picture> {
    shadow::pictures(&exhibits.shadow)
}
