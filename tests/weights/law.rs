//! Discrete laws of several techniques, with every integral a sum.

use ratiocv_core::weights::{OptimalWeights, Pilot, PowerHeuristic};
use ratiocv_tests::samples::Noise;

/// f, and h_k, g_k of `K` techniques, at each point of unit volume.
#[derive(Clone, Debug)]
pub(crate) struct Law<const K: usize> {
    pub(crate) counts: [f64; K],
    pub(crate) f: Vec<f64>,
    pub(crate) h: Vec<[f64; K]>,
    pub(crate) g: Vec<[f64; K]>,
}

/// The parts u_k at each point.
pub(crate) type Parts<const K: usize> = Vec<[f64; K]>;

impl<const K: usize> Law<K> {
    /// `points` points: f near a mixture of auxiliaries, each h_k near g_k, and H_k not 1. Signed f for
    /// odd seeds. Technique 0 does not reach point 0.
    pub(crate) fn random(seed: u64, points: usize) -> Self {
        let mut noise = Noise(seed);
        let mut list =
            |least: f64| -> Vec<[f64; K]> { (0..points).map(|_| [0; K].map(|_| least + noise.next_unit())).collect() };
        let (mut g, mut h, mix) = (list(0.1), list(0.0), list(0.2));
        (g[0][0], h[0][0]) = (0.0, 0.0);
        for k in 0..K {
            let sum: f64 = g.iter().map(|g| g[k]).sum();
            g.iter_mut().for_each(|g| g[k] /= sum);
        }
        for (h, g) in h.iter_mut().zip(&g) {
            *h = core::array::from_fn(|k| 1.5 * g[k] * (0.3 + h[k]));
        }
        let sign = |i: usize| if seed % 2 == 1 && i.is_multiple_of(3) { -1.0 } else { 1.0 };
        let f = (0..points).map(|i| sign(i) * (0..K).map(|k| h[i][k] * mix[i][k]).sum::<f64>()).collect();
        let counts = core::array::from_fn(|k| 1.0 + k as f64);
        Self { counts, f, h, g }
    }

    /// Σ over the points.
    pub(crate) fn integral(&self, of: impl Fn(usize) -> f64) -> f64 {
        (0..self.f.len()).map(of).sum()
    }

    pub(crate) fn f_integral(&self) -> f64 {
        self.integral(|i| self.f[i])
    }

    pub(crate) fn h_integral(&self, k: usize) -> f64 {
        self.integral(|i| self.h[i][k])
    }

    /// ν_k.
    pub(crate) fn share(&self, k: usize) -> f64 {
        self.counts[k] / self.counts.iter().sum::<f64>()
    }

    /// d_k = u_k − h_k F_k/H_k at each point.
    pub(crate) fn residuals(&self, parts: &[[f64; K]]) -> Parts<K> {
        let slope: [f64; K] = core::array::from_fn(|k| self.integral(|i| parts[i][k]) / self.h_integral(k));
        (0..parts.len()).map(|i| core::array::from_fn(|k| parts[i][k] - self.h[i][k] * slope[k])).collect()
    }

    /// Σ_k ∫a_k b_k/(ν_k g_k): N times the first-order variance, for the residuals of both.
    pub(crate) fn product(&self, a: &[[f64; K]], b: &[[f64; K]]) -> f64 {
        let term = |i: usize, k: usize| {
            if self.g[i][k] == 0.0 { 0.0 } else { a[i][k] * b[i][k] / self.share(k) / self.g[i][k] }
        };
        self.integral(|i| (0..K).map(|k| term(i, k)).sum())
    }

    /// N times the variance of the sum of ratios, to first order.
    pub(crate) fn variance(&self, parts: &[[f64; K]]) -> f64 {
        let residuals = self.residuals(parts);
        self.product(&residuals, &residuals)
    }

    /// The parts w_k f of weights that are a heuristic of the `K` numbers at each point.
    pub(crate) fn heuristic(&self, heuristic: PowerHeuristic, counts: [f64; K], of: &[[f64; K]]) -> Parts<K> {
        let at = |i: usize| heuristic.weights(&counts, &of[i]).map(|w| w * self.f[i]);
        (0..of.len()).map(at).collect()
    }

    /// The pilot that has seen every point as a cell.
    pub(crate) fn pilot(&self) -> Pilot<f64, K> {
        let mut pilot = Pilot::new(self.counts).expect("counts");
        for i in 0..self.f.len() {
            pilot.add_cell(1.0, self.f[i], self.h[i], self.g[i]);
        }
        pilot
    }

    pub(crate) fn parts(&self, weights: &OptimalWeights<f64, K>) -> Parts<K> {
        (0..self.f.len()).map(|i| weights.parts(self.f[i], self.h[i], self.g[i])).collect()
    }

    /// Σ_k u_k = f?
    pub(crate) fn assert_complete(&self, parts: &[[f64; K]]) {
        for (parts, f) in parts.iter().zip(&self.f) {
            let size = parts.iter().fold(f.abs(), |size, part| size + part.abs());
            ratiocv_tests::assert_close(parts.iter().sum(), *f, 8.0 * K as f64 * f64::EPSILON * size, "Σu");
        }
    }
}

/// Of two techniques that each have a peak of their own, f has both on a floor that neither sees well:
/// auxiliaries that are exact on their peaks, which the heuristics cut up.
pub(crate) fn two_peaks() -> Law<2> {
    let peak = |i: usize, at: f64| 1e-4 + (-(i as f64 - at).powi(2) / 8.0).exp();
    let points = 40;
    let sum = |at: f64| (0..points).map(|i| peak(i, at)).sum::<f64>();
    let h: Vec<[f64; 2]> = (0..points).map(|i| [peak(i, 15.0) / sum(15.0), peak(i, 22.0) / sum(22.0)]).collect();
    let g = h.iter().map(|[a, b]| [0.5 * a + 0.5 / points as f64, 0.5 * b + 0.5 / points as f64]).collect();
    let f = h.iter().map(|[a, b]| 1.0 * a + 3.0 * b).collect();
    Law { counts: [1.0, 1.0], f, h, g }
}
