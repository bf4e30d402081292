//! Truth values, one per lane.

use core::fmt;
use ratiocv_core::Lanes;

/// One truth value per lane of the pack `P`: what its comparisons give and its selections take.
///
/// Held as `wide` does, as a pack whose lanes have all bits set or none.
///
/// ```
/// use ratiocv_core::Lanes;
/// use ratiocv_simd::F32x4;
/// let x = F32x4::new([1.0, -2.0, f32::NAN, 4.0]);
/// let negative = x.lt(F32x4::ZERO);
/// assert_eq!([0, 1, 2, 3].map(|lane| negative.get(lane)), [false, true, false, false]);
/// assert_eq!(F32x4::ONE.except(negative).to_array(), [1.0, 0.0, 1.0, 1.0]);
/// ```
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct Mask<P>(pub(crate) P);

impl<P: Lanes<Mask = Self>> Mask<P> {
    /// Whether lane `lane` is set; panics if there is no such lane.
    pub fn get(self, lane: usize) -> bool {
        P::ONE.only(self).get(lane) == P::Scalar::ONE
    }
}

impl<P: Lanes<Mask = Self>> fmt::Debug for Mask<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries((0..P::LANES).map(|lane| self.get(lane))).finish()
    }
}
