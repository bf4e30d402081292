//! Moments against exact ones.

use crate::bytes::{Bytes, Reach, draws};
use crate::truth::Truth;
use ratiocv_core::moments::{Accumulate, Comoments, HasComoments, HasMeans, Moments};
use ratiocv_core::{Draw, Estimator, Flags, Integrals, Plain, Scalar};

/// Means, squares and products of draws in `f32` or `f64`, added one by one or at once: exact but for rounding, or
/// flagged.
///
/// A mean may be off by 41 ε of the range of the numbers, a sum of squares by 208 ε·N of the square of that range (of f,
/// and twice of h on the steepest slope that residuals were about), and merges in `f64` add to that.
pub fn moments(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let kind = bytes.byte();
    let reach = if kind & 2 == 0 { Reach::Moderate } else { Reach::Finite };
    if kind & 1 == 0 {
        of::<f32>(&bytes.points::<f32, 2>(reach, 200))
    } else {
        of::<f64>(&bytes.points::<f64, 2>(reach, 200))
    }
}

fn of<S: Scalar>(points: &[[f64; 2]]) {
    let draws: Vec<Draw<S>> = draws(points);
    let numbers = |entry: usize| -> Vec<f64> { points.iter().map(|point| point[entry]).collect() };
    let (f, h) = (Truth::new(&numbers(0)), Truth::new(&numbers(1)));

    let (mut one_by_one, mut steepest) = (Comoments::<S>::default(), 0.0_f64);
    for draw in &draws {
        one_by_one.add(*draw);
        steepest = steepest.max(one_by_one.closed().channel(0).comoments().slope[0].abs());
    }
    let mut at_once = Comoments::<S>::default();
    at_once.add_batch(&draws);
    for (moments, how) in [(&one_by_one, "one by one"), (&at_once, "at once")] {
        assert_eq!(moments.count(), draws.len() as u64);
        let channel = moments.closed().channel(0);
        let (means, spread) = (channel.means(moments.count()), channel.comoments());
        f.mean_is::<S>(means.f, &format!("mean of f, {how}"));
        h.mean_is::<S>(means.h[0], &format!("mean of h, {how}"));
        if means.f.is_finite() && means.h[0].is_finite() {
            h.products_are::<S>(&h, spread.hh[0][0], &format!("squares of h, {how}"));
        }
        let plain = Plain.estimate_anyway(moments, &Integrals::ONE);
        let unknown = Flags::OVERFLOW | Flags::UNDERFLOW | Flags::NONFINITE;
        let flagged = (plain.flags(0) & unknown) != Flags::NONE || plain.flags(0).contains(Flags::NO_SUPPORT);
        let known = plain.value.is_finite() && plain.std_error.is_finite();
        assert!(known || flagged || draws.len() < 2, "{how}: unknown, and no flag says why: {plain:?}");
        assert!(plain.std_error.is_nan() || plain.std_error >= 0.0, "{how}: {plain:?}");
    }
    // Residuals of the draws in one call are about other slopes.
    let channel = one_by_one.closed().channel(0);
    let (means, spread) = (channel.means(one_by_one.count()), channel.comoments());
    if means.f.is_finite() && means.h[0].is_finite() && steepest.is_finite() {
        let own = f.about(steepest * h.range);
        if spread.hh[0][0].is_finite() {
            h.products_are::<S>(&own, spread.fh(0), "products");
        }
        // Residuals about a slope may leave the range where neither f nor h does, and squares of h that left the range take
        // those of f with them; that is flagged, above.
        if spread.ff().is_finite() || (steepest == 0.0 && spread.hh[0][0].is_finite()) {
            own.products_are::<S>(&own, spread.ff(), "squares of f");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block whose first draw is an outlier is summed about it: rounding is relative to the range, not to the sizes.
    #[test]
    fn rounding_is_relative_to_the_range() {
        let mut points = vec![[f64::from(1.3_f32), 1.0]; 68];
        points[4][0] = 1e7;
        of::<f32>(&points);
        let mut moments = Comoments::<f32>::default();
        draws::<f32, 1, 2>(&points).iter().for_each(|draw| moments.add(*draw));
        let right = points.iter().map(|[f, _]| *f).sum::<f64>() / 68.0;
        let off = (moments.closed().channel(0).means(68).f - right).abs() / right;
        assert!(off > 8.0 * f64::from(f32::EPSILON), "{off:e}");
    }
}
