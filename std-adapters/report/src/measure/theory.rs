//! What theory expects, and whether it came out so.

use crate::catalogue::Method;
use crate::measure::report::{Figures, Point, Theory};
use crate::measure::tally::Average;
use ratiocv_core::predict::{Order, Population, Prediction};

/// Predictions from populations that were integrated numerically carry rounding of about this, relative to
/// the variance that cancels in them.
pub(super) const ROUNDING: f64 = 1e-11;

/// Bias over F and MSE over F² of `method` in a channel of the population.
fn relative(method: Method, weight: f64, population: &Population, draws: u64, order: Order) -> Prediction {
    let Prediction { bias, mse } = method.predict(weight, population, draws, order);
    Prediction { bias: bias / population.f, mse: mse / (population.f * population.f) }
}

/// Both orders, of each channel.
pub(super) fn predictions(
    method: Method,
    weight: f64,
    populations: &[Population],
    draws: u64,
) -> Vec<(Prediction, Prediction)> {
    let of = |population, order| relative(method, weight, population, draws, order);
    populations.iter().map(|population| (of(population, Order::First), of(population, Order::Second))).collect()
}

/// Mean over channels.
pub(super) fn mean(channels: &[(Prediction, Prediction)]) -> (Prediction, Prediction) {
    let n = channels.len() as f64;
    let mean = |get: &dyn Fn(&(Prediction, Prediction)) -> f64| channels.iter().map(get).sum::<f64>() / n;
    (
        Prediction { bias: mean(&|(first, _)| first.bias), mse: mean(&|(first, _)| first.mse) },
        Prediction { bias: mean(&|(_, second)| second.bias), mse: mean(&|(_, second)| second.mse) },
    )
}

/// Measured beside predicted.
pub(super) fn figures((bias, mse): (Average, Average), (first, second): (Prediction, Prediction)) -> Figures {
    Figures {
        bias: bias.mean,
        bias_std_error: bias.std_error,
        mse: mse.mean,
        mse_std_error: mse.std_error,
        predicted: second,
        first_order: first,
    }
}

/// Whether `point`, with the most draws, has the predicted MSE, where plain Monte Carlo's is `plain`.
///
/// Four standard errors are chance, for any number of estimators that a report holds; the last term of
/// the expansion is a measure of those that were left out.
pub(super) fn judge(point: &Point, plain: f64) -> Theory {
    let Figures { mse, mse_std_error, predicted, first_order, .. } = point.relative;
    let off = mse - predicted.mse;
    let allowed = 4.0 * mse_std_error + libm::fabs(predicted.mse - first_order.mse) + ROUNDING * plain;
    let deviation = if libm::fabs(off) <= ROUNDING * plain { 0.0 } else { off / mse_std_error };
    Theory { deviation, agrees: libm::fabs(off) <= allowed }
}
