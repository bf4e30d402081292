//! One dimension of a grid: bins of [0, 1], and the probability of each for every component.

use crate::adaptive::alias::{Alias, TICKETS, tickets};
use crate::planted::planted;
use core::array::from_fn;

/// `B` bins whose edges all `C` components share; within a bin a component is uniform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis<const B: usize, const C: usize> {
    /// Where each bin begins.
    lower: [f64; B],
    /// The largest number in each bin.
    last: [f64; B],
    width: [f64; B],
    /// Probability over width.
    density: [[f64; C]; B],
    alias: [Alias<B>; C],
}

impl<const B: usize, const C: usize> Axis<B, C> {
    pub(super) fn uniform() -> Self {
        Self::new(from_fn(|bin| bin as f64 / B as f64), &[[1.0; B]; C])
    }

    /// Bins that begin at `lower`, with probabilities in proportion to `weights`.
    fn new(lower: [f64; B], weights: &[[f64; B]; C]) -> Self {
        let upper = |bin: usize| lower.get(bin + 1).copied().unwrap_or(1.0);
        let mut axis = Self {
            lower,
            last: from_fn(|bin| upper(bin).next_down()),
            width: from_fn(|bin| upper(bin) - lower[bin]),
            density: [[0.0; C]; B],
            alias: [Alias::new(&tickets(&[1.0; B])); C],
        };
        for (component, weights) in weights.iter().enumerate() {
            axis.set(component, weights);
        }
        axis
    }

    fn set(&mut self, component: usize, weights: &[f64; B]) {
        let tickets = tickets(weights);
        self.alias[component] = Alias::new(&tickets);
        for (bin, density) in self.density.iter_mut().enumerate() {
            let wide = planted!("axis_density": self.width[bin], 1.0 / B as f64);
            density[component] = f64::from(tickets[bin]) / TICKETS / wide;
        }
    }

    /// Multiplies `component`'s probabilities by `factors`, up to a common factor.
    pub(super) fn reweigh(&mut self, component: usize, factors: &[f64; B]) {
        self.set(component, &from_fn(|bin| self.density[bin][component] * self.width[bin] * factors[bin]));
    }

    /// Moves the edges so that every bin has the same share of ∫g^⅓, g the mean of the components.
    ///
    /// Where f ∝ g, what is left of the variance is Σ∫(g − ḡ)²/g ≈ Σw³g′²/12g over bins of widths w.
    /// It is least for bins of equal ∫(g′²/g)^⅓ (de Boor 1973). We leave out g′, of which little is
    /// known, and keep the power of g. Bins of equal ∫g, those of VEGAS, are too wide in the tails.
    ///
    /// A bin keeps 2⁻³² of the probability, so ∫g^⅓ ≥ 2^(−32/3), and g ≤ 1/w: a new bin is at least
    /// w^⅓·2^(−32/3)/B wide, which for B ≤ 2¹⁶ and w ≥ 2⁻⁴⁰ is 2⁻⁴⁰ again.
    pub(super) fn refine(&mut self) {
        let importance: [f64; B] = from_fn(|bin| {
            let density = self.density[bin].iter().sum::<f64>() / C as f64;
            self.width[bin] * planted!("axis_exponent": libm::cbrt(density), density)
        });
        let share = importance.iter().sum::<f64>() / B as f64;
        let (mut lower, mut weights) = ([0.0; B], [[0.0; B]; C]);
        // The old bin in which the new edge lies, and what is below that bin.
        let (mut old, mut importance_below, mut mass_below) = (0, 0.0, [0.0; C]);
        for bin in 0..B {
            let wanted = share * bin as f64;
            while importance_below + importance[old] <= wanted && old + 1 < B {
                importance_below += importance[old];
                for (mass, density) in mass_below.iter_mut().zip(self.density[old]) {
                    *mass += density * self.width[old];
                }
                old += 1;
            }
            let step = self.width[old] * ((wanted - importance_below) / importance[old]);
            lower[bin] = self.lower[old] + step;
            for (component, weights) in weights.iter_mut().enumerate() {
                let mass = mass_below[component] + self.density[old][component] * step;
                // A bin has what lies below the next one and not below it.
                weights[bin] = 1.0 - mass;
                if bin > 0 {
                    weights[bin - 1] -= weights[bin];
                }
            }
        }
        *self = Self::new(lower, &weights);
    }

    /// A position of `component` and its bin: half of the bits choose the bin, half the place in it.
    #[inline(always)]
    pub(super) fn sample(&self, component: usize, bits: u64) -> (f64, usize) {
        let bin = self.alias[component].bin((bits >> 32) as u32);
        let place = (f64::from(bits as u32) + 0.5) / TICKETS;
        let x = self.lower[bin] + self.width[bin] * place;
        // Rounding must not carry it to the next bin, nor to 1.
        (if x > self.last[bin] { self.last[bin] } else { x }, bin)
    }

    /// The bin of `x`; the first below 0, the last from 1 on.
    pub(super) fn bin(&self, x: f64) -> usize {
        self.lower.partition_point(|lower| *lower <= x).saturating_sub(1)
    }

    /// The components' densities in `bin`.
    #[inline(always)]
    pub(super) fn densities(&self, bin: usize) -> &[f64; C] {
        &self.density[bin]
    }

    /// Where each bin begins.
    pub(super) fn edges(&self) -> &[f64; B] {
        &self.lower
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Probabilities 1/2, 1/4, 1/8 and 1/8 of quarters, less the tickets that no bin goes without.
    fn stairs() -> Axis<4, 1> {
        let mut axis = Axis::uniform();
        axis.reweigh(0, &[4.0, 2.0, 1.0, 1.0]);
        axis
    }

    #[test]
    fn densities_are_probability_over_width() {
        let axis = stairs();
        for (bin, density) in [2.0, 1.0, 0.5, 0.5].into_iter().enumerate() {
            assert!((axis.densities(bin)[0] - density).abs() <= 1e-8);
        }
        assert_eq!((0..4).map(|bin| axis.densities(bin)[0] * 0.25).sum::<f64>(), 1.0);
    }

    #[test]
    fn refined_bins_share_the_cube_root_of_the_density_alike() {
        let (old, mut new) = (stairs(), stairs());
        new.refine();
        // ∫g^⅓ over each new bin, of the old g.
        let below = |x: f64| {
            (0..4)
                .map(|bin| ((x - 0.25 * bin as f64).clamp(0.0, 0.25)) * libm::cbrt(old.densities(bin)[0]))
                .sum::<f64>()
        };
        for bin in 0..4 {
            let upper = new.edges().get(bin + 1).copied().unwrap_or(1.0);
            let share = below(upper) - below(new.edges()[bin]);
            assert!((share - below(1.0) / 4.0).abs() <= 1e-15, "{bin}: {share}");
        }
    }

    #[test]
    fn refinement_keeps_the_distribution_at_the_new_edges() {
        let (old, mut new) = (stairs(), stairs());
        new.refine();
        let below = |axis: &Axis<4, 1>, x: f64| {
            let upper = |bin: usize| axis.edges().get(bin + 1).copied().unwrap_or(1.0);
            (0..4).map(|bin| (x.min(upper(bin)) - axis.edges()[bin]).max(0.0) * axis.densities(bin)[0]).sum::<f64>()
        };
        for edge in *new.edges() {
            // Four tickets' worth.
            assert!((below(&old, edge) - below(&new, edge)).abs() <= 1e-9, "{edge}");
        }
    }

    #[test]
    fn however_often_it_is_refined_no_bin_is_narrower_than_the_documented_width() {
        let mut axis = Axis::<256, 1>::uniform();
        let mut narrowest = 1.0;
        for _ in 0..100 {
            // All probability in the bin at 0.3, however narrow.
            let spot = axis.bin(0.3);
            axis.reweigh(0, &from_fn(|bin| f64::from(u8::from(bin == spot))));
            axis.refine();
            narrowest = axis.width.iter().fold(narrowest, |least: f64, width| least.min(*width));
        }
        assert!(narrowest >= libm::exp2(-40.0) && narrowest <= 1e-7, "{narrowest:e}");
    }
}
