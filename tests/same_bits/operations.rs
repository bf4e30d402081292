//! Every operation of `Lanes`, lane by lane.

use crate::hostile::{Bits, numbers};
use num_traits::float::FloatCore;
use ratiocv_core::{Lanes, PerLane, Scalar, Spectrum};
use ratiocv_simd::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};

/// Holds every operation of `V` on hostile numbers, in every pairing, against those of its scalar.
///
/// # Errors
/// What differs first. The bits of a NaN that arithmetic made are no platform's promise; those of one that was moved,
/// chosen or negated are.
pub(crate) fn compare<V: Lanes<Scalar: Bits>>() -> Result<(), String> {
    let numbers = numbers::<V::Scalar>();
    let at = |i: usize| numbers[i % numbers.len()];
    for apart in 0..numbers.len() {
        for start in 0..numbers.len() {
            // Lane i holds another pair than its neighbours, and all come by.
            let (a, b) = (|i: usize| at(start + i), |i: usize| at(start + apart + 2 * i));
            let (x, y) = (V::from_fn(a), V::from_fn(b));
            for i in 0..V::LANES {
                let (a, b) = (a(i), b(i));
                let check = |what: &str, ours: bool| {
                    if ours { Ok(()) } else { Err(format!("{what} of {a:?} and {b:?} in lane {i}")) }
                };
                let exactly = |what: &str, x: V, right: V::Scalar| check(what, x.get(i).bits() == right.bits());
                let same = |what: &str, x: V, right: V::Scalar| {
                    check(what, x.get(i).bits() == right.bits() || (x.get(i).is_nan() && right.is_nan()))
                };
                exactly("from_fn", x, a)?;
                exactly("splat", V::splat(b), b)?;
                exactly("ZERO", V::ZERO, V::Scalar::ZERO)?;
                exactly("ONE", V::ONE, V::Scalar::ONE)?;
                exactly("neg", -x, -a)?;
                same("add", x + y, a + b)?;
                same("sub", x - y, a - b)?;
                same("mul", x * y, a * b)?;
                same("div", x / y, a / b)?;
                let zero = V::Scalar::ZERO;
                for (what, mask, is) in [("lt", x.lt(y), a < b), ("equal", x.equal(y), a == b)] {
                    check(what, (V::select(mask, V::ONE, V::ZERO).get(i) == V::Scalar::ONE) == is)?;
                    exactly("select", V::select(mask, x, y), if is { a } else { b })?;
                    exactly("only", y.only(mask), if is { b } else { zero })?;
                    exactly("except", y.except(mask), if is { zero } else { b })?;
                }
                let wide = Lanes::widen(a);
                let widened = x.widen().get(i);
                check("widen", widened.to_bits() == wide.to_bits() || (widened.is_nan() && wide.is_nan()))?;
                let quotient = V::narrow(x.widen() / y.widen());
                same("narrow", quotient, V::Scalar::from_f64(Lanes::widen(a) / Lanes::widen(b)))?;
                let product = V::narrow(x.widen() * V::Wide::splat(1.0 + f64::EPSILON));
                same("narrow", product, V::Scalar::from_f64(Lanes::widen(a) * (1.0 + f64::EPSILON)))?;
            }
            let is_number = (0..V::LANES).all(|i| !a(i).is_nan());
            let again = V::from_fn(a);
            if (x == again) != is_number {
                return Err("PartialEq of a pack is not that of all its lanes".into());
            }
        }
    }
    let mut order = Vec::new();
    let per_lane = V::PerLane::from_fn(|i| {
        order.push(i);
        i
    });
    let in_order = order.iter().copied().eq(0..V::LANES) && (0..V::LANES).all(|i| per_lane.get(i) == i);
    if in_order { Ok(()) } else { Err("entries per lane are not in lane order".into()) }
}

macro_rules! every_operation {
    ($($name:ident: $($lanes:ty),*;)*) => {$(
        #[test]
        fn $name() {
            $(assert_eq!(compare::<$lanes>(), Ok(()), "{}", stringify!($lanes));)*
        }
    )*};
}

every_operation! {
    operations_of_scalars_and_arrays: f32, f64, Spectrum<f32, 3>, Spectrum<f64, 7>, Spectrum<Spectrum<f32, 8>, 3>;
    operations_of_f32_packs: F32x4, F32x8, F32x16;
    operations_of_f64_packs: F64x2, F64x4, F64x8;
    operations_of_packs_side_by_side: Spectrum<F32x4, 2>, Spectrum<F32x8, 3>, Spectrum<F32x16, 2>, Spectrum<F64x4, 3>;
}
