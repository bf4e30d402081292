//! The known integrals of the auxiliaries.

use crate::lanes::Lanes;

/// H_k = ∫h_k for each of `K` auxiliaries, per channel, in `f64`.
///
/// Not checked here: a zero, infinite or NaN integral concerns its own channel alone, where
/// estimators fall back to the plain mean and raise BAD_INTEGRAL.
///
/// ```
/// use ratiocv_core::{Integrals, Spectrum};
/// type Rgb = Spectrum<f32, 3>;
/// let normalised = Integrals::<Rgb>::ONE; // h_j = p_j/p, as in a renderer
/// let given = Integrals::<Rgb>::new([Spectrum([0.5, 1.5, 2.0])]);
/// assert_eq!(normalised.0[0], Spectrum([1.0_f64; 3]));
/// assert_eq!(given.0[0][1], 1.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integrals<V: Lanes, const K: usize = 1>(pub [V::Wide; K]);

impl<V: Lanes, const K: usize> Integrals<V, K> {
    /// Every integral is 1, as for auxiliaries that are densities.
    pub const ONE: Self = Self([V::Wide::ONE; K]);

    /// These integrals.
    pub const fn new(integrals: [V::Wide; K]) -> Self {
        Self(integrals)
    }

    /// The integrals of channel `channel`; panics if there is no such channel.
    pub fn channel(&self, channel: usize) -> [f64; K] {
        core::array::from_fn(|k| self.0[k].get(channel))
    }
}

impl<V: Lanes> Integrals<V, 0> {
    /// No auxiliary at all.
    pub const NONE: Self = Self([]);
}
