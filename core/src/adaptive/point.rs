//! Draws of a grid, and what may be asked of them.

use crate::lanes::Lanes;
use crate::planted::planted;
use crate::problem::{Auxiliary, Integrand};

/// A point of [0, 1]ᴰ with the densities of a grid's `C` components there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridPoint<const D: usize, const C: usize = 1> {
    /// Where it is.
    pub x: [f64; D],
    /// g_c(x) of each component c.
    pub densities: [f64; C],
}

impl<const D: usize, const C: usize> GridPoint<D, C> {
    /// The density of the mixture, g(x) = Σ_c g_c(x)/C.
    #[inline(always)]
    pub fn pdf(&self) -> f64 {
        planted!("grid_mixture": self.densities.iter().sum::<f64>() / C as f64, self.densities[0])
    }
}

/// The component of `C` that learns from channel `channel` of `channels`: contiguous groups, as even
/// as can be; component j for channel j if there are as many of both.
#[inline(always)]
pub(super) const fn component_of<const C: usize>(channel: usize, channels: usize) -> usize {
    channel * C / channels
}

/// The auxiliary h_j = g_c, the density of the component c that channel j has a part in: H = 1.
///
/// Where f_j resembles g_c, f_j/h_j hardly varies, and a ratio estimator is left with little noise.
/// With one component h/g = 1, and every estimator is plain Monte Carlo.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ComponentDensities;

impl<V: Lanes, const D: usize, const C: usize> Auxiliary<GridPoint<D, C>, V> for ComponentDensities {
    #[inline(always)]
    fn value(&self, point: &GridPoint<D, C>) -> V {
        let group = |channel| planted!("grid_group": component_of::<C>(channel, V::LANES), 0);
        V::narrow(V::Wide::from_fn(|channel| point.densities[group(channel)]))
    }
    fn integral(&self) -> V::Wide {
        V::Wide::ONE
    }
}

/// An integrand of positions, asked at a grid's points.
#[derive(Clone, Copy, Debug)]
pub struct AtPosition<F>(pub F);

impl<F: Integrand<[f64; D]>, const D: usize, const C: usize> Integrand<GridPoint<D, C>> for AtPosition<F> {
    type Value = F::Value;
    #[inline(always)]
    fn value(&self, point: &GridPoint<D, C>) -> F::Value {
        self.0.value(&point.x)
    }
}
