//! Population moments of discrete laws, summed point by point.

use crate::golden::Point;
use crate::sum::Sum;
use ratiocv_core::predict::{Population, RatioPopulation};

/// E\[q\] over the points of a law.
pub fn expectation(support: &[Point], q: impl Fn(f64, f64) -> f64) -> f64 {
    let mut sum = Sum::default();
    for point in support {
        sum.add(point.p * q(point.y, point.x[0]));
    }
    sum.value()
}

/// The moments that predictions read, on the raw auxiliary and on that of weight `weight`.
pub fn population(support: &[Point], weight: f64) -> Population {
    let f = expectation(support, |y, _| y);
    let h = expectation(support, |_, x| x);
    let c = |i: i32, j: i32| expectation(support, |y, x| (x / h - 1.0).powi(i) * (y - f).powi(j));
    let ratio = |weight: f64| {
        let r = |y: f64, x: f64| y / (weight * h + (1.0 - weight) * x);
        let mean = expectation(support, r);
        RatioPopulation { mean, variance: expectation(support, |y, x| (r(y, x) - mean).powi(2)) }
    };
    Population {
        f,
        h,
        c20: c(2, 0),
        f_c11: c(1, 1),
        ff_c02: c(0, 2),
        c30: c(3, 0),
        f_c21: c(2, 1),
        ff_c12: c(1, 2),
        ratio: ratio(0.0),
        defended: (weight, ratio(weight)),
    }
}
