//! Numbers with an exponent of their own: products and quotients that must not leave the range.

use core::ops::{Add, Div, Mul};

/// `mantissa`·2^`exponent`: rounds like an `f64` whose exponent range has no end.
///
/// The mantissa is 0, not finite, or of size in [½, 1).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scaled {
    mantissa: f64,
    exponent: i64,
}

impl Scaled {
    pub(crate) const ZERO: Self = Self { mantissa: 0.0, exponent: 0 };
    pub(crate) const ONE: Self = Self { mantissa: 0.5, exponent: 1 };
    pub(crate) const NAN: Self = Self { mantissa: f64::NAN, exponent: 0 };

    pub(crate) fn new(x: f64) -> Self {
        Self::normal(x, 0)
    }

    fn normal(mantissa: f64, exponent: i64) -> Self {
        let (mantissa, more) = libm::frexp(mantissa);
        Self { mantissa, exponent: exponent + i64::from(more) }
    }

    /// The nearest `f64`: 0 or infinite out of its range.
    pub(crate) fn value(self) -> f64 {
        shifted(self.mantissa, self.exponent)
    }

    pub(crate) fn is_finite(self) -> bool {
        self.mantissa.is_finite()
    }

    pub(crate) fn is_zero(self) -> bool {
        self.mantissa == 0.0
    }
}

/// x·2^`exponent` for |x| in [½, 1): beyond ±4096 nothing changes any more.
fn shifted(x: f64, exponent: i64) -> f64 {
    libm::ldexp(x, exponent.clamp(-4096, 4096) as i32)
}

impl Mul for Scaled {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::normal(self.mantissa * other.mantissa, self.exponent + other.exponent)
    }
}

impl Div for Scaled {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self::normal(self.mantissa / other.mantissa, self.exponent - other.exponent)
    }
}

impl Add for Scaled {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        // A zero has no exponent that the other could be measured against.
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        let (large, small) = if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        Self::normal(large.mantissa + shifted(small.mantissa, small.exponent - large.exponent), large.exponent)
    }
}

/// Whether y/x·h stays in the range, and is no division by 0, in whatever order it is worked out.
#[inline(always)]
pub(crate) fn are_ordinary(y: f64, x: f64, h: f64) -> bool {
    let is_ordinary = |x: f64| (1e-90..1e90).contains(&x.abs());
    (is_ordinary(y) || y == 0.0) && is_ordinary(x) && is_ordinary(h)
}

/// y/x·h, rounded as if the exponent range had no end: each order of the two operations over- or
/// underflows for some inputs whose result is an ordinary number.
///
/// Exactly `y` where x = h, so that a constant auxiliary leaves the plain mean untouched.
#[inline]
pub(crate) fn quotient_times(y: f64, x: f64, h: f64) -> f64 {
    if x == h {
        y
    } else if are_ordinary(y, x, h) {
        // Nothing leaves the range: the same bits for a tenth of the work.
        y / x * h
    } else {
        scaled_quotient_times(y, x, h)
    }
}

#[cold]
#[inline(never)]
fn scaled_quotient_times(y: f64, x: f64, h: f64) -> f64 {
    (Scaled::new(y) / Scaled::new(x) * Scaled::new(h)).value()
}

#[cfg(test)]
mod tests {
    use super::{Scaled, quotient_times};

    #[test]
    fn ordinary_numbers_are_divided_and_multiplied_once() {
        for (y, x, h) in [(3.0, 7.0, 1.0), (0.1, 0.3, 5.5), (-2.5, 1e-3, 17.0)] {
            assert_eq!(quotient_times(y, x, h).to_bits(), (y / x * h).to_bits());
        }
    }

    /// Either way of doing it has the same bits where both do: at the border of ordinary numbers too.
    #[test]
    fn ordinary_numbers_need_no_exponent_of_their_own() {
        let scaled = |y, x, h| (Scaled::new(y) / Scaled::new(x) * Scaled::new(h)).value();
        let mut x = 1e-95_f64;
        while x < 1e95 {
            for (y, h) in [(0.0, -0.3), (-0.0, 2.5), (1e-89, -1e89), (0.9e90, 1.1e-90), (3.3, 1e90), (-7e-91, 0.7)] {
                assert_eq!(quotient_times(y, x, h).to_bits(), scaled(y, x, h).to_bits(), "{y} / {x} * {h}");
            }
            x *= 1234.567;
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

    #[test]
    fn what_is_not_finite_is_as_in_plain_arithmetic() {
        let odd = [0.0, -0.0, 2.0, -3.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
        let same = |ours: f64, right: f64| ours.to_bits() == right.to_bits() || (ours.is_nan() && right.is_nan());
        for x in odd {
            for y in odd {
                let (a, b) = (Scaled::new(x), Scaled::new(y));
                assert!(same((a * b).value(), x * y), "{x} * {y}");
                assert!(same((a / b).value(), x / y), "{x} / {y}");
                // The sign of a zero that is added to a zero is not kept.
                assert!((a + b).value() == x + y || (x + y).is_nan() && !(a + b).is_finite(), "{x} + {y}");
            }
        }
    }

    #[test]
    fn sums_round_like_plain_ones_whatever_the_exponents() {
        for (x, y) in [(1.0, 1e-17), (0.1, 0.2), (-0.3, 0.1), (1e300, -1e-300), (3.5, -3.5)] {
            assert_eq!((Scaled::new(x) + Scaled::new(y)).value(), x + y);
            let tiny = Scaled::new(1e-300) * Scaled::new(1e-300);
            let far = (Scaled::new(x) * tiny + Scaled::new(y) * tiny) / tiny;
            assert!((far.value() - (x + y)).abs() <= 4.0 * f64::EPSILON * (x.abs() + y.abs()), "{x} + {y}");
        }
    }
}
