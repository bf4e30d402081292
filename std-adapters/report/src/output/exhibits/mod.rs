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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Options;
    use rayon::ThreadPoolBuilder;

    /// Everything that is written: the numbers, the pictures, the page.
    fn written(threads: usize) -> (String, Vec<Vec<u8>>, String) {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let exhibits = Exhibits::measure(&Options { quick: true, ..Options::default() }, &pool, &|_| ());
        let pictures = pictures(&exhibits).iter().map(|picture| picture.png().unwrap()).collect();
        (csv(&exhibits).unwrap(), pictures, sections(&exhibits))
    }

    #[test]
    fn threads_change_no_bit() {
        let (rows, pictures, page) = written(1);
        assert_eq!((rows.clone(), pictures.clone(), page.clone()), written(3));
        assert_eq!(pictures.len(), 8);
        assert_eq!(page.matches("data:image/png;base64,").count(), 8);
        // Nothing is loaded from elsewhere.
        assert_eq!(page.matches("src=").count(), 8);
        assert!(!page.contains("could not be drawn") && !page.contains("href"));
        // Header; per channel a limit and four estimators at nine sizes; two regions of four estimators; a limit
        // and two numbers at three sizes of fourteen.
        assert_eq!(rows.lines().count(), 1 + 3 * (1 + 4 * 9) + 2 * 4 + 14 * (1 + 2 * 3));
    }
}
