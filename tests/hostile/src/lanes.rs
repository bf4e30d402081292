//! Scalar against every lane type.

use crate::bytes::{Bytes, Reach, draws};
use core::fmt::Debug;
use num_traits::float::FloatCore;
use ratiocv_core::moments::{Accumulate, Blocked, ComomentsBlock, Joined, Merge, Moments, RatioOf, UnivariateBlock};
use ratiocv_core::{Draw, Lanes, Scalar, Spectrum};
use ratiocv_simd::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};
use ratiocv_tests::alone::Alone;

/// Every operation on the lanes of every type, and co-moments and ratios of a few: the bits of plain scalars, of
/// any numbers. A NaN is as good as any other.
pub fn lanes(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    match bytes.byte() % 14 {
        0 => operations::<F32x4>(&mut bytes),
        1 => operations::<F32x8>(&mut bytes),
        2 => operations::<F32x16>(&mut bytes),
        3 => operations::<F64x2>(&mut bytes),
        4 => operations::<F64x4>(&mut bytes),
        5 => operations::<F64x8>(&mut bytes),
        6 => operations::<Spectrum<f32, 3>>(&mut bytes),
        7 => operations::<Spectrum<f64, 7>>(&mut bytes),
        8 => operations::<Spectrum<F32x8, 3>>(&mut bytes),
        9 => operations::<Spectrum<Spectrum<f32, 8>, 3>>(&mut bytes),
        10 => accumulators::<Spectrum<f32, 3>, Alone<f32, 3>>(&mut bytes),
        11 => accumulators::<F32x8, Alone<f32, 8>>(&mut bytes),
        12 => accumulators::<F64x4, Alone<f64, 4>>(&mut bytes),
        _ => accumulators::<Spectrum<F32x4, 2>, Alone<f32, 8>>(&mut bytes),
    }
}

fn operations<V: Lanes>(bytes: &mut Bytes<'_>) {
    let numbers = bytes.points::<V::Scalar, 2>(Reach::Any, 64);
    let lane = |entry: usize| {
        let numbers = &numbers;
        move |i: usize| V::Scalar::from_f64(numbers[i % numbers.len()][entry])
    };
    let (x, y) = (V::from_fn(lane(0)), V::from_fn(lane(1)));
    let (sum, difference, product, quotient) = (x + y, x - y, x * y, x / y);
    let (below, equal) = (x.lt(y), x.equal(y));
    let third = V::Wide::splat(1.0 / 3.0);
    for i in 0..V::LANES {
        let (a, b) = (lane(0)(i), lane(1)(i));
        let zero = V::Scalar::ZERO;
        let is = |what: &str, ours: V, right: V::Scalar| {
            let (ours, right) = (ours.get(i), right);
            let same = bits(ours) == bits(right);
            assert!(same, "{what} of {a:?} and {b:?} in lane {i}: {ours:?}, alone {right:?}");
        };
        is("from_fn", x, a);
        is("sum", sum, a + b);
        is("difference", difference, a - b);
        is("product", product, a * b);
        is("quotient", quotient, a / b);
        is("negative", -x, -a);
        is("selection", V::select(below, x, y), if a < b { a } else { b });
        is("equals", V::select(equal, V::ONE, V::ZERO), if a == b { V::Scalar::ONE } else { zero });
        is("what is below", y.only(below), if a < b { b } else { zero });
        is("what is not equal", y.except(equal), if a == b { zero } else { b });
        is("narrowed third", V::narrow(x.widen() * third), V::Scalar::from_f64(Lanes::widen(a) * (1.0 / 3.0)));
    }
}

/// The bits of a number's value, the same for every NaN.
fn bits<S: Scalar>(x: S) -> u64 {
    if FloatCore::is_nan(x) { f64::NAN.to_bits() } else { Lanes::widen(x).to_bits() }
}

type All<V> = Blocked<V, Joined<ComomentsBlock<V>, UnivariateBlock<RatioOf<V>, 1>>>;

/// Accumulators of `V`, and of each channel in plain scalars that are added up in the order for as many channels, `A`.
fn accumulators<V: Lanes, A: Lanes<Scalar = V::Scalar>>(bytes: &mut Bytes<'_>) {
    let split = bytes.below(256);
    let points = bytes.points::<V::Scalar, 2>(Reach::Any, 200);
    let together = words::<V>(&draws(&points), split);
    for channel in 0..V::LANES {
        let mut turned = points.clone();
        turned.rotate_left(7 * channel % points.len());
        let alone = words::<A>(&draws(&turned), split);
        assert_eq!(together(channel), alone(0), "channel {channel}");
    }
}

/// What a channel's moments are, in numbers that read back as the same bits.
fn words<V: Lanes>(draws: &[Draw<V>], split: usize) -> impl Fn(usize) -> String + use<V>
where
    <All<V> as Moments>::Channel: Debug,
{
    let (earlier, later) = draws.split_at(split.min(draws.len()));
    let (mut all, mut rest) = (All::<V>::default(), All::<V>::default());
    all.add_batch(earlier);
    later.iter().for_each(|draw| rest.add(*draw));
    all.merge(&rest);
    let closed = all.closed();
    move |channel| format!("{:?}", closed.channel(channel))
}
