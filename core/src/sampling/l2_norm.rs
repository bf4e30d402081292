//! The size of a vector-valued integrand.

use crate::lanes::Lanes;
use crate::planted::planted;

/// √Σ_j v_j² over the channels j: the density of vector-valued importance sampling with the least
/// total variance is proportional to it (supplement, Lemma 1).
///
/// Squares neither overflow nor vanish on the way. A NaN in any channel
/// gives NaN, an infinity without one gives infinity.
///
/// ```
/// use ratiocv_core::{sampling::l2_norm, Spectrum};
/// assert_eq!(l2_norm(Spectrum([3.0_f32, -4.0])), 5.0);
/// assert!((l2_norm(Spectrum([3e200, -4e200])) / 5e200 - 1.0).abs() < 1e-15);
/// ```
pub fn l2_norm<V: Lanes>(value: V) -> f64 {
    let wide = value.widen();
    let channels = || (0..V::LANES).map(|channel| libm::fabs(wide.get(channel)));
    let largest = channels().fold(0.0, |largest, x| if x > largest || x.is_nan() { x } else { largest });
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    let exponent = libm::frexp(largest).1;
    let scaled = channels().map(|x| libm::ldexp(x, -exponent));
    let squares: f64 = scaled.map(|x| planted!("norm_power": x * x, x)).sum();
    libm::ldexp(libm::sqrt(squares), exponent)
}

#[cfg(test)]
mod tests {
    use super::l2_norm;
    use crate::spectrum::Spectrum;

    #[test]
    fn norms_keep_the_whole_range() {
        assert_eq!(l2_norm(Spectrum([2.0, -3.0, 6.0])), 7.0);
        assert_eq!(l2_norm(Spectrum([2.0_f32, -3.0, 6.0])), 7.0);
        assert_eq!(l2_norm(Spectrum([0.0, -0.0])), 0.0);
        assert_eq!(l2_norm(Spectrum([3e-320, 4e-320])), 5e-320);
        assert_eq!(l2_norm(Spectrum([1.5e308, 1.5e308])), f64::INFINITY);
    }

    #[test]
    fn what_is_not_a_number_stays_so() {
        for at in 0..3 {
            let mut value = Spectrum([1.0, f64::INFINITY, f64::NEG_INFINITY]);
            assert_eq!(l2_norm(value), f64::INFINITY);
            value[at] = f64::NAN;
            assert!(l2_norm(value).is_nan());
        }
    }
}
