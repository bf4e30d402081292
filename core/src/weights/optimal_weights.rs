//! The closed-form optimum for separate draws of each technique.

use crate::draw::Draw;
use crate::error::Error;
use crate::flags::Flags;
use crate::lanes::{Lanes, PerLane};
use crate::planted::planted;
use crate::weights::PowerHeuristic;

/// Splits f into parts u_k = w_k f, one for each of `K` techniques, Σ_k u_k = f, so that
/// Σ_k H_k·mean(u_k/g_k)/mean(h_k/g_k) over n_k draws from each g_k has the least variance to first
/// order, Σ_k ∫(u_k − h_k F_k/H_k)²/g_k/n_k with F_k = ∫u_k:
///
/// u_k = a_k h_k + b_k·(f − Σ_j a_j h_j − Σ_j ν_j g_j c_j) + ν_k g_k c_k,
///
/// where ν_k = n_k/Σn_j, b_k = ν_k g_k/Σν_j g_j (the balance heuristic), a_k = F_k/H_k, and the 2K
/// constants a_k, c_k solve the linear equations of [`Pilot`](super::Pilot). This is the Lagrange
/// condition of a convex problem, which Lu et al. (2025, A.13) leave open.
///
/// For *any* constants the parts add up to f, so that the sum of ratios is consistent, whatever the
/// pilot was; only its variance depends on them. c_k is a constant of technique k that all others
/// take away again: parts may be negative, and need not vanish where f does. h_k must vanish where g_k
/// does, as for every ratio.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments}, Estimator, Integrals, RatioOfMeans};
/// use ratiocv_core::weights::{OptimalWeights, Pilot};
/// // Two techniques on [0, 1): g₁ = 1, g₂ = 2x, and auxiliaries 1 and 2x; f = 1 + 3x².
/// let at = |x: f64| (1.0 + 3.0 * x * x, [1.0, 2.0 * x], [1.0, 2.0 * x]);
/// let mut pilot = Pilot::new([50.0, 50.0])?;
/// for i in 0..50 {
///     let u = (f64::from(i) + 0.5) / 50.0;
///     for x in [u, u.sqrt()] {
///         let (f, h, pdfs) = at(x);
///         pilot.add(f, h, pdfs);
///     }
/// }
/// let weights: OptimalWeights<f64, 2> = pilot.optimal();
/// let mut sums = [Comoments::<f64>::default(); 2];
/// for i in 0..50 {
///     let u = f64::from(i * 7 % 50) / 50.0 + 0.01;
///     for (k, x) in [u, u.sqrt()].into_iter().enumerate() {
///         let (f, h, pdfs) = at(x);
///         sums[k].add(weights.draw(k, f, h, pdfs)); // u_k/g_k and h_k/g_k
///     }
/// }
/// let one = |k: usize| RatioOfMeans.estimate(&sums[k], &Integrals::ONE);
/// let estimate = one(0)?.plus_independent(&one(1)?);
/// assert!((estimate.value - 2.0).abs() < 0.01);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct OptimalWeights<V: Lanes, const K: usize> {
    techniques: Techniques<K>,
    slopes: [V::Wide; K],
    constants: [V::Wide; K],
    flags: V::PerLane<Flags>,
}

impl<V: Lanes, const K: usize> OptimalWeights<V, K> {
    /// Weights with given constants a_k and c_k, for `counts[k]` draws of technique k. All 0: the
    /// balance heuristic.
    ///
    /// # Errors
    /// [`Error::Counts`] unless all are finite, none is negative and one is positive.
    pub fn new(counts: [f64; K], slopes: [V::Wide; K], constants: [V::Wide; K]) -> Result<Self, Error> {
        Ok(Self::from_parts(Techniques::new(counts)?, slopes, constants, PerLane::from_fn(|_| Flags::NONE)))
    }

    pub(super) fn from_parts(
        techniques: Techniques<K>,
        slopes: [V::Wide; K],
        constants: [V::Wide; K],
        flags: V::PerLane<Flags>,
    ) -> Self {
        Self { techniques, slopes, constants, flags }
    }

    /// The parts u_k of f at a point, from f, h_j and g_j there, not divided by anything.
    ///
    /// Where no technique reaches the point, all are 0; if a pdf is not a finite number, NaN.
    pub fn parts(&self, f: V, h: [V; K], pdfs: [f64; K]) -> [V::Wide; K] {
        let (mixture, b) = self.techniques.at(&pdfs);
        if mixture == 0.0 {
            return [V::Wide::ZERO; K];
        }
        let splat = V::Wide::splat;
        let own: [V::Wide; K] = core::array::from_fn(|k| self.slopes[k] * h[k].widen());
        let shift: [V::Wide; K] = core::array::from_fn(|k| splat(mixture * b[k]) * self.constants[k]);
        let taken = |all: &[V::Wide; K]| all.iter().fold(V::Wide::ZERO, |sum, one| sum + *one);
        let rest = f.widen() - taken(&own) - planted!("parts_rest": taken(&shift), V::Wide::ZERO);
        core::array::from_fn(|k| own[k] + splat(b[k]) * rest + shift[k])
    }

    /// The draw u_k/g_k, h_k/g_k for the ratio of technique k = `technique`, at a point drawn from g_k;
    /// panics if there is no such technique.
    ///
    /// Not finite where g_k = 0: such a point is no draw of technique k.
    pub fn draw(&self, technique: usize, f: V, h: [V; K], pdfs: [f64; K]) -> Draw<V> {
        let pdf = V::Wide::splat(pdfs[technique]);
        let part = self.parts(f, h, pdfs)[technique];
        Draw::new(V::narrow(part / pdf), V::narrow(h[technique].widen() / pdf))
    }

    /// The slopes a_k = F_k/H_k: what each technique's ratio converges to.
    pub fn slopes(&self) -> [V::Wide; K] {
        self.slopes
    }

    /// The constants c_k; adding the same number to all of them changes nothing.
    pub fn constants(&self) -> [V::Wide; K] {
        self.constants
    }

    /// Remarks on channel `channel`; panics if there is no such channel.
    pub fn flags(&self, channel: usize) -> Flags {
        self.flags.get(channel)
    }
}

/// The shares ν_k of the techniques.
#[derive(Clone, Copy, Debug)]
pub(super) struct Techniques<const K: usize> {
    pub(super) shares: [f64; K],
}

impl<const K: usize> Techniques<K> {
    pub(super) fn new(counts: [f64; K]) -> Result<Self, Error> {
        let sum = counts.iter().fold(0.0, |sum, n| sum + n);
        if counts.iter().all(|n| *n >= 0.0) && sum > 0.0 && sum.is_finite() {
            Ok(Self { shares: counts.map(|n| n / sum) })
        } else {
            Err(Error::Counts)
        }
    }

    /// The mixture pdf q, and b_k = ν_k g_k/q: NaN where a pdf is negative or not a finite number.
    pub(super) fn at(&self, pdfs: &[f64; K]) -> (f64, [f64; K]) {
        if !pdfs.iter().all(|pdf| *pdf >= 0.0 && pdf.is_finite()) {
            return (f64::NAN, [f64::NAN; K]);
        }
        let mixture = self.shares.iter().zip(pdfs).fold(0.0, |sum, (share, pdf)| sum + share * pdf);
        (mixture, PowerHeuristic::BALANCE.of_channel(&self.shares, pdfs))
    }
}
