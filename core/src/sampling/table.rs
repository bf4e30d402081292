//! What tables of weights have in common.

use crate::error::Error;

/// The binary exponent of the largest of `entries`, which are finite and not negative, and one of them
/// positive. In units of it sums neither overflow nor vanish, and scaling rounds nothing that counts.
pub(super) fn exponent(what: &'static str, entries: impl IntoIterator<Item = f64>) -> Result<i32, Error> {
    let mut largest = 0.0;
    for (index, value) in entries.into_iter().enumerate() {
        if !(0.0..=f64::MAX).contains(&value) {
            return Err(Error::TableEntry { what, index, value });
        }
        if value > largest {
            largest = value;
        }
    }
    if largest > 0.0 { Ok(libm::frexp(largest).1) } else { Err(Error::TableOfZeros { what }) }
}

/// `weights` in units of the largest's binary exponent.
pub(super) fn scaled<const K: usize>(weights: &[f64; K]) -> Result<[f64; K], Error> {
    let exponent = exponent("weight", *weights)?;
    Ok(weights.map(|weight| libm::ldexp(weight, -exponent)))
}
