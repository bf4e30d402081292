//! Elementary functions without branches, tables or fused operations: a loop over an array of any length
//! becomes vector instructions, and every lane is the same bits as one call.

mod exp;
mod ln;
pub(crate) mod uniform;

use rand_core::Rng;
use ratiocv_core::Scalar;

/// Uniform numbers, exp and ln of `f64` and `f32`, the latter two in additions, multiplications, one division and shifts of bits.
///
/// *Implemented by* those two; *called by* problems that compute many draws at a time. The names keep out
/// of the way of `std`'s methods, whose bits depend on the platform.
///
/// # Laws
/// The same bits on every platform and for any number of lanes. From 32 lanes on, loops are vector
/// instructions. Errors are stated in units of the last
/// place of the result (ulp), in `f64` against `libm`.
///
/// ```
/// use ratiocv_simd::functions::Elementary;
/// let mut x = [-1.0, 0.0, 0.5, 2.0_f64];
/// f64::exponentials(&mut x);
/// assert_eq!(x, [-1.0_f64, 0.0, 0.5, 2.0].map(Elementary::exponential));
/// assert_eq!(x[1], 1.0);
/// assert!((x[3].logarithm() - 2.0).abs() < 1e-15);
/// ```
pub trait Elementary: Scalar {
    /// e^x in place of each x, to 1 ulp (2 where the result is subnormal). 0 and ∞ beyond the range, NaN for
    /// NaN.
    fn exponentials<const N: usize>(x: &mut [Self; N]);

    /// ln x in place of each x, to 2 ulp. −∞ for zeros of either sign, NaN below 0 and for NaN, ∞ for ∞.
    fn logarithms<const N: usize>(x: &mut [Self; N]);

    /// ln(n/d) in place of each n, with one division in all, to 2 ulp.
    ///
    /// Both must be positive and, like the quotient, far from the ends of the range (2^±500 in `f64`,
    /// 2^±60 in `f32`); nothing is checked, and anything else gives a number without meaning.
    fn logarithms_of_ratios<const N: usize>(n: &mut [Self; N], d: &[Self; N]);

    /// e^x: see [`exponentials`](Self::exponentials).
    #[inline(always)]
    fn exponential(self) -> Self {
        let mut x = [self];
        Self::exponentials(&mut x);
        x[0]
    }

    /// ln x: see [`logarithms`](Self::logarithms).
    #[inline(always)]
    fn logarithm(self) -> Self {
        let mut x = [self];
        Self::logarithms(&mut x);
        x[0]
    }

    /// The next `D·N` numbers in [0, 1) from the generator's bytes, `D` to a draw: row d has the d-th of every
    /// draw.
    ///
    /// In `f64` multiples of 2⁻⁵³ from eight bytes each, the numbers of [`ratiocv_core::unit_interval`] to the
    /// bit if the generator fills bytes with whole little-endian words of 64 bits. In `f32` multiples of 2⁻²⁴
    /// from four bytes each.
    ///
    /// ```
    /// use ratiocv_core::unit_interval;
    /// use ratiocv_simd::{Xoshiro16, functions::Elementary};
    /// let (mut one_by_one, mut at_once) = (Xoshiro16::stream(7, 0), Xoshiro16::stream(7, 0));
    /// let rows: [[f64; 20]; 5] = f64::unit_intervals(&mut at_once);
    /// for draw in 0..20 {
    ///     assert!(rows.iter().all(|row| row[draw] == unit_interval(&mut one_by_one)));
    /// }
    /// ```
    fn unit_intervals<R: Rng + ?Sized, const D: usize, const N: usize>(rng: &mut R) -> [[Self; N]; D];
}

/// The functions of one floating-point format, from its constants.
macro_rules! elementary {
    ($($float:ident, $bits:ident, $format:ident;)*) => {$(
        impl Elementary for $float {
            #[inline(always)]
            fn exponentials<const N: usize>(x: &mut [Self; N]) {
                exp::$format::exp(x);
            }
            #[inline(always)]
            fn logarithms<const N: usize>(x: &mut [Self; N]) {
                ln::$format::ln(x);
            }
            #[inline(always)]
            fn logarithms_of_ratios<const N: usize>(n: &mut [Self; N], d: &[Self; N]) {
                ln::$format::ln_ratio(n, d);
            }
            #[inline(always)]
            fn unit_intervals<R: Rng + ?Sized, const D: usize, const N: usize>(rng: &mut R) -> [[Self; N]; D] {
                let mut bytes = [[[0; size_of::<$float>()]; D]; N];
                rng.fill_bytes(bytes.as_flattened_mut().as_flattened_mut());
                let mut rows = [[0.0; N]; D];
                for (draw, numbers) in bytes.iter().enumerate() {
                    for (row, number) in rows.iter_mut().zip(numbers) {
                        row[draw] = uniform::$format($bits::from_le_bytes(*number));
                    }
                }
                rows
            }
        }
    )*};
}

elementary! { f32, u32, binary32; f64, u64, binary64; }

/// c₀ + c₁t + c₂t² + …, pair by pair (Estrin 1960): fewer operations wait for each other than in Horner's rule.
macro_rules! polynomial {
    ($t:ident: $c:expr) => { $c };
    ($t:ident: $($c:expr),+) => {{
        let _square = $t * $t;
        $crate::functions::polynomial!($t, _square, []: $($c),+)
    }};
    ($t:ident, $square:ident, [$($pair:expr),*]: $a:expr, $b:expr $(, $c:expr)*) => {
        $crate::functions::polynomial!($t, $square, [$($pair,)* ($a + $t * $b)]: $($c),*)
    };
    ($t:ident, $square:ident, [$($pair:expr),*]: $($a:expr)?) => {
        $crate::functions::polynomial!($square: $($pair),* $(, $a)?)
    };
}
pub(crate) use polynomial;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Xoshiro16;
    use core::hint::black_box;

    /// |got − right| in units of the last place of `right`; NaN if either is.
    pub(super) fn ulps(got: f64, right: f64) -> f64 {
        (got - right).abs() / (f64::from_bits(right.abs().to_bits() + 1) - right.abs())
    }

    /// Likewise in units of `f32`, but with a right answer that has more digits.
    pub(super) fn ulps_f32(got: f32, right: f64) -> f64 {
        let rounded = (right as f32).abs();
        let place = f64::from(f32::from_bits(rounded.to_bits() + 1)) - f64::from(rounded);
        (f64::from(got) - right).abs() / place
    }

    fn all<T: Elementary, const W: usize>(x: [T; W]) -> [[T; W]; 3] {
        let mut all = [x; 3];
        T::exponentials(&mut all[0]);
        T::logarithms(&mut all[1]);
        T::logarithms_of_ratios(&mut all[2], &[T::from_f64(3.7); W]);
        all
    }

    /// Arrays of 1 to 16 lanes, each function, against calls that the compiler cannot join.
    fn same_bits<T: Elementary, const W: usize>(bits: impl Fn(T) -> u64) {
        for i in 0..500 {
            let x: [T; W] = core::array::from_fn(|lane| T::from_f64(1e-3 + 0.17 * (i * W + lane) as f64));
            let together = all(black_box(x));
            for lane in 0..W {
                let alone = all([black_box(x[lane])]);
                for (together, alone) in together.iter().zip(alone) {
                    assert_eq!(bits(together[lane]), bits(alone[0]), "lane {lane} of {W}");
                }
            }
        }
    }

    #[test]
    fn uniform_numbers_are_the_cores_and_never_reach_1() {
        let (fine, coarse) = (uniform::binary64, uniform::binary32);
        assert_eq!((fine(u64::MAX), coarse(u32::MAX)), (1.0 - f64::EPSILON / 2.0, 1.0 - f32::EPSILON / 2.0));
        assert_eq!((fine(0), coarse(0), fine((1 << 11) - 1), coarse((1 << 8) - 1)), (0.0, 0.0, 0.0, 0.0));
        assert_eq!((fine(1 << 11), coarse(1 << 8)), (f64::EPSILON / 2.0, f32::EPSILON / 2.0));
        let [mut right, mut f64s, mut f32s] = [(); 3].map(|()| Xoshiro16::stream(5, 6));
        let (f64s, f32s): ([[f64; 70]; 3], [[f32; 140]; 3]) =
            (f64::unit_intervals(&mut f64s), f32::unit_intervals(&mut f32s));
        for i in 0..3 * 70 {
            let number = right.clone().next_u64();
            assert_eq!(f64s[i % 3][i / 3], ratiocv_core::unit_interval(&mut right));
            for (j, half) in [number as u32, (number >> 32) as u32].into_iter().enumerate() {
                let i = 2 * i + j;
                assert_eq!(f64::from(f32s[i % 3][i / 3]), f64::from(half >> 8) / 16_777_216.0);
            }
        }
    }

    #[test]
    fn polynomials_of_any_length() {
        let t = 3.0;
        assert_eq!([polynomial!(t: 2.0), polynomial!(t: 2.0, 5.0), polynomial!(t: 2.0, 5.0, 7.0)], [2.0, 17.0, 80.0]);
        let right = 2.0 + t * (5.0 + t * (7.0 + t * (11.0 + t * (13.0 + t * (17.0 + t * 19.0)))));
        assert_eq!(polynomial!(t: 2.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0), right);
    }

    #[test]
    fn any_number_of_lanes_gives_the_same_bits() {
        macro_rules! widths { ($($width:literal)*) => {$(
            same_bits::<f64, $width>(f64::to_bits);
            same_bits::<f32, $width>(|x| u64::from(x.to_bits()));
        )*} }
        widths!(1 2 3 4 5 7 8 13 16 64);
    }
}
