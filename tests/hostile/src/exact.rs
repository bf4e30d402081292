//! Numbers without rounding: what floating-point numbers, their sums and products are.

use core::ops::{Add, Mul, Sub};
use num_bigint::{BigInt, Sign};

/// `mantissa`·2^`exponent`.
#[derive(Clone, Debug)]
pub(crate) struct Exact {
    mantissa: BigInt,
    exponent: i64,
}

impl Exact {
    /// `x`, which must be finite.
    pub(crate) fn new(x: f64) -> Self {
        assert!(x.is_finite(), "{x} is no number");
        let (bits, exponent) = (x.to_bits() & ((1 << 52) - 1), (x.to_bits() >> 52 & 0x7ff) as i64);
        let (whole, exponent) = if exponent == 0 { (bits, -1074) } else { (bits | 1 << 52, exponent - 1075) };
        let mantissa = BigInt::from(whole);
        Self { mantissa: if x < 0.0 { -mantissa } else { mantissa }, exponent }
    }

    pub(crate) fn sum(numbers: impl IntoIterator<Item = Self>) -> Self {
        numbers.into_iter().fold(Self::new(0.0), |sum, x| &sum + &x)
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.mantissa.sign() == Sign::NoSign
    }

    pub(crate) fn abs(&self) -> Self {
        Self { mantissa: self.mantissa.magnitude().clone().into(), exponent: self.exponent }
    }

    /// self/other to some 50 bits: 0 or infinite out of range, NaN for 0/0.
    pub(crate) fn over(&self, other: &Self) -> f64 {
        let ((a, i), (b, j)) = (self.leading(), other.leading());
        libm::ldexp(a / b, (i - j).clamp(-4096, 4096) as i32)
    }

    /// The nearest `f64` or one beside it.
    pub(crate) fn value(&self) -> f64 {
        self.over(&Self::new(1.0))
    }

    /// The leading bits as a number in [½, 1], and the exponent that is left.
    fn leading(&self) -> (f64, i64) {
        let bits = self.mantissa.bits();
        let drop = bits.saturating_sub(64);
        let (sign, digits) = (&self.mantissa >> drop).to_u64_digits();
        // ≫ rounds down: one too low in the last of 64 bits at most.
        let top = digits.first().map_or(0.0, |top| *top as f64);
        let top = if digits.len() > 1 { 2.0_f64.powi(64) } else { top };
        let (mantissa, exponent) = libm::frexp(if sign == Sign::Minus { -top } else { top });
        (mantissa, self.exponent + drop as i64 + i64::from(exponent))
    }

    fn aligned(&self, exponent: i64) -> BigInt {
        &self.mantissa << (self.exponent - exponent)
    }
}

impl Add for &Exact {
    type Output = Exact;
    fn add(self, other: Self) -> Exact {
        let exponent = self.exponent.min(other.exponent);
        Exact { mantissa: self.aligned(exponent) + other.aligned(exponent), exponent }
    }
}

impl Sub for &Exact {
    type Output = Exact;
    fn sub(self, other: Self) -> Exact {
        let exponent = self.exponent.min(other.exponent);
        Exact { mantissa: self.aligned(exponent) - other.aligned(exponent), exponent }
    }
}

impl Mul for &Exact {
    type Output = Exact;
    fn mul(self, other: Self) -> Exact {
        Exact { mantissa: &self.mantissa * &other.mantissa, exponent: self.exponent + other.exponent }
    }
}

/// The determinant of a small matrix, by its first row.
pub(crate) fn determinant(matrix: &[Vec<Exact>]) -> Exact {
    let Some((first, rest)) = matrix.split_first() else { return Exact::new(1.0) };
    Exact::sum((0..first.len()).map(|j| {
        let minor: Vec<Vec<Exact>> = rest.iter().map(|row| without(row, j)).collect();
        let term = &first[j] * &determinant(&minor);
        &term * &Exact::new(if j % 2 == 0 { 1.0 } else { -1.0 })
    }))
}

/// `row` without entry `j`.
pub(crate) fn without<T: Clone>(row: &[T], j: usize) -> Vec<T> {
    row.iter().enumerate().filter(|(i, _)| *i != j).map(|(_, x)| x.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_products_are_not_rounded() {
        let sum = Exact::sum([1e300, 1e-300, -1e300].map(Exact::new));
        assert_eq!(sum.value(), 1e-300);
        assert_eq!((&Exact::new(1e-300) * &Exact::new(-3e-300)).over(&Exact::new(1e-300)), -3e-300);
        assert!((&Exact::new(5e-324) - &Exact::new(5e-324)).is_zero());
        assert_eq!(Exact::new(-3.0).over(&Exact::new(7.0)), -3.0 / 7.0);
        assert_eq!(Exact::new(-0.1).abs().value(), 0.1);
    }

    #[test]
    fn determinants_are_those_of_the_textbook() {
        let matrix = |rows: [[f64; 3]; 3]| rows.map(|row| row.map(Exact::new).to_vec()).to_vec();
        assert_eq!(determinant(&matrix([[2.0, 1.0, 0.0], [1.0, 3.0, 1.0], [0.0, 1.0, 4.0]])).value(), 18.0);
        assert!(determinant(&matrix([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]])).is_zero());
    }
}
