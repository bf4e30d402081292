//! Ratio control variates: vector-valued Monte Carlo integration without the noise that the
//! integrand shares with a function whose integral is known.
//!
//! When each draw yields f and an auxiliary h with the known integral H, H·mean(f)/mean(h) cancels,
//! channel by channel, the noise that f and h have in common (Lu, Vicini, Chang, Li, *Vector-Valued
//! Monte Carlo Integration Using Ratio Control Variates*, SIGGRAPH 2025). This crate is the
//! estimators, their error bars and their predictions; it allocates nothing, contains no `unsafe`,
//! and runs without `std`.
//!
//! A **draw** is f/pdf and h/pdf of one sample. An **accumulator** keeps the moments that an
//! estimator reads. An **estimator** turns moments and known integrals into an **estimate**:
//!
//! ```
//! use ratiocv_core::{moments::{Accumulate, Sums}, Draw, Estimator, Integrals, RatioOfMeans, Reads, Spectrum};
//! // A renderer, one RGB pixel: f/pdf, and p_j/pdf (which integrates to 1) for each channel j.
//! let trace = |i: usize| (Spectrum([0.2, 0.5, 0.1 * i as f32]), Spectrum([1.0_f32, 1.2, 0.2 * i as f32]));
//! let mut pixel = Sums::<Spectrum<f32, 3>>::default();
//! for i in 0..16 {
//!     let (f, h) = trace(i);
//!     pixel.add(Draw::new(f, h));
//! }
//! let rgb = RatioOfMeans.defensive(0.01)?.estimate(&pixel, &Integrals::ONE)?.value;
//! assert!((rgb[2] - 0.5).abs() < 0.01); // f = h/2 there
//! # Ok::<(), ratiocv_core::Error>(())
//! ```
//!
//! To first order every estimator here is a difference control variate ȳ + c(H − x̄); they differ in
//! the coefficient c that they imply, 0 for plain Monte Carlo, F/H for the ratio, Cov(x, y)/Var(x) for
//! regressions. [`which_estimator`] says which one to take, and what each costs; [`embedding`] how to put it
//! into a renderer; [`promises`] what holds whatever the draws are, and which test holds it.
//!
//! # Features
//! - `conformance`: the laws of the traits as public functions, to be run on implementors.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(any(test, planted_bugs))]
extern crate std;

mod adaptive;
#[cfg(feature = "conformance")]
pub mod conformance;
mod draw;
mod environment;
mod error;
mod estimate;
mod estimator;
mod filled;
mod film;
mod flags;
mod integrals;
mod lanes;
pub mod moments;
mod path_space;
#[doc(hidden)]
pub mod planted;
pub mod predict;
mod problem;
pub mod sampling;
mod scaled;
mod solve;
mod spectrum;
mod stopping;
pub mod weights;

#[doc = include_str!("embedding.md")]
#[doc = "```rust,ignore"]
#[doc = include_str!("../examples/renderer/render.rs")]
#[doc = "```"]
pub mod embedding {}

#[doc = include_str!("promises.md")]
pub mod promises {}

#[doc = include_str!("which_estimator.md")]
pub mod which_estimator {}

pub use adaptive::{AtPosition, ComponentDensities, Grid, GridPoint};
pub use draw::Draw;
pub use environment::{FpEnvironment, fp_environment};
pub use error::Error;
pub use estimate::{ChannelEstimate, Estimate};
pub use estimator::{
    Beale, Choice, Choose, Coefficients, Combined, CrossFitted, Defensive, Dependent, DeterministicMixture, Difference,
    EstimatedIntegrals, Estimator, FallBackWhenIll, Fit, Fixed, HartleyRoss, Jackknife, MeanOfRatios, Mickey,
    OptimalDefensive, Plain, Quenouille, RandomMixture, RatioOfIntegrals, RatioOfMeans, Reads, Regression,
    RegressionRatio, Sample, Tin, Uncertain, WithCoefficients,
};
pub use film::Film;
pub use flags::Flags;
pub use integrals::Integrals;
pub use lanes::{Lanes, PerLane, Scalar, Single};
pub use path_space::{PathProduct, ScaledSums};
pub use problem::{
    Auxiliaries, Auxiliary, Integrand, Problem, Proposal, Uniform, UniformCube, WithIntegral, unit_interval,
};
pub use spectrum::Spectrum;
pub use stopping::{Decision, Stopping};
