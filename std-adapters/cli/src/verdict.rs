//! From accumulators to estimates, and to the one that the predictions favour.

use crate::columns::Columns;
use crate::intake::Intake;
use crate::integrals::Known;
use ratiocv_core::moments::Moments;
use ratiocv_core::predict::{Order, Population};
use ratiocv_core::{ChannelEstimate, Estimator, Flags, Integrals, Plain};
use ratiocv_report::catalogue::Method;

/// Everything that there is to print.
#[derive(Debug)]
pub struct Verdict {
    /// The name of the file.
    pub file: String,
    /// How many draws were read.
    pub draws: u64,
    /// How many rows were left out.
    pub skipped: u64,
    /// The channels' names.
    pub channels: Vec<String>,
    /// The known integrals.
    pub integrals: Vec<Known>,
    /// The weight of H in defensive auxiliaries.
    pub weight: f64,
    /// The estimates: by channel, then auxiliary, then estimator.
    pub estimates: Vec<Line>,
}

/// One estimate of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The channel's place in [`Verdict::channels`].
    pub channel: usize,
    /// The estimator.
    pub method: Method,
    /// The auxiliary (`h`, `h2`, …); none for plain Monte Carlo.
    pub auxiliary: Option<String>,
    /// What came out.
    pub estimate: ChannelEstimate,
    /// The MSE that theory expects of this estimator at this number of draws, second order, from the
    /// moments of these draws. NaN where it is not known or its expansion does not hold.
    pub predicted_mse: f64,
}

impl Line {
    /// Whether the prediction is one of the estimator itself, and of known integrals that the draws
    /// do not contradict.
    pub fn is_eligible(&self) -> bool {
        let doubtful = [Flags::DENOM_ILL, Flags::AUX_MISMATCH, Flags::NONFINITE];
        !self.predicted_mse.is_nan()
            && !self.estimate.flags.fell_back()
            && !doubtful.iter().any(|flag| self.estimate.flags.contains(*flag))
    }
}

impl Verdict {
    /// The estimates of `methods` (in the catalogue's order) from what was read.
    pub fn new(
        file: &str,
        columns: &Columns,
        intake: &Intake,
        integrals: Vec<Known>,
        weight: f64,
        methods: &[Method],
    ) -> Self {
        let draws = intake.draws;
        let mut estimates = Vec::new();
        let mut known = integrals.iter();
        for (channel, (plain, auxiliaries)) in intake.closed().iter().enumerate() {
            let of_plain = Plain.estimate_anyway(plain, &Integrals::<f64, 1>::ONE).channel(0);
            // The error bar of the plain mean is its prediction: both are Var(f)/N.
            let plain_mse = of_plain.std_error * of_plain.std_error;
            if methods.contains(&Method::PLAIN) {
                let (method, auxiliary) = (Method::PLAIN, None);
                estimates.push(Line { channel, method, auxiliary, estimate: of_plain, predicted_mse: plain_mse });
            }
            for ((name, _), moments) in columns.channels[channel].auxiliaries.iter().zip(auxiliaries) {
                let Some(Known { value: integral, .. }) = known.next() else { break };
                let population = Population::from_sample(&moments.channel(0), draws, *integral, weight);
                for method in methods.iter().copied().filter(|method| *method != Method::PLAIN) {
                    let estimate = method.estimate(weight, moments, &Integrals::new([*integral])).channel(0);
                    let predicted_mse = method.predict(weight, &population, draws, Order::Second).mse;
                    let predicted_mse = believable(predicted_mse, plain_mse);
                    estimates.push(Line { channel, method, auxiliary: Some(name.clone()), estimate, predicted_mse });
                }
            }
        }
        Self {
            file: file.into(),
            draws,
            skipped: intake.skipped,
            channels: columns.channels.iter().map(|channel| channel.name.clone()).collect(),
            integrals,
            weight,
            estimates,
        }
    }

    /// The estimate of `channel` with the least predicted MSE of a consistent estimator, if any has a
    /// prediction; the first of equals. The mean of ratios is printed but never favoured: more draws
    /// would not mend it.
    pub fn favoured(&self, channel: usize) -> Option<&Line> {
        self.least(channel, Method::is_consistent)
    }

    /// The same among unbiased estimators.
    pub fn favoured_unbiased(&self, channel: usize) -> Option<&Line> {
        self.least(channel, Method::is_unbiased)
    }

    fn least(&self, channel: usize, admits: impl Fn(Method) -> bool) -> Option<&Line> {
        let lines = self.estimates.iter().filter(|line| line.channel == channel && line.is_eligible());
        lines.filter(|line| admits(line.method)).min_by(|a, b| a.predicted_mse.total_cmp(&b.predicted_mse))
    }

    /// The columns whose integral was not given.
    pub fn assumed(&self) -> Vec<&str> {
        self.integrals.iter().filter(|known| known.assumed).map(|known| known.column.as_str()).collect()
    }
}

/// A predicted MSE, or NaN if it is none: a negative sum means that the expansion does not hold at so
/// few draws, unless it is 0 but for rounding.
fn believable(mse: f64, plain_mse: f64) -> f64 {
    if mse.is_infinite() || mse < -1e-12 * plain_mse {
        f64::NAN
    } else if mse < 0.0 {
        0.0
    } else {
        mse
    }
}

#[cfg(test)]
mod tests {
    use super::believable;

    #[test]
    fn negative_predictions_are_none() {
        assert_eq!(believable(0.5, 1.0), 0.5);
        assert_eq!(believable(-1e-17, 1.0), 0.0);
        for none in [-0.1, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            assert!(believable(none, 1.0).is_nan(), "{none}");
        }
    }
}
