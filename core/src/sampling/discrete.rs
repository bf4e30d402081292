//! One of several things, with given probabilities.

use crate::error::Error;
use crate::lanes::Lanes;
use crate::planted::planted;
use crate::problem::{Proposal, unit_interval};
use crate::sampling::{l2_norm, table};
use rand_core::Rng;

/// What a [`unit_interval`] number can tell apart, as parts of 1.
pub(super) const PARTS: f64 = (1_u64 << 53) as f64;

/// An index below `B`, chosen with a probability proportional to its weight: a light, a channel, a
/// bin. As a [`Proposal`] its measure is the count, so that a [`Problem`](crate::Problem) is a sum.
///
/// The probabilities are multiples of 2⁻⁵³ and those of what [`sample`](Proposal::sample) does, to
/// the bit, so that f/pdf is unbiased however small a weight: an index of weight 0 has probability 0,
/// a positive weight has at least 2⁻⁵³, and all of them add up to exactly 1. An index that is not
/// there has probability 0. A choice takes one random number and log₂ `B` comparisons.
///
/// Lights of different colours are best chosen by the L2 norm of what they send (supplement, Lemma 1):
/// for three of them, red, green and blue, the total variance is 2.8 times less than by luminance
/// (`tests/importance_sampling/lemmas.rs`).
///
/// ```
/// use ratiocv_core::{sampling::Discrete, Proposal, Spectrum};
/// let lights = [Spectrum([10.0_f32, 0.0, 0.0]), Spectrum([0.0, 15.0, 20.0]), Spectrum([0.0, 3.0, 4.0])];
/// let choice = Discrete::by_norm(&lights)?;
/// assert_eq!([0, 1, 2, 3].map(|light| choice.pdf(&light)), [0.25, 0.625, 0.125, 0.0]);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Discrete<const B: usize> {
    /// The probability of an index up to and including this one.
    cumulative: [f64; B],
}

impl<const B: usize> Discrete<B> {
    /// With probabilities proportional to `weights`.
    ///
    /// # Errors
    /// [`Error::TableEntry`] for a weight that is negative, infinite or NaN,
    /// [`Error::TableOfZeros`] if none is positive.
    pub fn new(weights: &[f64; B]) -> Result<Self, Error> {
        let mut sum = 0.0;
        let sums = table::scaled(weights)?.map(|weight| {
            sum += weight;
            sum
        });
        let mut cumulative = sums.map(|partial| libm::round(partial / sum * PARTS));
        // At least one part for every positive weight, none for the others, PARTS in all.
        let mut least = 0.0;
        for (edge, weight) in cumulative.iter_mut().zip(weights) {
            let next = least + f64::from(u8::from(*weight > 0.0));
            least = if *weight > 0.0 && *edge > next { *edge } else { next };
            *edge = least;
        }
        let mut most = PARTS;
        for (edge, weight) in cumulative.iter_mut().zip(weights).rev() {
            *edge = if *edge < most { *edge } else { most };
            most = *edge - f64::from(u8::from(*weight > 0.0));
            *edge /= PARTS;
        }
        Ok(Self { cumulative })
    }

    /// With probabilities proportional to the L2 norm of `values` over their channels.
    ///
    /// # Errors
    /// As [`new`](Self::new), for the norms.
    pub fn by_norm<V: Lanes>(values: &[V; B]) -> Result<Self, Error> {
        Self::new(&values.map(l2_norm))
    }
}

impl<const B: usize> Proposal for Discrete<B> {
    type Point = usize;
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> usize {
        let u = unit_interval(rng);
        self.cumulative.partition_point(|edge| planted!("choice_edge": *edge <= u, *edge < u))
    }
    #[inline]
    fn pdf(&self, index: &usize) -> f64 {
        let at = |index: usize| self.cumulative.get(index).copied().unwrap_or(1.0);
        // Exact: both are multiples of 2⁻⁵³ up to 1.
        at(*index) - index.checked_sub(1).map_or(0.0, at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn probabilities<const B: usize>(weights: [f64; B]) -> [f64; B] {
        let choice = Discrete::new(&weights).unwrap();
        core::array::from_fn(|index| choice.pdf(&index))
    }

    #[test]
    fn probabilities_are_the_shares_of_the_weights() {
        assert_eq!(probabilities([1.0, 0.0, 2.0, 5.0]), [0.125, 0.0, 0.25, 0.625]);
        assert_eq!(probabilities([7.0]), [1.0]);
        assert_eq!(probabilities([0.0, -0.0, 3.0, 0.0]), [0.0, 0.0, 1.0, 0.0]);
        assert_eq!(probabilities([f64::MAX, f64::MAX]), [0.5, 0.5]);
        assert_eq!(probabilities([5e-324, 1.5e-323]), [0.25, 0.75]);
    }

    #[test]
    fn positive_weights_are_never_starved_and_probabilities_sum_to_one() {
        let part = 1.0 / PARTS;
        assert_eq!(probabilities([1e-300, 1.0, 1e-300, 0.0, 1e-300]), [part, 1.0 - 3.0 * part, part, 0.0, part]);
        let mut weights = [0.0; 999];
        for (i, weight) in weights.iter_mut().enumerate() {
            *weight = libm::exp((i * 7919 % 999) as f64 - 700.0) * f64::from(u8::from(i % 5 > 0));
        }
        let all = probabilities(weights);
        assert_eq!(all.iter().sum::<f64>(), 1.0); // exact: multiples of 2⁻⁵³ up to 1
        assert!(all.iter().zip(weights).all(|(p, weight)| (*p > 0.0) == (weight > 0.0)));
    }

    #[test]
    fn bad_tables_name_the_entry() {
        let error = |weights: [f64; 3]| Discrete::new(&weights).unwrap_err();
        assert_eq!(error([0.0, 0.0, -0.0]), Error::TableOfZeros { what: "weight" });
        assert_eq!(error([1.0, -2.0, 3.0]), Error::TableEntry { what: "weight", index: 1, value: -2.0 });
        assert_eq!(
            error([1.0, 2.0, f64::INFINITY]),
            Error::TableEntry { what: "weight", index: 2, value: f64::INFINITY }
        );
        assert!(matches!(error([f64::NAN, 2.0, 1.0]), Error::TableEntry { index: 0, .. }));
        assert_eq!(Discrete::<0>::new(&[]).unwrap_err(), Error::TableOfZeros { what: "weight" });
        let message = std::string::ToString::to_string(&error([1.0, -2.0, 3.0]));
        assert_eq!(message, "weight 1 is -2: give a finite number that is not negative");
    }
}
