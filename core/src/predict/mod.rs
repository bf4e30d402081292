//! Bias and mean squared error of each estimator, from the moments of the draws' law.
//!
//! To first and to second order in 1/N (Tin 1965, with the supplement's misprints put right); exact for
//! plain Monte Carlo, the mean of ratios and Hartley–Ross.

mod fitted;
mod population;
mod ratios;

pub use population::{Population, RatioPopulation};

/// How many terms of the expansion in 1/N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The 1/N term alone.
    First,
    /// The 1/N and the 1/N² term.
    Second,
}

/// Predicted moments of an estimator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// E\[F̂\] − F.
    pub bias: f64,
    /// E\[(F̂ − F)²\].
    pub mse: f64,
}

/// Predicts its own bias and MSE.
///
/// *Implemented by* each estimator; *called by* reports and by whoever chooses an estimator.
///
/// # Laws
/// An unbiased estimator predicts a bias of 0, to the bit. Predictions scale with f as the estimator
/// does, and do not depend on the unit of h.
pub trait Predict {
    /// Bias and MSE for `draws` draws from `population`; NaN where a moment is not known, where
    /// `draws` is below the estimator's least number, or for second-order terms of one draw.
    ///
    /// ```
    /// use ratiocv_core::predict::{Order, Population, Predict, RatioPopulation};
    /// use ratiocv_core::{Plain, RatioOfMeans};
    /// // f = 2h, Var(h) = 1/4: the ratio has no error at all.
    /// let population = Population {
    ///     f: 2.0, h: 1.0, c20: 0.25, f_c11: 0.5, ff_c02: 1.0, c30: 0.0, f_c21: 0.0, ff_c12: 0.0,
    ///     ratio: RatioPopulation { mean: 2.0, variance: 0.0 },
    ///     defended: (0.01, RatioPopulation::UNKNOWN),
    /// };
    /// assert_eq!(Plain.predict(&population, 100, Order::First).mse, 0.01);
    /// let ratio = RatioOfMeans.predict(&population, 100, Order::Second);
    /// assert_eq!((ratio.bias, ratio.mse), (0.0, 0.0));
    /// ```
    fn predict(&self, population: &Population, draws: u64, order: Order) -> Prediction;
}
