//! How many draws each stratum gets.

use crate::error::Error;
use crate::planted::planted;
use crate::sampling::table;
use core::cmp::Ordering;

/// Splits `draws` over strata in proportion to `weights`: whole numbers, at least 1, that add up to
/// `draws` exactly.
///
/// A quota is `draws`·w_k/Σw, rounded down, but not below 1. What is then left over goes one by one to
/// the stratum with the largest remainder, quota − N_k; what is missing is taken from that with the
/// smallest, of those above 1. The first of equals comes first. The variance Σ_k V_k/N_k of strata
/// whose single draws have variance V_k is least at w_k = √V_k (Neyman 1934), or √(V_k/c_k) if a draw
/// of stratum k costs c_k.
///
/// ```
/// use ratiocv_core::sampling::allocate;
/// assert_eq!(allocate(10, &[4.5, 2.5, 3.0])?, [5, 2, 3]);
/// assert_eq!(allocate(10, &[9.0, 0.5, 0.5, 0.0])?, [7, 1, 1, 1]);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
///
/// # Errors
/// [`Error::TableEntry`] for a weight that is negative, infinite or NaN, [`Error::TableOfZeros`] if
/// none is positive, [`Error::TooFewForStrata`] if there are fewer draws than strata.
pub fn allocate<const K: usize>(draws: u64, weights: &[f64; K]) -> Result<[u64; K], Error> {
    let weights = table::scaled(weights)?;
    if draws < K as u64 {
        return Err(Error::TooFewForStrata { draws, strata: K });
    }
    let sum: f64 = weights.iter().sum();
    let quotas = weights.map(|weight| draws as f64 * (weight / sum));
    let mut counts = quotas.map(|quota| (quota as u64).max(1));
    loop {
        let given: u128 = counts.iter().map(|count| u128::from(*count)).sum();
        let remainder = |k: usize| quotas[k] - counts[k] as f64;
        match given.cmp(&u128::from(draws)) {
            Ordering::Equal => return Ok(counts),
            Ordering::Less => {
                let larger = |k, best| planted!("largest_remainder": remainder(k) > remainder(best), true);
                let taker = (0..K).fold(0, |best, k| if larger(k, best) { k } else { best });
                counts[taker] += 1;
            }
            Ordering::Greater => {
                // There is one above 1: the counts add up to more than `draws` ≥ K.
                let smaller = |k: usize, best: usize| counts[best] <= 1 || remainder(k) < remainder(best);
                let giver =
                    (0..K).filter(|k| counts[*k] > 1).fold(0, |best, k| if smaller(k, best) { k } else { best });
                counts[giver] -= 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_quotas_are_kept_and_ties_go_to_the_first() {
        assert_eq!(allocate(16, &[1.0, 2.0, 5.0]), Ok([2, 4, 10]));
        assert_eq!(allocate(8, &[1.0, 1.0, 1.0]), Ok([3, 3, 2]));
        assert_eq!(allocate(100, &[0.1, 0.2, 0.7]), Ok([10, 20, 70]));
        assert_eq!(allocate(1, &[3.0]), Ok([1]));
        // Quotas of 0.06, 2.97 and 2.97: one is left over; of 0.10, four times, and 3.81, twice: two are missing.
        assert_eq!(allocate(6, &[0.1, 5.0, 5.0]), Ok([1, 3, 2]));
        assert_eq!(allocate(8, &[0.1, 4.0, 0.1, 0.1, 4.0, 0.1]), Ok([1, 2, 1, 1, 2, 1]));
        assert_eq!(allocate(3, &[1.0, 0.0, 1e-300]), Ok([1, 1, 1]));
        assert_eq!(allocate(10, &[6.0, 3.6, 0.1, 0.1, 0.1, 0.1]), Ok([4, 2, 1, 1, 1, 1]));
    }

    #[test]
    fn counts_add_up_exactly_and_stay_within_one_of_the_quota() {
        for seed in 1..2000_u64 {
            let weight = |k: u64| ((seed * 7919 + k * 104_729) % 1009 + 1) as f64;
            let weights: [f64; 7] = core::array::from_fn(|k| weight(k as u64));
            let draws = 7000 + seed * 31;
            let counts = allocate(draws, &weights).unwrap();
            assert_eq!(counts.iter().sum::<u64>(), draws);
            for (count, weight) in counts.iter().zip(weights) {
                let quota = draws as f64 * weight / weights.iter().sum::<f64>();
                assert!((*count as f64 - quota).abs() < 1.0 || *count == 1, "{count} for {quota}");
            }
        }
        let counts = allocate(u64::MAX, &[1.0, 1.0, 1.0, f64::MAX, f64::MAX]).unwrap();
        assert_eq!(counts.iter().map(|count| u128::from(*count)).sum::<u128>(), u128::from(u64::MAX));
    }

    #[test]
    fn errors_name_what_is_wrong() {
        assert_eq!(allocate(2, &[1.0; 3]), Err(Error::TooFewForStrata { draws: 2, strata: 3 }));
        assert_eq!(allocate(2, &[0.0; 2]), Err(Error::TableOfZeros { what: "weight" }));
        assert!(matches!(allocate(2, &[1.0, f64::NAN]), Err(Error::TableEntry { what: "weight", index: 1, .. })));
    }
}
