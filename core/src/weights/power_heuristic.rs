//! Balance and power heuristic.

use crate::error::Error;
use crate::lanes::{Lanes, PerLane, Scalar};
use crate::planted::planted;
use crate::scaled::Scaled;

/// w_k = (n_k g_k)^β/Σ_j (n_j g_j)^β for n_k draws from each of `K` techniques with the pdfs g_k
/// (Veach, Guibas 1995): β = 1 is the balance heuristic, β = 2 the usual power heuristic.
///
/// Computed as 1/Σ_j (n_j g_j/(n_k g_k))^β is, without its overflow: pdfs count in units of the
/// largest one, so that neither 10⁻³⁰⁰ nor 10³⁰⁰ (10^±30 in `f32`) leaves the range.
///
/// ```
/// use ratiocv_core::{weights::PowerHeuristic, Spectrum};
/// assert_eq!(PowerHeuristic::BALANCE.weights(&[1.0, 3.0], &[1e-300, 1e-300]), [0.25, 0.75]);
/// assert_eq!(PowerHeuristic::SQUARE.weights(&[1.0, 3.0], &[2.0_f32, 2.0]), [0.1, 0.9]);
/// // Techniques whose pdf depends on the channel.
/// let rgb = [Spectrum([1.0_f32, 2.0, 0.0]), Spectrum([1.0, 0.0, 0.0])];
/// let weights = PowerHeuristic::new(1.5)?.weights(&[1.0, 1.0], &rgb);
/// assert_eq!(weights[0], Spectrum([0.5, 1.0, 0.0]));
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerHeuristic {
    exponent: f64,
}

impl PowerHeuristic {
    /// β = 1.
    pub const BALANCE: Self = Self { exponent: 1.0 };
    /// β = 2.
    pub const SQUARE: Self = Self { exponent: 2.0 };

    /// Any exponent β.
    ///
    /// # Errors
    /// [`Error::Exponent`] unless 0 < β < ∞.
    pub fn new(exponent: f64) -> Result<Self, Error> {
        if exponent > 0.0 && exponent.is_finite() { Ok(Self { exponent }) } else { Err(Error::Exponent(exponent)) }
    }

    /// The weight of each technique at a point, per channel: `counts[k]` draws (or the probability) of
    /// technique k, `pdfs[k]` its pdf there.
    ///
    /// They sum to 1, but for rounding. An infinite pdf, a delta, takes all; several share by count.
    /// Where no technique reaches the point all weights are 0, as is that of a technique without
    /// draws. A negative or NaN count or pdf, or an infinite count, makes all weights of its channel NaN.
    pub fn weights<V: Lanes, const K: usize>(&self, counts: &[f64; K], pdfs: &[V; K]) -> [V; K] {
        let pdfs = pdfs.map(V::widen);
        let channels = V::PerLane::<[f64; K]>::from_fn(|i| self.of_channel(counts, &pdfs.map(|pdf| pdf.get(i))));
        core::array::from_fn(|k| V::from_fn(|i| V::Scalar::from_f64(channels.get(i)[k])))
    }

    pub(super) fn of_channel<const K: usize>(&self, counts: &[f64; K], pdfs: &[f64; K]) -> [f64; K] {
        let mut largest = 0.0;
        for (n, g) in counts.iter().zip(pdfs) {
            if !(*n >= 0.0 && n.is_finite() && *g >= 0.0) {
                return [f64::NAN; K];
            }
            if *n > 0.0 && *g > largest {
                largest = *g;
            }
        }
        if largest == 0.0 {
            return [0.0; K];
        }
        let relative = pdfs.map(|g| if g == largest { 1.0 } else { g / largest }); // ∞/∞ among deltas
        let of = |k: usize| planted!("heuristic_counts": counts[k], 1.0);
        let mut terms: [f64; K] =
            core::array::from_fn(|k| if counts[k] == 0.0 { 0.0 } else { self.power(of(k) * relative[k]) });
        let mut sum = terms.iter().fold(0.0, |sum, term| sum + term);
        // Denormal numbers keep few digits, also where they are small beside the sum.
        let is_denormal = |k: usize| relative[k].min(terms[k]) < f64::MIN_POSITIVE;
        let lost = |k: usize| counts[k] > 0.0 && pdfs[k] > 0.0 && is_denormal(k);
        // Enormous or tiny counts, or powers of them: sums of terms that are denormal, or infinite.
        if !(sum >= f64::MIN_POSITIVE / f64::EPSILON && sum.is_finite()) || (largest.is_finite() && (0..K).any(lost)) {
            terms = self.in_units_of_the_largest(counts, pdfs, largest);
            sum = terms.iter().fold(0.0, |sum, term| sum + term);
        }
        terms.map(|term| term / sum)
    }

    /// The terms (n_k g_k)^β in units of the largest, which no exponent takes out of the range.
    #[cold]
    fn in_units_of_the_largest<const K: usize>(&self, counts: &[f64; K], pdfs: &[f64; K], largest: f64) -> [f64; K] {
        let product = |k: usize| match largest.is_finite() {
            _ if counts[k] == 0.0 => Scaled::ZERO, // though its pdf be infinite
            true => Scaled::new(counts[k]) * Scaled::new(pdfs[k]),
            false if pdfs[k] == largest => Scaled::new(counts[k]),
            false => Scaled::ZERO,
        };
        let above = |one: Scaled, other: Scaled| other.is_zero() || (one / other).value() > 1.0;
        let unit = (0..K).map(product).fold(Scaled::ZERO, |unit, one| if above(one, unit) { one } else { unit });
        core::array::from_fn(|k| {
            let share = (product(k) / unit).value();
            if share == 0.0 { 0.0 } else { self.power(share) }
        })
    }

    fn power(&self, x: f64) -> f64 {
        match self.exponent {
            1.0 => x,
            2.0 => planted!("heuristic_square": x * x, x),
            exponent => libm::pow(x, exponent),
        }
    }
}
