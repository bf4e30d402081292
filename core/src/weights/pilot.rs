//! Draws that teach the optimal weights.

use crate::error::Error;
use crate::flags::Flags;
use crate::lanes::{Lanes, PerLane};
use crate::moments::Merge;
use crate::planted::planted;
use crate::weights::elimination::{Equation, solve};
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
        let channels = V::PerLane::<([[f64; K]; 2], Flags)>::from_fn(|channel| self.solved(channel));
        let constants = |kind: usize| core::array::from_fn(|k| V::Wide::from_fn(|i| channels.get(i).0[kind][k]));
        let flags = PerLane::from_fn(|i| channels.get(i).1);
        OptimalWeights::from_parts(self.techniques, constants(1), constants(0), flags)
    }

    /// The constants c_k and a_k = F_k/H_k of one channel.
    fn solved(&self, channel: usize) -> ([[f64; K]; 2], Flags) {
        let mut system = [0, 1].map(|kind| core::array::from_fn(|k| self.equation(kind, k, channel)));
        let size = [0, 1].map(|kind| core::array::from_fn::<_, K, _>(|k| self.size(kind, k, channel)));
        // In units in which every coefficient is of size 1.
        for (row, unit) in system.as_flattened_mut().iter_mut().zip(size.as_flattened()) {
            row.right /= unit;
            for (entry, other) in row.left.as_flattened_mut().iter_mut().zip(size.as_flattened()) {
                *entry = *entry / unit / other;
            }
        }
        let finite = |row: &Equation<K>| row.right.is_finite() && row.left.as_flattened().iter().all(|x| x.is_finite());
        if !system.as_flattened().iter().all(finite) {
            return ([[0.0; K]; 2], Flags::ALPHA);
        }
        let (mut solution, full) = solve(system);
        for (x, unit) in solution.as_flattened_mut().iter_mut().zip(size.as_flattened()) {
            *x /= unit;
        }
        if !solution.as_flattened().iter().all(|x| x.is_finite()) {
            return ([[0.0; K]; 2], Flags::ALPHA);
        }
        (solution, Flags::when(!full, Flags::RANK))
    }

    /// The equation of the condition F_k = ∫u_k (`kind` 0), or of that on c_k (`kind` 1): unknowns c_j,
    /// then a_j.
    ///
    /// The diagonal of the first, ⟨b_k ν_k g_k⟩ − ν_k, is minus the sum of the rest of its row, since
    /// Σ_j b_j = 1; so written it does not cancel, and the block is never indefinite.
    fn equation(&self, kind: usize, k: usize, channel: usize) -> Equation<K> {
        let get = |x: &V::Wide| x.get(channel);
        if kind == 1 {
            let left = [core::array::from_fn(|j| get(&self.bh[j][k])), self.hh[k].each_ref().map(get)];
            return Equation { left, right: get(&self.hf[k]) };
        }
        let mut own = self.bb[k];
        own[k] = 0.0;
        let others = own.iter().fold(0.0, |sum, bb| sum + bb);
        own[k] = planted!("pilot_diagonal": -others, self.bb[k][k]);
        Equation { left: [own, self.bh[k].each_ref().map(get)], right: get(&self.bf[k]) }
    }

    /// √⟨b_k⟩ or √⟨h_k²⟩; 1 where that is 0.
    fn size(&self, kind: usize, k: usize, channel: usize) -> f64 {
        let square = if kind == 1 { self.hh[k][k].get(channel) } else { self.bb[k].iter().fold(0.0, |sum, b| sum + b) };
        if square == 0.0 { 1.0 } else { libm::sqrt(square) }
    }
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
