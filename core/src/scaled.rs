//! Products and quotients whose intermediate results must not leave the exponent range.

/// y/x·h, rounded as if the exponent range had no end: each order of the two operations over- or
/// underflows for some inputs whose result is an ordinary number.
///
/// Exactly `y` where x = h, so that a constant auxiliary leaves the plain mean untouched.
pub(crate) fn quotient_times(y: f64, x: f64, h: f64) -> f64 {
    if x == h {
        return y;
    }
    if y == 0.0 || !(y.is_finite() && x.is_finite() && h.is_finite()) {
        return y / x * h;
    }
    let ((y, j), (x, k), (h, l)) = (libm::frexp(y), libm::frexp(x), libm::frexp(h));
    libm::ldexp(y / x * h, j - k + l)
}

#[cfg(test)]
mod tests {
    use super::quotient_times;

    #[test]
    fn ordinary_numbers_are_divided_and_multiplied_once() {
        for (y, x, h) in [(3.0, 7.0, 1.0), (0.1, 0.3, 5.5), (-2.5, 1e-3, 17.0)] {
            assert_eq!(quotient_times(y, x, h).to_bits(), (y / x * h).to_bits());
        }
    }

    #[test]
    fn intermediate_results_neither_overflow_nor_vanish() {
        assert!((quotient_times(1e-250, 1e-60, 1e300) / 1e110 - 1.0).abs() <= f64::EPSILON);
        assert_eq!(quotient_times(1.0, 5e-324, 5e-324), 1.0);
        assert_eq!(quotient_times(3.0, 5e-324, 1e-323), 6.0);
        assert_eq!(quotient_times(1e300, 1e-300, 1e-300), 1e300);
        assert_eq!(quotient_times(0.0, -3.0, 2.0), 0.0);
        assert!(quotient_times(f64::NAN, 1.0, 2.0).is_nan());
    }
}
