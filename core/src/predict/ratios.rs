//! Plain Monte Carlo, and ratios on one auxiliary.

use crate::estimator::{
    Beale, Defensive, HartleyRoss, Jackknife, MeanOfRatios, Mickey, Plain, Quenouille, RatioOfMeans, Tin,
};
use crate::planted::planted;
use crate::predict::{Order, Population, Predict, Prediction};

/// `first`/N + `second`/N².
fn expansion(first: f64, second: f64, draws: u64, order: Order) -> f64 {
    let n = draws as f64;
    match order {
        Order::First => first / n,
        Order::Second => first / n + second / n / n,
    }
}

/// An estimator with the ratio's first-order MSE, whose bias starts at 1/N² with `bias`.
fn almost_unbiased(population: &Population, bias: f64, mse: f64, draws: u64, order: Order) -> Prediction {
    Prediction { bias: expansion(0.0, bias, draws, order), mse: expansion(population.v(), mse, draws, order) }
}

impl Predict for Plain {
    /// Bias 0, MSE Var(y)/N: exact.
    fn predict(&self, population: &Population, draws: u64, _: Order) -> Prediction {
        Prediction { bias: 0.0, mse: population.ff_c02 / draws as f64 }
    }
}

impl Predict for RatioOfMeans {
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        let Population { f, c20, f_c11, ff_c02, .. } = *p;
        let second = 3.0 * ff_c02 * c20 + 6.0 * f_c11 * f_c11 - 18.0 * f * f_c11 * c20 + 9.0 * f * f * c20 * c20
            - 2.0 * p.ff_c12
            + 4.0 * f * p.f_c21
            - 2.0 * f * f * p.c30;
        Prediction {
            bias: expansion(p.a(), p.d() + 3.0 * p.s(), draws, order),
            mse: expansion(p.v(), second, draws, order),
        }
    }
}

impl Predict for Quenouille {
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        // The seed prints +6S for −6S.
        let bias = planted!("predict_quenouille": -2.0 * (p.d() + 3.0 * p.s()), -2.0 * (p.d() - 3.0 * p.s()));
        almost_unbiased(p, bias, 2.0 * p.second_mse(), draws, order)
    }
}

impl Predict for Beale {
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        almost_unbiased(p, -2.0 * (p.d() + p.s()), p.second_mse(), draws, order)
    }
}

impl Predict for Tin {
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        almost_unbiased(p, -(2.0 * p.d() + 3.0 * p.s()), p.second_mse(), draws, order)
    }
}

impl Predict for MeanOfRatios {
    /// Bias −Cov(r, x), MSE H²Var(r)/N + Cov(r, x)²: exact.
    fn predict(&self, p: &Population, draws: u64, _: Order) -> Prediction {
        let bias = p.h * p.ratio.mean - p.f;
        Prediction { bias, mse: p.h * p.h * p.ratio.variance / draws as f64 + bias * bias }
    }
}

impl Predict for HartleyRoss {
    /// Bias 0, MSE Var(y − ρx)/N + \[Var r·Var x + Cov(r, x)²\]/(N(N−1)): exact to second order.
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        // The seed gives it the ratio's MSE, with R for ρ.
        let (n, c) = (draws as f64, planted!("predict_hartley_ross": p.h * p.ratio.mean, p.f));
        let covariance = p.f - c;
        let first = p.ff_c02 - 2.0 * c * p.f_c11 + c * c * p.c20;
        let second = p.h * p.h * p.ratio.variance * p.c20 + covariance * covariance;
        let second = match order {
            Order::First => 0.0,
            Order::Second if draws < 2 => f64::NAN,
            Order::Second => second / (n - 1.0),
        };
        Prediction { bias: 0.0, mse: (first + second) / n }
    }
}

impl Predict for Mickey {
    /// Bias 0; for 8 groups, or leave-one-out below 8 draws.
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        let groups = if draws < 2 { f64::NAN } else { draws.min(8) as f64 };
        let e = p.a();
        let second = groups / (groups - 1.0) * (p.c20 * p.v() + 3.0 * e * e);
        Prediction { bias: 0.0, mse: expansion(p.v(), second, draws, order) }
    }
}

impl Predict for Jackknife {
    /// For 8 groups, or one per draw below 8 draws.
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        let groups = if draws < 2 { f64::NAN } else { draws.min(8) as f64 };
        let (factor, e) = (groups / (groups - 1.0), p.a());
        almost_unbiased(p, -factor * (p.d() + 3.0 * p.s()), factor * (p.c20 * p.v() + e * e), draws, order)
    }
}

impl<E: Predict> Predict for Defensive<E> {
    fn predict(&self, population: &Population, draws: u64, order: Order) -> Prediction {
        self.estimator.predict(&population.on_defensive(self.weight), draws, order)
    }
}
