//! Estimators by kind.

/// Estimators by kind: what tables set side by side, in their order.
///
/// ```
/// use ratiocv_report::{Group, catalogue::Method};
/// assert_eq!(Method::from_id("defensive_mickey").map(Method::group), Some(Group::Unbiased));
/// assert!(Group::Plain < Group::Ratio);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Group {
    /// Plain Monte Carlo.
    Plain,
    /// The ratio of means and its relatives, whose bias is to vanish with many draws.
    Ratio,
    /// Ratios whose expectation is F for every number of draws.
    Unbiased,
    /// Coefficients fitted to the draws: regressions and differences.
    Fitted,
    /// Those that choose among others.
    Chooser,
}

impl Group {
    /// Every group, in order.
    pub const ALL: [Self; 5] = [Self::Plain, Self::Ratio, Self::Unbiased, Self::Fitted, Self::Chooser];

    /// Its name in headings.
    pub fn title(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Ratio => "ratio family",
            Self::Unbiased => "unbiased",
            Self::Fitted => "regression and difference",
            Self::Chooser => "choosers",
        }
    }
}
