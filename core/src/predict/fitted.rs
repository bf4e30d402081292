//! Coefficients that are given or fitted, and choices among estimators.

use crate::estimator::{
    Choose, CrossFitted, Difference, Fixed, OptimalDefensive, Plain, RatioOfMeans, RegressionRatio,
};
use crate::planted::planted;
use crate::predict::{Order, Population, Predict, Prediction};

/// What one fitted coefficient costs: the factor (n − 2)/(n − 3) of a regression on n Gaussian draws
/// (Lavenberg and Welch 1981), taken for the second order of all laws.
fn fitted(variance: f64, draws: u64, parts: u64, order: Order) -> f64 {
    let n = (draws / parts) as f64;
    let factor = match order {
        Order::First => 1.0,
        Order::Second if n <= 3.0 => f64::NAN,
        Order::Second => (n - 2.0) / (n - 3.0),
    };
    variance / draws as f64 * factor
}

impl Predict for Difference {
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        Prediction {
            bias: planted!("predict_fitting_bias": p.fitting_bias(), 0.0) / draws as f64,
            mse: fitted(p.v_least(), draws, 1, order),
        }
    }
}

impl Predict for CrossFitted<Difference> {
    /// Bias 0; each half of the draws with a coefficient from the other half.
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        Prediction { bias: 0.0, mse: fitted(p.v_least(), draws, 2, order) }
    }
}

impl Predict for Fixed<RegressionRatio, f64> {
    /// For the α given, to first order.
    fn predict(&self, p: &Population, draws: u64, _: Order) -> Prediction {
        let [alpha] = self.coefficients;
        let bias = alpha * (planted!("predict_alpha": alpha + 1.0, alpha) / 2.0 * p.f * p.c20 - p.f_c11);
        Prediction { bias: bias / draws as f64, mse: p.v_at(alpha) / draws as f64 }
    }
}

impl Predict for RegressionRatio {
    /// With α learned from the draws; where the clamp acts, that of the clamped α.
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        let (alpha, (least, greatest)) = (p.best_alpha(), self.clamp);
        if alpha < least || alpha > greatest {
            let clamped = if alpha < least { least } else { greatest };
            return self.fixed([clamped]).predict(p, draws, order);
        }
        let curvature = p.f * alpha * (alpha - 1.0) / 2.0 * p.c20;
        // What is left where f is affine in h, and the power is not: (F̂ − F)² is that of a square of x̄ − H,
        // of fourth moment 3(C20/N)².
        let left = match order {
            Order::First => 0.0,
            Order::Second => 3.0 * curvature * curvature / draws as f64 / draws as f64,
        };
        Prediction {
            bias: (p.fitting_bias() + curvature) / draws as f64,
            mse: fitted(p.v_least(), draws, 1, order) + left,
        }
    }
}

impl<E: Predict> Predict for OptimalDefensive<E> {
    /// To first order; where a is clamped, that of `E` with the clamped weight.
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        let (alpha, most) = (p.best_alpha(), 1.0 - self.floor);
        if alpha < 0.0 || alpha > most {
            let clamped = if alpha < 0.0 { 0.0 } else { most };
            return self.estimator.predict(&p.on_defensive(1.0 - clamped), draws, order);
        }
        Prediction { bias: p.fitting_bias() / draws as f64, mse: fitted(p.v_least(), draws, 1, order) }
    }
}

impl Predict for Choose {
    /// That of the best of plain, ratio and difference.
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        let mut best = Plain.predict(p, draws, order);
        for other in [RatioOfMeans.predict(p, draws, order), Difference::default().predict(p, draws, order)] {
            if other.mse < best.mse {
                best = other;
            }
        }
        best
    }
}

impl Predict for CrossFitted<Choose> {
    /// Bias 0; the least of the first-order errors, with what fitting costs.
    fn predict(&self, p: &Population, draws: u64, order: Order) -> Prediction {
        let given = p.v_at(0.0).min(p.v()) / draws as f64;
        let own = fitted(p.v_least(), draws, 2, order);
        Prediction { bias: 0.0, mse: if own < given { own } else { given } }
    }
}
