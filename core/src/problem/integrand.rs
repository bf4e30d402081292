//! The function whose integral is wanted.

use crate::lanes::Lanes;

/// A vector-valued f over points `X`.
///
/// *Implemented by* closures `Fn(&X) -> V` and by whoever has data to carry; *called by*
/// [`Problem`](crate::Problem), once per draw.
///
/// # Laws
/// The same point gives the same value.
pub trait Integrand<X: ?Sized> {
    /// The channels of f.
    type Value: Lanes;
    /// f(x), not divided by a pdf.
    fn value(&self, x: &X) -> Self::Value;
}

impl<X: ?Sized, V: Lanes, F: Fn(&X) -> V> Integrand<X> for F {
    type Value = V;
    #[inline(always)]
    fn value(&self, x: &X) -> V {
        self(x)
    }
}
