//! What to measure.

use crate::catalogue::Method;
use crate::problems::Problem;
use core::fmt;

/// What to measure, and how long.
#[derive(Clone, Debug)]
pub struct Options {
    /// The problems.
    pub problems: Vec<Problem>,
    /// The estimators; plain Monte Carlo is measured in any case, as the baseline.
    pub methods: Vec<Method>,
    /// The seed of all draws.
    pub seed: u64,
    /// Threads for the replicates; `None` for one per core.
    pub threads: Option<usize>,
    /// Roughly the seconds that two cores take. It decides the number of replicates by a nominal cost per
    /// draw, never by a clock, so that the same budget gives the same results on any machine.
    pub budget_seconds: f64,
    /// ε of the defensive estimators.
    pub defensive_weight: f64,
    /// Whether the [exhibits](crate::exhibits) are measured too: some 8 s, whatever the budget.
    pub exhibits: bool,
    /// A first look: at most 3 s of budget, at most 2⁸ draws.
    pub quick: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            problems: Problem::all().collect(),
            methods: Method::all().collect(),
            seed: 1,
            threads: None,
            budget_seconds: 28.0,
            defensive_weight: 0.01,
            exhibits: true,
            quick: false,
        }
    }
}

/// Why there is no report.
#[derive(Debug)]
pub enum Error {
    /// The defensive weight is out of range.
    Weight(ratiocv_core::Error),
    /// The budget is not a positive number of seconds.
    Budget(f64),
    /// No thread pool.
    Threads(rayon::ThreadPoolBuildError),
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Weight(error) => error.fmt(out),
            Self::Budget(budget) => write!(out, "a budget of {budget} s: give a positive number of seconds"),
            Self::Threads(error) => write!(out, "no threads to measure with: {error}; try fewer"),
        }
    }
}

impl core::error::Error for Error {}
