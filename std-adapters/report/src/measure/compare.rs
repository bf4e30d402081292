//! Error at equal time, time to equal error.

use crate::measure::report::Point;

/// One figure of an estimator as a multiple of plain Monte Carlo's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Versus {
    /// So many times plain Monte Carlo's, with the standard error that the replicates leave.
    Times {
        /// The multiple: below 1 is better than plain.
        ratio: f64,
        /// Its standard error.
        std_error: f64,
    },
    /// At most so many times: fewer draws were not measured.
    AtMost(f64),
    /// The error is rounding alone.
    Exact,
    /// Not with any number of draws.
    Never,
}

impl Versus {
    /// The multiple; 0 where exact, ∞ where never.
    pub fn ratio(self) -> f64 {
        match self {
            Self::Times { ratio, .. } | Self::AtMost(ratio) => ratio,
            Self::Exact => 0.0,
            Self::Never => f64::INFINITY,
        }
    }
}

/// An estimator compared with plain Monte Carlo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equal {
    /// RMSE in the time that plain Monte Carlo takes for the reference draws, over plain's RMSE.
    pub error_at_equal_time: Versus,
    /// Time to the RMSE that plain Monte Carlo has after the reference draws, over plain's time.
    pub time_to_equal_error: Versus,
    /// d log RMSE/d log draws over the larger half of the sizes; −1/2 for what is unbiased.
    pub slope_in_draws: f64,
    /// d log RMSE/d log time over the same.
    pub slope_in_time: f64,
}

/// An RMSE, relative to F, that rounding explains.
const EXACT: f64 = 1e-12;
/// How the error of every consistent estimator falls with many draws, beyond the largest measured.
const SLOPE: f64 = -0.5;

/// (log time, log RMSE, relative standard error of the RMSE).
type Place = (f64, f64, f64);

fn place(point: &Point) -> Place {
    let figures = &point.relative;
    (libm::log(point.seconds.median), libm::log(figures.mse) / 2.0, figures.mse_std_error / figures.mse / 2.0)
}

/// `points` against plain's at index `reference`; `consistent` if more draws always help.
pub(super) fn compare(points: &[Point], plain: &[Point], reference: usize, consistent: bool) -> Equal {
    let (time, error, noise) = place(&plain[reference]);
    let exact = points.iter().skip(reference).all(|point| point.relative.rmse() <= EXACT);
    let places: Vec<Place> = points.iter().map(place).collect();
    let upper = points.len() / 2;
    let slope = |x: &dyn Fn(usize) -> f64| {
        if exact { f64::NAN } else { least_squares((upper..points.len()).map(|i| (x(i), places[i].1))) }
    };
    let times = |log_ratio: f64, relative: f64| {
        let ratio = libm::exp(log_ratio);
        Versus::Times { ratio, std_error: ratio * relative }
    };
    let error_at_equal_time = if exact {
        Versus::Exact
    } else {
        let (log_error, own) = error_at(&places, time, consistent);
        times(log_error - error, libm::hypot(own, noise))
    };
    let time_to_equal_error = match time_to(&places, error, consistent) {
        Reached::Before => Versus::AtMost(libm::exp(places[0].0 - time)),
        // An error that falls as the root of time turns a relative error into twice as much time.
        Reached::At(log_time, own) => times(log_time - time, 2.0 * libm::hypot(own, noise)),
        Reached::Never => Versus::Never,
    };
    Equal {
        error_at_equal_time,
        time_to_equal_error,
        slope_in_draws: slope(&|i| libm::log(points[i].draws as f64)),
        slope_in_time: slope(&|i| places[i].0),
    }
}

/// Log RMSE at log time `time`, and its relative standard error.
fn error_at(places: &[Place], time: f64, consistent: bool) -> (f64, f64) {
    let (first, last) = (places[0], places[places.len() - 1]);
    if time <= first.0 {
        return (first.1 + SLOPE * (time - first.0), first.2);
    }
    match places.windows(2).find(|pair| time <= pair[1].0) {
        Some(pair) => {
            let share = (time - pair[0].0) / (pair[1].0 - pair[0].0);
            (pair[0].1 + share * (pair[1].1 - pair[0].1), pair[1].2)
        }
        None => (last.1 + if consistent { SLOPE * (time - last.0) } else { 0.0 }, last.2),
    }
}

enum Reached {
    Before,
    At(f64, f64),
    Never,
}

/// Log time at which log RMSE falls to `error`.
fn time_to(places: &[Place], error: f64, consistent: bool) -> Reached {
    let Some(index) = places.iter().position(|place| place.1 <= error) else {
        let last = places[places.len() - 1];
        return if consistent { Reached::At(last.0 + (error - last.1) / SLOPE, last.2) } else { Reached::Never };
    };
    if index == 0 {
        return if places[0].1 == error { Reached::At(places[0].0, places[0].2) } else { Reached::Before };
    }
    let (before, after) = (places[index - 1], places[index]);
    if after.1 == f64::NEG_INFINITY {
        return Reached::At(after.0, after.2);
    }
    let share = (before.1 - error) / (before.1 - after.1);
    Reached::At(before.0 + share * (after.0 - before.0), after.2)
}

/// The slope of the straight line through `points`.
fn least_squares(points: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let n = points.clone().count() as f64;
    let (x, y) = points.clone().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let (xy, xx) = points.fold((0.0, 0.0), |(xy, xx), point| {
        let x = point.0 - x;
        (xy + x * (point.1 - y), xx + x * x)
    });
    xy / xx
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::report::{Figures, Seconds};
    use ratiocv_core::predict::Prediction;

    /// Points whose RMSE is `error(N)`, at `cost` seconds per draw.
    fn points(cost: f64, error: impl Fn(f64) -> f64) -> Vec<Point> {
        let point = |power| {
            let (draws, rmse) = (1_u64 << power, error(f64::from(1 << power)));
            let (seconds, unknown) = (cost * draws as f64, Prediction { bias: f64::NAN, mse: f64::NAN });
            Point {
                draws,
                replicates: 100,
                relative: Figures {
                    bias: 0.0,
                    bias_std_error: 0.0,
                    mse: rmse * rmse,
                    mse_std_error: 0.0,
                    predicted: unknown,
                    first_order: unknown,
                },
                channels: vec![],
                coverage: None,
                seconds: Seconds { median: seconds, lower: seconds, upper: seconds },
            }
        };
        (1..=12).map(point).collect()
    }

    fn is(versus: Versus, right: f64) {
        let Versus::Times { ratio, .. } = versus else { panic!("{versus:?} instead of {right}") };
        assert!((ratio / right - 1.0).abs() <= 1e-9, "{ratio} instead of {right}");
    }

    #[test]
    fn half_the_error_for_twice_the_time_per_draw() {
        let plain = points(1.0, |n| 1.0 / n.sqrt());
        let other = compare(&points(2.0, |n| 0.5 / n.sqrt()), &plain, 9, true);
        is(other.error_at_equal_time, 0.5 * 2.0_f64.sqrt());
        is(other.time_to_equal_error, 0.5);
        assert!((other.slope_in_draws + 0.5).abs() <= 1e-12 && (other.slope_in_time + 0.5).abs() <= 1e-12);
        let itself = compare(&plain, &plain, 9, true);
        is(itself.error_at_equal_time, 1.0);
        is(itself.time_to_equal_error, 1.0);
    }

    #[test]
    fn what_lies_beyond_the_measured_sizes_is_extrapolated() {
        let plain = points(1.0, |n| 1.0 / n.sqrt());
        is(compare(&points(1.0, |n| 3.0 / n.sqrt()), &plain, 9, true).time_to_equal_error, 9.0);
        let quick = compare(&points(1.0, |n| 0.01 / n.sqrt()), &plain, 9, true);
        assert!(matches!(quick.time_to_equal_error, Versus::AtMost(ratio) if ratio == 2.0 / 1024.0));
    }

    #[test]
    fn an_error_that_stays_is_never_made_good() {
        let plain = points(1.0, |n| 1.0 / n.sqrt());
        let stuck = compare(&points(1.0, |n| (0.04 + 0.1 / n).sqrt()), &plain, 9, false);
        assert_eq!(stuck.time_to_equal_error, Versus::Never);
        let exact = compare(&points(1.0, |_| 1e-16), &plain, 9, true);
        assert_eq!(exact.error_at_equal_time, Versus::Exact);
        let zero = compare(&points(1.0, |_| 0.0), &plain, 9, true);
        assert_eq!(zero.error_at_equal_time, Versus::Exact);
    }
}
