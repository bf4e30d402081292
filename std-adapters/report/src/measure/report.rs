//! What a run found out.

use crate::catalogue::Method;
use crate::exhibits::Exhibits;
use crate::measure::{Coverage, Equal};
use crate::problems::Problem;
use crate::provenance::Provenance;
use ratiocv_core::predict::Prediction;

/// What a run found out, problem by problem.
#[derive(Clone, Debug)]
pub struct Report {
    /// Where, when and with what it was measured.
    pub provenance: Provenance,
    /// The problems, in the order of the options.
    pub problems: Vec<ProblemReport>,
    /// What else was measured.
    pub exhibits: Option<Exhibits>,
}

/// One problem, all estimators.
#[derive(Clone, Debug)]
pub struct ProblemReport {
    /// The problem.
    pub problem: Problem,
    /// The number of draws that plain Monte Carlo has at the time, or error, of [`MethodReport::equal`].
    pub reference_draws: u64,
    /// The estimators, plain first.
    pub methods: Vec<MethodReport>,
}

/// One estimator on one problem.
#[derive(Clone, Debug)]
pub struct MethodReport {
    /// The estimator.
    pub method: Method,
    /// By number of draws, ascending.
    pub points: Vec<Point>,
    /// Compared with plain Monte Carlo.
    pub equal: Equal,
    /// Whether theory agrees with the largest number of draws.
    pub theory: Theory,
}

/// One estimator on one problem with one number of draws.
#[derive(Clone, Debug)]
pub struct Point {
    /// Draws per estimate.
    pub draws: u64,
    /// Independent estimates.
    pub replicates: u64,
    /// In units of F: bias over F and MSE over F², mean over channels.
    pub relative: Figures,
    /// The same for each channel.
    pub channels: Vec<ChannelPoint>,
    /// Of intervals, all channels together; only after 16, 64 and 256 draws.
    pub coverage: Option<Coverage>,
    /// Of one estimate, sampling included.
    pub seconds: Seconds,
}

impl Point {
    /// The channel, by its place, whose intervals contain F least often; the first of several. A channel
    /// without intervals comes before all others.
    pub fn worst_coverage(&self) -> Option<(usize, Coverage)> {
        let share = |coverage: &Coverage| if coverage.share.is_nan() { -1.0 } else { coverage.share };
        let channels = self.channels.iter().enumerate();
        let judged = channels.filter_map(|(index, channel)| Some((index, channel.coverage?)));
        judged.min_by(|(_, a), (_, b)| share(a).total_cmp(&share(b)))
    }
}

/// One channel of a [`Point`], in units of its F.
#[derive(Clone, Copy, Debug)]
pub struct ChannelPoint {
    /// Measured and predicted.
    pub relative: Figures,
    /// Of this channel's intervals, as [`Point::coverage`].
    pub coverage: Option<Coverage>,
}

/// Bias and MSE, measured and predicted.
#[derive(Clone, Copy, Debug)]
pub struct Figures {
    /// Mean of the error.
    pub bias: f64,
    /// Its standard error.
    pub bias_std_error: f64,
    /// Mean of the squared error.
    pub mse: f64,
    /// Its standard error.
    pub mse_std_error: f64,
    /// What theory expects, to second order in 1/N; NaN where it says nothing.
    pub predicted: Prediction,
    /// What theory expects to first order.
    pub first_order: Prediction,
}

impl Figures {
    /// √MSE.
    pub fn rmse(&self) -> f64 {
        libm::sqrt(self.mse)
    }
}

/// Run time of one estimate.
#[derive(Clone, Copy, Debug)]
pub struct Seconds {
    /// Median over repetitions.
    pub median: f64,
    /// First quartile.
    pub lower: f64,
    /// Third quartile.
    pub upper: f64,
}

/// Measured against predicted MSE, at the largest number of draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Theory {
    /// (measured − predicted) in standard errors.
    pub deviation: f64,
    /// Within four standard errors, or within the last term of the expansion.
    pub agrees: bool,
}
