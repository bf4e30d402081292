//! Kernels on lanes of other widths: estimators read `f64` whatever the lanes are.

use crate::fed::{Lines, show};
use crate::hostile::draw;
use ratiocv_core::Lanes;
use ratiocv_core::moments::{Comoments, RatioVariance, Third};

/// Shows a hash of what each keeps, on lanes `V`, whose name is `lanes`.
pub(crate) fn all<V: Lanes>(lines: &mut Lines<'_>, lanes: &str) {
    comoments::<V>(lines, lanes);
    show(lines, [lanes, "ratios"], RatioVariance::<V>::default(), &draw, [1.0], []);
    show(lines, [lanes, "third"], Third::<V>::default(), &draw, [1.0], []);
}

/// Of the co-moments alone.
pub(crate) fn comoments<V: Lanes>(lines: &mut Lines<'_>, lanes: &str) {
    show(lines, [lanes, "comoments"], Comoments::<V>::default(), &draw, [1.0], []);
}
