//! A density made from a table.

use crate::error::Error;
use crate::lanes::Lanes;
use crate::planted::planted;
use crate::problem::{Proposal, unit_interval};
use crate::sampling::Discrete;
use rand_core::Rng;

/// A density on \[0, 1), constant on each of `B` bins of equal width: p_i·`B` on bin i, where p_i is
/// the probability that a [`Discrete`] gives it.
///
/// A point takes two random numbers. The density of a bin of weight 0 is 0, and so it is outside
/// \[0, 1) and at NaN. An integrand that is not 0 in such a bin would be missed there: add a hundredth
/// of the mean weight to every weight unless the table is exact.
///
/// ```
/// use rand_core::SeedableRng;
/// use ratiocv_core::{sampling::PiecewiseConstant, Plain, Problem, Spectrum};
/// // Least total variance of two channels: by the L2 norm of their values in the middle of each bin.
/// let f = |x: &f64| Spectrum([6.0 * x * x, 1.0 - x]);
/// let values: [_; 64] = core::array::from_fn(|i| f(&((i as f64 + 0.5) / 64.0)));
/// let problem = Problem::new(f).proposal(PiecewiseConstant::by_norm(&values)?);
/// let estimate = problem.integrate(&Plain, 1000, &mut rand_pcg::Pcg64::seed_from_u64(1))?;
/// assert!((estimate.value[0] - 2.0).abs() < 5.0 * estimate.std_error[0]);
/// assert!((estimate.value[1] - 0.5).abs() < 5.0 * estimate.std_error[1]);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PiecewiseConstant<const B: usize> {
    bins: Discrete<B>,
}

impl<const B: usize> PiecewiseConstant<B> {
    /// Proportional to `weights[i]` on \[i/`B`, (i+1)/`B`).
    ///
    /// # Errors
    /// As [`Discrete::new`].
    pub fn new(weights: &[f64; B]) -> Result<Self, Error> {
        Ok(Self { bins: Discrete::new(weights)? })
    }

    /// Proportional to the L2 norm over channels of `values[i]` on \[i/`B`, (i+1)/`B`): the optimum of
    /// vector-valued importance sampling (supplement, Lemma 1) for an integrand with these values.
    ///
    /// # Errors
    /// As [`Discrete::new`], for the norms.
    pub fn by_norm<V: Lanes>(values: &[V; B]) -> Result<Self, Error> {
        Ok(Self { bins: Discrete::by_norm(values)? })
    }

    /// The bin of `x`, which is in \[0, 1): the last whose edge i/`B`, rounded, does not exceed it.
    fn bin(x: f64) -> usize {
        let (bins, near) = (B as f64, libm::floor(x * B as f64));
        // The product is rounded, and may be off by one bin.
        let bin = if x < near / bins {
            near - 1.0
        } else if x >= (near + 1.0) / bins {
            near + 1.0
        } else {
            near
        };
        bin as usize
    }
}

impl<const B: usize> Proposal for PiecewiseConstant<B> {
    type Point = f64;
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> f64 {
        let (bin, bins) = (self.bins.sample(rng) as f64, B as f64);
        let (x, end) = ((bin + unit_interval(rng)) / bins, (bin + 1.0) / bins);
        // Rounding must not carry it into the next bin, whose density is another.
        if x < end { x } else { planted!("bin_end": end.next_down(), x) }
    }
    #[inline]
    fn pdf(&self, x: &f64) -> f64 {
        if !(0.0..1.0).contains(x) {
            return 0.0;
        }
        planted!("bin_width": B as f64, 1.0) * self.bins.pdf(&Self::bin(*x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bin_begins_at_its_edge_and_ends_before_the_next() {
        fn check<const B: usize>() {
            for bin in 0..B {
                let edge = |i: usize| i as f64 / B as f64;
                assert_eq!(PiecewiseConstant::<B>::bin(edge(bin)), bin, "{B}");
                assert_eq!(PiecewiseConstant::<B>::bin(edge(bin + 1).next_down()), bin, "{B}");
            }
        }
        check::<1>();
        check::<3>();
        check::<49>(); // 1/49·49 < 1
        check::<1000>();
        check::<4099>();
    }

    #[test]
    fn the_density_is_the_table_and_nothing_elsewhere() {
        let density = PiecewiseConstant::new(&[1.0, 0.0, 2.0, 5.0]).unwrap();
        let at = |x: f64| density.pdf(&x);
        assert_eq!([at(0.0), at(0.24), at(0.25), at(0.6), at(0.75), at(0.999)], [0.5, 0.5, 0.0, 1.0, 2.5, 2.5]);
        assert_eq!([at(-0.01), at(1.0), at(f64::NAN), at(f64::INFINITY)], [0.0; 4]);
        assert_eq!(at(-0.0), 0.5);
    }
}
