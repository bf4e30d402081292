//! Functions that resemble the integrand and whose integrals are known.

use crate::integrals::Integrals;
use crate::lanes::Lanes;

/// An auxiliary h over points `X`, with its known integral.
///
/// *Implemented by* [`WithIntegral`] and by whoever has data to carry; *called by*
/// [`Problem`](crate::Problem), once per draw.
///
/// # Laws
/// `integral()` is ∫h over the support of the integrand, per channel. Where f ≠ 0, h should not
/// vanish (or be made defensive, see [`Defensive`](crate::Defensive)).
pub trait Auxiliary<X: ?Sized, V: Lanes> {
    /// h(x), not divided by a pdf.
    fn value(&self, x: &X) -> V;
    /// H, per channel.
    fn integral(&self) -> V::Wide;
}

/// A function and its integral.
///
/// ```
/// use ratiocv_core::{Auxiliary, Spectrum, WithIntegral};
/// let h = WithIntegral::new(|x: &f64| Spectrum([*x, 1.0 + x]), Spectrum([0.5, 1.5]));
/// assert_eq!(h.value(&0.25), Spectrum([0.25, 1.25]));
/// assert_eq!(h.integral(), Spectrum([0.5, 1.5]));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct WithIntegral<F, W> {
    function: F,
    integral: W,
}

impl<F, W> WithIntegral<F, W> {
    /// `function` with the integral `integral`.
    pub const fn new(function: F, integral: W) -> Self {
        Self { function, integral }
    }
}

impl<X: ?Sized, V: Lanes, F: Fn(&X) -> V> Auxiliary<X, V> for WithIntegral<F, V::Wide> {
    #[inline(always)]
    fn value(&self, x: &X) -> V {
        (self.function)(x)
    }
    fn integral(&self) -> V::Wide {
        self.integral
    }
}

/// `K` auxiliaries of one problem: one, a tuple of up to three, an array, or `()` for none.
pub trait Auxiliaries<X: ?Sized, V: Lanes, const K: usize> {
    /// The auxiliaries' values.
    fn values(&self, x: &X) -> [V; K];
    /// Their integrals.
    fn integrals(&self) -> Integrals<V, K>;
}

impl<X: ?Sized, V: Lanes> Auxiliaries<X, V, 0> for () {
    fn values(&self, _: &X) -> [V; 0] {
        []
    }
    fn integrals(&self) -> Integrals<V, 0> {
        Integrals::NONE
    }
}

impl<X: ?Sized, V: Lanes, A: Auxiliary<X, V>, const K: usize> Auxiliaries<X, V, K> for [A; K] {
    #[inline(always)]
    fn values(&self, x: &X) -> [V; K] {
        core::array::from_fn(|k| self[k].value(x))
    }
    fn integrals(&self) -> Integrals<V, K> {
        Integrals(core::array::from_fn(|k| self[k].integral()))
    }
}

macro_rules! tuple_of_auxiliaries {
    ($count:literal: $($name:ident $index:tt),*) => {
        impl<X: ?Sized, V: Lanes, $($name: Auxiliary<X, V>),*> Auxiliaries<X, V, $count> for ($($name,)*) {
            #[inline(always)]
            fn values(&self, x: &X) -> [V; $count] {
                [$(self.$index.value(x)),*]
            }
            fn integrals(&self) -> Integrals<V, $count> {
                Integrals([$(self.$index.integral()),*])
            }
        }
    };
}

tuple_of_auxiliaries!(1: A 0);
tuple_of_auxiliaries!(2: A 0, B 1);
tuple_of_auxiliaries!(3: A 0, B 1, C 2);
