//! Importance sampling of vectors (Lu, Vicini, Chang, Li 2025, supplement, Section 2).
//!
//! Four ways to spend N samples on M channels, all unbiased. Each makes plain draws, so that every
//! accumulator, estimator and driver of this crate takes them unchanged:
//!
//! | estimator of the supplement | here | variance of channel j | least total at |
//! |---|---|---|---|
//! | 1, vector-valued | any [`Proposal`](crate::Proposal) | (∫f_j²/g − F_j²)/N | g ∝ √Σ_j f_j² (Lemma 1): [`Discrete::by_norm`], [`PiecewiseConstant::by_norm`] |
//! | 2, entry-wise stratification | [`Strata`] | (∫f_j²/g_k − F_j²)/N_k, k = k(j) | N_k ∝ σ_k: [`Strata::neyman`] |
//! | 3, random mixture | [`RandomMixture`] | (∫f_j²/(p_j g_j) − F_j²)/N | p_j g_j ∝ \|f_j\| (Lemma 4) |
//! | 4, partial | [`Partial`] | (∫f_j²/(g a_j) − F_j²)/N | a_j = 1: Estimator 1 (Lemma 6) |
//!
//! At equal draws Estimator 1 at its best is never worse than 3 at its best (Lemma 5), nor than 4 on
//! the same g (Lemma 6): take these where evaluating one channel costs much less than evaluating all
//! of them. Between 1 and 2 the integrand decides (Lemma 3): non-negative channels of different shapes
//! favour strata, which can then reach variance 0, channels that change sign together the vector.
//! Estimator 1 reaches variance 0 only if every channel is a multiple, of constant sign, of √Σ_j f_j²
//! (Lemma 2); what is left is what ratio control variates are for.
//!
//! [`Problem::accumulate_midzuno_sen`](crate::Problem::accumulate_midzuno_sen) belongs to the ratio
//! of means: one draw from the auxiliary makes it unbiased.

mod allocate;
mod discrete;
mod l2_norm;
mod midzuno_sen;
mod partial;
mod piecewise_constant;
mod random_mixture;
mod strata;
mod table;

pub use allocate::allocate;
pub use discrete::Discrete;
pub use l2_norm::l2_norm;
pub use partial::{Accepted, Partial};
pub use piecewise_constant::PiecewiseConstant;
pub use random_mixture::{RandomMixture, in_channel};
pub use strata::Strata;
