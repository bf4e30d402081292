//! The grid: a mixture of products of piecewise constant densities.

use crate::adaptive::axis::Axis;
use crate::adaptive::point::{AtPosition, ComponentDensities, GridPoint};
use crate::problem::{Integrand, Problem, Proposal};
use core::array::from_fn;
use rand_core::Rng;

/// A proposal on [0, 1]ᴰ that [learns](Grid::adapt) where an integrand is: `C` components with `B`
/// bins per dimension, drawn with probability 1/C each.
///
/// Component c is g_c(x) = Π_d p_cd(b_d)/w_d(b_d), constant where x_d stays in its bin b_d of width
/// w_d. It learns from the L2 norm over a group of channels: one component from the norm of all
/// (supplement, Lemma 1: the density ∝ ‖f‖₂ has the least total variance), as many as there are
/// channels from each |f_j|. Then [`problem`](Grid::problem) takes the components' own
/// densities for auxiliaries (control variates from the parts of a mixture: Owen and Zhou 2000), and
/// a ratio estimator removes the noise that the mixture costs each channel. Prefer this; a single
/// component for many channels that are alike, such as wavelengths.
///
/// ```
/// use rand_core::SeedableRng;
/// use ratiocv_core::{Grid, RatioOfMeans, Spectrum};
/// // Two peaks that share nothing.
/// let peak = |x: &[f64; 2], c: f64| libm::exp(-200.0 * ((x[0] - c) * (x[0] - c) + (x[1] - c) * (x[1] - c)));
/// let f = |x: &[f64; 2]| Spectrum([peak(x, 0.3), peak(x, 0.7)]);
/// let mut rng = rand_pcg::Pcg64::seed_from_u64(1);
/// let mut grid = Grid::<2, 64, 2>::uniform();
/// grid.adapt(&f, 4, 10_000, &mut rng);
/// let estimate = grid.problem(f).integrate(&RatioOfMeans, 100_000, &mut rng)?;
/// let exact = core::f64::consts::PI / 200.0;
/// assert!((estimate.value[0] / exact - 1.0).abs() < 1e-3); // uniform draws: 0.015
/// assert!((estimate.value[1] - exact).abs() < 5.0 * estimate.std_error[1]);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
///
/// Unlike in VEGAS (Lepage 1978, 2021) bins need not be equally probable, so that their edges can go
/// where the density changes; which leaves several times less noise of a Gaussian peak. Probabilities
/// are whole multiples of 2⁻³², never 0, and sum to 1 exactly. The place in a bin is one of 2³²
/// midpoints: for a smooth integrand far below rounding. No bin is ever narrower than 2⁻⁴⁰.
///
/// `B` is a power of two from 2 to 65536, `D` at most 24 (products of 24 densities stay in range), `C`
/// at most the number of channels to learn from; anything else does not compile:
/// ```compile_fail
/// let grid = ratiocv_core::Grid::<2, 100>::uniform();
/// ```
/// Takes D·B·(24 + 16C) bytes, all on the stack. Densities beyond 10³⁸, of narrow peaks in many
/// dimensions, are infinite in `f32`: give such an integrand `f64` channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<const D: usize, const B: usize, const C: usize = 1> {
    pub(super) axes: [Axis<B, C>; D],
}

impl<const D: usize, const B: usize, const C: usize> Grid<D, B, C> {
    /// Equal bins of equal probability, for every component: the uniform density.
    pub fn uniform() -> Self {
        const { assert!(1 <= D && D <= 24, "a grid has 1 to 24 dimensions") };
        const { assert!(1 <= C, "a grid has at least one component") };
        Self { axes: [Axis::uniform(); D] }
    }

    /// ∫`integrand` over [0, 1]ᴰ with draws from this grid, and its components' densities as the
    /// auxiliary.
    ///
    /// The grid is not changed by it, so that draws are independent given the grid: estimates are as
    /// unbiased as their estimator, with honest error bars, whatever the grid has learned.
    pub fn problem<F: Integrand<[f64; D]>>(
        &self,
        integrand: F,
    ) -> Problem<AtPosition<F>, (ComponentDensities,), &Self, GridPoint<D, C>> {
        Problem::new(AtPosition(integrand)).auxiliary(ComponentDensities).proposal(self)
    }

    /// The components' densities at `x`: 0 outside of [0, 1]ᴰ, and where a coordinate is NaN.
    ///
    /// ```
    /// use ratiocv_core::Grid;
    /// let grid = Grid::<2, 8>::uniform();
    /// assert_eq!(grid.at([0.1, 0.9]).pdf(), 1.0);
    /// assert_eq!(grid.at([0.1, 1.1]).pdf(), 0.0);
    /// ```
    pub fn at(&self, x: [f64; D]) -> GridPoint<D, C> {
        let inside = x.iter().all(|x| (0.0..=1.0).contains(x));
        let bins = from_fn(|d| self.axes[d].bin(x[d]));
        GridPoint { x, densities: if inside { self.densities(&bins) } else { [0.0; C] } }
    }

    /// Where the bins of dimension `dimension` begin, the first at 0; the last one ends at 1. Panics
    /// if there is no such dimension.
    ///
    /// ```
    /// use ratiocv_core::Grid;
    /// assert_eq!(Grid::<2, 4>::uniform().edges(1), &[0.0, 0.25, 0.5, 0.75]);
    /// ```
    pub fn edges(&self, dimension: usize) -> &[f64; B] {
        self.axes[dimension].edges()
    }

    /// A draw and its bins.
    #[inline(always)]
    pub(super) fn draw<R: Rng + ?Sized>(&self, rng: &mut R) -> (GridPoint<D, C>, [usize; D]) {
        let component = if C == 1 { 0 } else { ((u128::from(rng.next_u64()) * C as u128) >> 64) as usize };
        let (mut x, mut bins) = ([0.0; D], [0; D]);
        for ((axis, x), bin) in self.axes.iter().zip(&mut x).zip(&mut bins) {
            (*x, *bin) = axis.sample(component, rng.next_u64());
        }
        (GridPoint { x, densities: self.densities(&bins) }, bins)
    }

    #[inline(always)]
    fn densities(&self, bins: &[usize; D]) -> [f64; C] {
        let mut densities = [1.0; C];
        for (axis, bin) in self.axes.iter().zip(bins) {
            for (density, factor) in densities.iter_mut().zip(axis.densities(*bin)) {
                *density *= factor;
            }
        }
        densities
    }
}

impl<const D: usize, const B: usize, const C: usize> Proposal for Grid<D, B, C> {
    type Point = GridPoint<D, C>;
    #[inline(always)]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> GridPoint<D, C> {
        self.draw(rng).0
    }
    #[inline(always)]
    fn pdf(&self, point: &GridPoint<D, C>) -> f64 {
        point.pdf()
    }
}
