//! Draws that teach the optimal weights.

use crate::error::Error;
use crate::flags::Flags;
use crate::lanes::{Lanes, PerLane};
use crate::moments::Merge;
use crate::planted::planted;
use crate::solve::{Solution, solve};
use crate::weights::optimal_weights::{OptimalWeights, Techniques};

/// The integrals that [`OptimalWeights`] are made of: of products, over the mixture pdf
/// q = Σν_j g_j, of f, of the auxiliaries h_k and of the ν_k g_k, for `K` techniques that get the
/// shares ν_k of the draws.
///
/// They are sums over a pilot of draws from the mixture, or over the cells of a quadrature. Keep the
/// draws of the estimate apart from those of the pilot: then weights are constants to them. Two pilots
/// merge; an empty one is the identity.
///
/// ```
/// use ratiocv_core::weights::Pilot;
/// // f = 3x² on [0, 1), known at the middles of ten cells; g₁ = h₁ = 1, g₂ = h₂ = 2x.
/// let mut pilot = Pilot::<f64, 2>::new([100.0, 100.0])?;
/// for i in 0..10 {
///     let x = (f64::from(i) + 0.5) / 10.0;
///     pilot.add_cell(0.1, 3.0 * x * x, [1.0, 2.0 * x], [1.0, 2.0 * x]);
/// }
/// let weights = pilot.optimal();
/// let parts = weights.parts(0.75, [1.0, 1.0], [1.0, 1.0]); // at x = ½
/// assert!((parts[0] + parts[1] - 0.75_f64).abs() < 1e-15);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Pilot<V: Lanes, const K: usize> {
    techniques: Techniques<K>,
    bb: [[f64; K]; K],
    bh: [[V::Wide; K]; K],
    hh: [[V::Wide; K]; K],
    bf: [V::Wide; K],
    hf: [V::Wide; K],
}

impl<V: Lanes, const K: usize> Pilot<V, K> {
    /// An empty pilot for `counts[k]` draws of technique k; only their proportions matter.
    ///
    /// # Errors
    /// [`Error::Counts`] unless all are finite, none is negative and one is positive.
    pub fn new(counts: [f64; K]) -> Result<Self, Error> {
        let zero = [V::Wide::ZERO; K];
        let techniques = Techniques::new(counts)?;
        Ok(Self { techniques, bb: [[0.0; K]; K], bh: [zero; K], hh: [zero; K], bf: zero, hf: zero })
    }

    /// Adds a draw X from the mixture, each technique chosen in proportion to its count or by fixed
    /// counts: f(X), h_k(X) and g_k(X), not divided by anything.
    ///
    /// A point that no technique reaches is no draw and is passed over. A number that is not finite
    /// makes its channel's weights those of the balance heuristic, a bad pdf those of all channels.
    pub fn add(&mut self, f: V, h: [V; K], pdfs: [f64; K]) {
        self.add_weighted(f, h, pdfs, |_| 1.0);
    }

    /// Adds a cell of a quadrature: its volume, and the functions in it.
    pub fn add_cell(&mut self, volume: f64, f: V, h: [V; K], pdfs: [f64; K]) {
        self.add_weighted(f, h, pdfs, |mixture| volume * mixture);
    }

    fn add_weighted(&mut self, f: V, h: [V; K], pdfs: [f64; K], weight: impl Fn(f64) -> f64) {
        let (mixture, b) = self.techniques.at(&pdfs);
        if mixture == 0.0 {
            return;
        }
        let (weight, q) = (weight(mixture), V::Wide::splat(mixture));
        // A technique without draws cannot carry its auxiliary.
        let h: [V::Wide; K] =
            core::array::from_fn(|k| if self.techniques.shares[k] == 0.0 { V::Wide::ZERO } else { h[k].widen() / q });
        let f = f.widen() / q;
        for k in 0..K {
            let (weighted_b, weighted_h) = (V::Wide::splat(weight * b[k]), V::Wide::splat(weight) * h[k]);
            for j in 0..K {
                self.bb[k][j] += weight * b[k] * b[j];
                self.bh[k][j] = self.bh[k][j] + weighted_b * h[j];
                self.hh[k][j] = self.hh[k][j] + weighted_h * h[j];
            }
            self.bf[k] = self.bf[k] + weighted_b * f;
            self.hf[k] = self.hf[k] + weighted_h * f;
        }
    }

    /// The weights that have the least variance to first order over what the pilot has seen.
    ///
    /// A channel where auxiliaries (or techniques) depend on each other raises RANK: its weights are as
    /// good, one of many equally good choices. So does an empty pilot, whose weights are those of the
    /// balance heuristic. A channel with a number that is not finite has these too, and raises ALPHA.
    pub fn optimal(&self) -> OptimalWeights<V, K> {
        // The conditions ⟨h_k λ⟩ = 0 and F_k = ∫u_k read G·a + Bᵀ·c = ⟨h f⟩ and B·a − L·c = ⟨b f⟩, with
        // G = ⟨h_k h_j⟩, B = ⟨b_k h_j⟩ and the Laplacian L below. The first gives a; the second becomes
        // (L + B·G⁻¹·Bᵀ)·c = B·G⁻¹·⟨h f⟩ − ⟨b f⟩. G and that matrix are positive semidefinite.
        let wanted = self.techniques.shares.map(|share| if share == 0.0 { V::Wide::ZERO } else { V::Wide::ONE });
        let on_auxiliaries = |right: &[V::Wide; K]| solve(&self.hh, right, &wanted, TOLERANCE);
        let of_f = on_auxiliaries(&self.hf);
        let of_techniques = self.bh.each_ref().map(|row| on_auxiliaries(row).x);
        let system = core::array::from_fn(|k| {
            core::array::from_fn(|j| self.laplacian(k, j) + dot(&self.bh[k], &of_techniques[j]))
        });
        let right = core::array::from_fn(
            |k| planted!("pilot_sign": dot(&self.bh[k], &of_f.x) - self.bf[k], self.bf[k] - dot(&self.bh[k], &of_f.x)),
        );
        let of_constants: Solution<V::Wide, K> = solve(&system, &right, &wanted, TOLERANCE);
        let constants = of_constants.x;
        let slopes: [V::Wide; K] =
            core::array::from_fn(|i| (0..K).fold(of_f.x[i], |slope, j| slope - of_techniques[j][i] * constants[j]));
        // What is not finite, here or in the sums, makes this so in its lane.
        let all = (slopes.iter().chain(&constants)).fold(self.sum_of_all(), |sum, x| sum + *x);
        let finite = |i: usize| all.get(i).is_finite();
        let sound = |x: V::Wide| V::Wide::from_fn(|i| if finite(i) { x.get(i) } else { 0.0 });
        let lacks_rank = of_f.lacks_rank(&wanted) + of_constants.lacks_rank(&wanted);
        let flags = PerLane::from_fn(|i| match finite(i) {
            true => Flags::when(lacks_rank.get(i) > 0.0, Flags::RANK),
            false => Flags::ALPHA,
        });
        OptimalWeights::from_parts(self.techniques, slopes.map(sound), constants.map(sound), flags)
    }

    /// L = diag(ν_k) − ⟨b_k ν_j g_j⟩. The diagonal is minus the sum of the rest of its row, since
    /// Σ_j b_j = 1; so written it does not cancel, and L is never indefinite.
    fn laplacian(&self, k: usize, j: usize) -> V::Wide {
        let others = (0..K).filter(|i| *i != k).fold(0.0, |sum, i| sum + self.bb[k][i]);
        V::Wide::splat(if j == k { planted!("pilot_diagonal": others, others + self.bb[k][k]) } else { -self.bb[k][j] })
    }

    /// The sum of all that is kept.
    fn sum_of_all(&self) -> V::Wide {
        let bb = self.bb.as_flattened().iter().fold(0.0, |sum, bb| sum + bb);
        let lanes = self.bh.as_flattened().iter().chain(self.hh.as_flattened()).chain(&self.bf).chain(&self.hf);
        lanes.fold(V::Wide::splat(bb), |sum, one| sum + *one)
    }
}

/// Far above what rounding leaves of an auxiliary that depends on others, far below the noise of a
/// pilot.
const TOLERANCE: f64 = 1e-10;

/// Σx·y.
fn dot<W: Lanes, const K: usize>(x: &[W; K], y: &[W; K]) -> W {
    x.iter().zip(y).fold(W::ZERO, |sum, (x, y)| sum + *x * *y)
}

impl<V: Lanes, const K: usize> Merge for Pilot<V, K> {
    /// Appends the points of `later`, whose techniques must have the same counts: the sums of other
    /// mixtures mean something else.
    fn merge(&mut self, later: &Self) {
        for k in 0..K {
            for j in 0..K {
                self.bb[k][j] += later.bb[k][j];
                self.bh[k][j] = self.bh[k][j] + later.bh[k][j];
                self.hh[k][j] = self.hh[k][j] + later.hh[k][j];
            }
            self.bf[k] = self.bf[k] + later.bf[k];
            self.hf[k] = self.hf[k] + later.hf[k];
        }
    }
}
