//! Sums of squares at the edges of the exponent range.

use crate::lanes::Lanes;
use num_traits::float::FloatCore;

/// Where squares of `V`'s scalars have lost their precision to underflow: `MIN_POSITIVE / EPSILON`.
pub(crate) fn smallest_square<V: Lanes>() -> V::Wide {
    let scalar = V::Scalar::min_positive_value() / <V::Scalar as FloatCore>::epsilon();
    V::Wide::splat(scalar.widen())
}

/// `sum` of squares, or NaN ("unknown") where it is so small, yet not of zeros alone, that underflow
/// may have eaten it. `deviation` is any sum that is 0 if all the deviations are.
#[inline(always)]
pub(crate) fn unless_underflowed<W: Lanes<Scalar = f64>>(sum: W, scale: W, deviation: W, smallest: W) -> W {
    let unknown = W::select(W::equal(deviation, W::ZERO), sum, W::splat(f64::NAN));
    W::select(scale.lt(smallest), unknown, sum)
}

/// `x` without its sign. What should be a sum of squares but came out of a subtraction is rounding
/// noise when negative; its size, not 0, is what is known.
#[inline(always)]
pub(crate) fn magnitude<W: Lanes>(x: W) -> W {
    W::select(x.lt(W::ZERO), -x, x)
}
