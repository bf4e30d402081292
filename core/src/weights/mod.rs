//! Weights for several sampling techniques: Σ_k w_k = 1 wherever f ≠ 0.
//!
//! [`PowerHeuristic`] needs nothing but the pdfs. [`OptimalWeights`] know the integrand and the
//! auxiliaries from a [`Pilot`], and are the best there are for a sum of ratios
//! Σ_k H_k·mean(w_k f/g_k)/mean(h_k/g_k) over separate draws of each technique, to first order.
//! [`check_sum`] is for weights of other origin.

mod check_sum;
mod optimal_weights;
mod pilot;
mod power_heuristic;

pub use check_sum::check_sum;
pub use optimal_weights::OptimalWeights;
pub use pilot::Pilot;
pub use power_heuristic::PowerHeuristic;
