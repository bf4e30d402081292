//! The draws that everything is measured on.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use ratiocv_core::{Draw, Lanes};

/// `count` draws with h in \[0.25, 1.75) and f/h about 1, correlated by 0.9 in each channel: neither
/// zeros nor cancellation, so that inaccurate rivals are right too.
pub(crate) fn draws<V: Lanes>(count: usize, number: impl Fn(f64) -> V::Scalar) -> Vec<Draw<V>> {
    let mut rng = Pcg64::seed_from_u64(11);
    let mut uniform = || (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let mut draw = || {
        let h: Vec<f64> = (0..V::LANES).map(|_| 0.25 + 1.5 * uniform()).collect();
        let f: Vec<f64> = h.iter().map(|h| 0.1 + 0.7 * h + 0.5 * uniform()).collect();
        Draw::new(V::from_fn(|i| number(f[i])), V::from_fn(|i| number(h[i])))
    };
    (0..count).map(|_| draw()).collect()
}
