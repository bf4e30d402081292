//! e^x.

/// Reduction by a two-part ln 2 (Cody and Waite 1980), then a rational function of the remainder, as in
/// fdlibm (Sun Microsystems 1993).
///
/// x = k·ln 2 + r, |r| ≤ ½ ln 2. With R = r·coth(r/2) = 2 + r²P(r²), an even function, e^r = (R + r)/(R − r),
/// here with c = r − r²P as 1 + r + rc/(2 − c), whose rounding errors are small beside the 1. The
/// coefficients of P are the minimax ones of the relative error of e^r: 2·10⁻¹⁹ and 5·10⁻¹⁰.
///
/// Stage by stage over all lanes: a chain of operations that wait for each other is then short enough for the
/// processor to work on several lanes' at once.
macro_rules! exp {
    ($name:ident: $float:ident, $mantissa:literal, $bias:literal, $half:expr, $range:expr, $ln2:expr, $($p:literal),*) => {
        pub(super) mod $name {
            use crate::functions::polynomial;

            // So large that its last bit is worth 1: adding it rounds to an integer, in the low bits.
            const ROUND: $float = $half;
            const RANGE: [$float; 2] = $range;
            const LN_2: [$float; 2] = $ln2;

            #[inline(always)]
            pub(in crate::functions) fn exp<const N: usize>(x: &mut [$float; N]) {
                let (mut rounded, mut high, mut low, mut c) = ([0.0; N], [0.0; N], [0.0; N], [0.0; N]);
                for i in 0..N {
                    // Beyond these the result is ∞ or 0 anyway; NaN passes.
                    let x = if x[i] > RANGE[1] { RANGE[1] } else { x[i] };
                    let x = if x < RANGE[0] { RANGE[0] } else { x };
                    rounded[i] = x * core::$float::consts::LOG2_E + ROUND;
                    let k = rounded[i] - ROUND;
                    (high[i], low[i]) = (x - k * LN_2[0], k * LN_2[1]);
                }
                for i in 0..N {
                    let r = high[i] - low[i];
                    let t = r * r;
                    c[i] = r - t * polynomial!(t: $($p),*);
                }
                for i in 0..N {
                    let r = high[i] - low[i];
                    x[i] = 1.0 + (high[i] - (low[i] - r * c[i] / (2.0 - c[i])));
                }
                for i in 0..N {
                    // 2^k in two factors: the first product is exact, the second rounds once if it is subnormal.
                    let exponent = rounded[i].to_bits().wrapping_sub(ROUND.to_bits().wrapping_sub(2 * $bias));
                    let half = exponent >> 1;
                    let scale = |biased| $float::from_bits(biased << $mantissa);
                    x[i] = x[i] * scale(half) * scale(exponent.wrapping_sub(half));
                }
            }
        }
    };
}

exp!(
    binary64: f64, 52, 1023, 6_755_399_441_055_744.0, [-746.0, 710.0],
    // The high part has 32 bits: its multiples by k are exact.
    [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10],
    0.166_666_666_666_665_55, -0.002_777_777_777_669_826_5, 6.613_756_250_548_323e-5,
    -1.653_383_754_109_814_7e-6, 4.136_059_524_165_743e-8
);
exp!(
    binary32: f32, 23, 127, 12_582_912.0, [-104.0, 89.0],
    // 12 bits.
    [0.693_115_23, 3.194_618_3e-5],
    0.166_666_18, -0.002_765_991_7
);

#[cfg(test)]
mod tests {
    use crate::functions::Elementary;
    use crate::functions::tests::{ulps, ulps_f32};
    use core::hint::black_box;

    #[test]
    fn f64_to_one_ulp() {
        let mut worst = 0.0_f64;
        for i in 0..2_000_000 {
            let x = -708.0 + f64::from(i) * 7.086_4e-4;
            worst = worst.max(ulps(x.exponential(), libm::exp(x)));
            let small = (f64::from(i) - 1e6) * 1.3e-6;
            worst = worst.max(ulps(small.exponential(), libm::exp(small)));
        }
        assert!(worst <= 1.0, "{worst} ulp");
    }

    #[test]
    fn f32_to_one_ulp() {
        let mut worst = 0.0_f64;
        for i in 0..2_000_000 {
            let x = -87.3 + i as f32 * 8.79e-5;
            worst = worst.max(ulps_f32(x.exponential(), libm::exp(f64::from(x))));
            let small = (i as f32 - 1e6) * 1.3e-6;
            worst = worst.max(ulps_f32(small.exponential(), libm::exp(f64::from(small))));
        }
        assert!(worst <= 1.0, "{worst} ulp");
    }

    #[test]
    fn where_the_result_is_subnormal() {
        for i in 0..10_000 {
            let x = -745.2 + f64::from(i) * 3.7e-3;
            assert!(ulps(x.exponential(), libm::exp(x)) <= 2.0, "{x}");
            let x = -104.0 + i as f32 * 1.67e-3;
            assert!(ulps_f32(x.exponential(), libm::exp(f64::from(x))) <= 2.0, "{x}");
        }
    }

    #[test]
    fn at_the_edges() {
        for (x, right) in [
            (0.0, 1.0),
            (-0.0, 1.0),
            (f64::MIN_POSITIVE, 1.0),
            (5e-324, 1.0),
            (f64::INFINITY, f64::INFINITY),
            (f64::NEG_INFINITY, 0.0),
            (709.782_712_893_384, libm::exp(709.782_712_893_384)),
            (709.782_712_893_385, f64::INFINITY),
            (-745.133_219_101_941_1, 5e-324),
            (-745.133_219_101_941_2, 0.0),
            (f64::MAX, f64::INFINITY),
            (f64::MIN, 0.0),
        ] {
            assert_eq!(black_box(x).exponential(), right, "{x}");
        }
        for (x, right) in [
            (0.0, 1.0),
            (-0.0, 1.0),
            (1e-45, 1.0),
            (f32::INFINITY, f32::INFINITY),
            (f32::NEG_INFINITY, 0.0),
            (88.722_84, f32::INFINITY),
            (-103.98, 0.0),
            (f32::MAX, f32::INFINITY),
            (f32::MIN, 0.0),
        ] {
            assert_eq!(black_box(x).exponential(), right, "{x}");
        }
        assert!(f64::NAN.exponential().is_nan() && f32::NAN.exponential().is_nan());
    }
}
