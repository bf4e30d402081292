//! Weights of other origin.

use crate::flags::Flags;
use crate::lanes::{Lanes, PerLane};
use crate::planted::planted;
use num_traits::float::FloatCore;

/// WEIGHTS in every channel where f ≠ 0 and Σ_k w_k is not 1: such weights bias the estimate by just
/// that factor.
///
/// What rounding may leave is allowed: 8K units of roundoff of the lanes' scalar, times Σ|w_k| if
/// that is above 1. A NaN among the weights is flagged; where f = 0 any weights will do.
///
/// ```
/// use ratiocv_core::{weights::check_sum, Flags, PerLane, Spectrum};
/// let flags = check_sum(&[Spectrum([0.5_f32, 0.5]), Spectrum([0.5, 0.4])], Spectrum([1.0, 1.0]));
/// assert_eq!((flags.get(0), flags.get(1)), (Flags::NONE, Flags::WEIGHTS));
/// ```
pub fn check_sum<V: Lanes, const K: usize>(weights: &[V; K], f: V) -> V::PerLane<Flags> {
    let roundoff = <V::Scalar as FloatCore>::epsilon().widen() / 2.0;
    let weights = weights.map(V::widen);
    PerLane::from_fn(|i| {
        let (sum, size) = weights.iter().fold((0.0, 0.0), |(sum, size), w| (sum + w.get(i), size + w.get(i).abs()));
        let off: f64 = planted!("weights_sum": sum, sum / size) - 1.0;
        let allowed = 8.0 * K as f64 * roundoff * if size > 1.0 { size } else { 1.0 };
        // Written so that a NaN is flagged.
        let sound = off.abs() <= allowed || f.widen().get(i) == 0.0;
        Flags::when(!sound, Flags::WEIGHTS)
    })
}
