//! ln x.

/// n/d = 2^k·m with m in [⅔, 1½], and ln m = 2 artanh s with s = (m − 1)/(m + 1) = (n − 2^k d)/(n + 2^k d):
/// the quotient itself is never formed.
///
/// The bits of a floating-point number, as an integer, are its logarithm to base 2, interpolated between
/// powers (Mitchell 1962): the difference of two, rounded, is k. 2 artanh s = 2s + s·s²P(s²), |s| ≤ ⅕, with the
/// minimax coefficients of the relative error: 1.5·10⁻¹⁷ and 2.8·10⁻⁹.
macro_rules! ln {
    ($name:ident: $float:ident, $mantissa:literal, $offset:literal, $integer:expr, $up:expr, $ln2:expr, $($p:literal),*) => {
        pub(super) mod $name {
            use crate::functions::polynomial;

            const LN_2: [$float; 2] = $ln2;

            #[inline(always)]
            pub(in crate::functions) fn ln_ratio<const N: usize>(n: &mut [$float; N], d: &[$float; N]) {
                let mut k = [0.0; N];
                for i in 0..N {
                    (k[i], n[i]) = reduced(n[i], d[i]);
                }
                for i in 0..N {
                    n[i] = ln_of(k[i], n[i]);
                }
            }

            #[inline(always)]
            pub(in crate::functions) fn ln<const N: usize>(x: &mut [$float; N]) {
                // Subnormal numbers by way of a larger one.
                const UP: $float = $up;
                let (mut k, mut s) = ([0.0; N], [0.0; N]);
                for i in 0..N {
                    let subnormal = x[i] < $float::MIN_POSITIVE;
                    let (scale, up) = if subnormal { ((1_u64 << UP as u32) as $float, UP) } else { (1.0, 0.0) };
                    (k[i], s[i]) = reduced(x[i] * scale, 1.0);
                    k[i] -= up;
                }
                for i in 0..N {
                    let ln = if x[i] == $float::INFINITY { x[i] } else { ln_of(k[i], s[i]) };
                    let ln = if x[i] == 0.0 { $float::NEG_INFINITY } else { ln };
                    x[i] = if x[i] >= 0.0 { ln } else { $float::NAN };
                }
            }

            /// k and s.
            #[inline(always)]
            fn reduced(n: $float, d: $float) -> ($float, $float) {
                // Kept positive by an offset, so that a shift is a division.
                const OFFSET: u64 = $offset << $mantissa;
                const INTEGER: $float = $integer;
                let difference = n.to_bits().wrapping_sub(d.to_bits());
                let rounded = difference.wrapping_add((OFFSET + (1 << ($mantissa - 1))) as _) >> $mantissa;
                // Or-ed into the last bits of a number whose last bit is worth 1.
                let k = $float::from_bits(rounded | INTEGER.to_bits()) - (INTEGER + $offset as $float);
                let n = $float::from_bits(n.to_bits().wrapping_sub((rounded << $mantissa).wrapping_sub(OFFSET as _)));
                (k, (n - d) / (n + d))
            }

            /// k ln 2 + 2 artanh s, the smallest parts first.
            #[inline(always)]
            fn ln_of(k: $float, s: $float) -> $float {
                let t = s * s;
                k * LN_2[0] + ((s + s) + (s * (t * polynomial!(t: $($p),*)) + k * LN_2[1]))
            }
        }
    };
}

ln!(
    binary64: f64, 52, 1024, 4_503_599_627_370_496.0, 54.0,
    [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10],
    0.666_666_666_666_728_2, 0.399_999_999_961_022_15, 0.285_714_294_059_543_5,
    0.222_221_376_308_252_95, 0.181_863_917_214_579_92, 0.152_494_753_878_037_01,
    0.153_737_369_570_126_82
);
ln!(
    binary32: f32, 23, 128, 8_388_608.0, 25.0,
    [0.693_115_23, 3.194_618_3e-5],
    0.666_669_5, 0.399_576_07, 0.303_652_5
);

#[cfg(test)]
mod tests {
    use crate::functions::Elementary;
    use crate::functions::tests::{ulps, ulps_f32};
    use core::hint::black_box;

    #[test]
    fn f64_to_two_ulp() {
        let mut worst = 0.0_f64;
        for i in 0..2_000_000_u64 {
            // All exponents, and the neighbourhood of 1.
            let x = f64::from_bits((1 << 52) + i * (0x7fdf_ffff_ffff_ffff / 2_000_000));
            let near = 0.4 + i as f64 * 1e-6;
            for x in [x, near] {
                worst = worst.max(ulps(x.logarithm(), libm::log(x)));
            }
        }
        assert!(worst <= 2.0, "{worst} ulp");
    }

    #[test]
    fn f32_to_two_ulp() {
        let mut worst = 0.0_f64;
        for i in 0..2_000_000_u32 {
            let x = f32::from_bits((1 << 23) + i * (0x7effffff / 2_000_000));
            let near = 0.4 + i as f32 * 1e-6;
            for x in [x, near] {
                worst = worst.max(ulps_f32(x.logarithm(), libm::log(f64::from(x))));
            }
        }
        assert!(worst <= 2.0, "{worst} ulp");
    }

    fn ratio<T: Elementary>(n: T, d: T) -> T {
        let mut n = [n];
        T::logarithms_of_ratios(&mut n, &[d]);
        n[0]
    }

    #[test]
    fn of_a_ratio() {
        let mut worst = [0.0_f64; 2];
        for i in 0..1000 {
            for j in 0..1000 {
                // 24 bits each: the product of two is exact in f64, and so is the quotient n/d.
                let (x, d) = (1e-3 + i as f32 * 0.007_13, 1e-4 + j as f32 * 0.0193);
                let n = f64::from(x) * f64::from(d);
                worst[0] = worst[0].max(ulps(ratio(n, f64::from(d)), libm::log(f64::from(x))));
                worst[1] = worst[1].max(ulps_f32(ratio(x, d), libm::log(f64::from(x) / f64::from(d))));
            }
        }
        assert!(worst[0] <= 2.0 && worst[1] <= 2.0, "{worst:?} ulp");
    }

    #[test]
    fn at_the_edges() {
        for (x, right) in [
            (1.0, 0.0),
            (0.0, f64::NEG_INFINITY),
            (-0.0, f64::NEG_INFINITY),
            (f64::INFINITY, f64::INFINITY),
            (f64::MAX, libm::log(f64::MAX)),
            (f64::MIN_POSITIVE, libm::log(f64::MIN_POSITIVE)),
            (5e-324, libm::log(5e-324)),
            (1e-310, libm::log(1e-310)),
        ] {
            assert_eq!(black_box(x).logarithm(), right, "{x}");
        }
        for (x, right) in [
            (1.0, 0.0),
            (0.0, f32::NEG_INFINITY),
            (-0.0, f32::NEG_INFINITY),
            (f32::INFINITY, f32::INFINITY),
            (f32::MAX, libm::logf(f32::MAX)),
            (1e-45, libm::logf(1e-45)),
        ] {
            assert_eq!(black_box(x).logarithm(), right, "{x}");
        }
        for x in [f64::NAN, -1.0, -5e-324, f64::NEG_INFINITY] {
            assert!(x.logarithm().is_nan() && (x as f32 - 1.0).logarithm().is_nan(), "{x}");
        }
    }
}
