//! Bias and mean squared error of each estimator, from the moments of the draws' law.
//!
//! To first and to second order in 1/N (Tin 1965, with the seed's misprints put right); exact for
//! plain Monte Carlo, the mean of ratios and Hartley–Ross.

use crate::estimator::{
    Beale, Choose, CrossFitted, Defensive, Difference, Fixed, HartleyRoss, Jackknife, MeanOfRatios, Mickey,
    OptimalDefensive, Plain, Quenouille, RatioOfMeans, RegressionRatio, Tin,
};
use crate::moments::{HasComoments, HasRatioMean, HasThirdMoments, Means};
use crate::planted::planted;

/// Moments of one channel of the law of a draw (y, x), x in units of its integral H.
///
/// Of the law itself, or, with [`from_sample`](Population::from_sample), estimated from draws. What
/// is not known is NaN, and every prediction that reads it is NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Population {
    /// F = E\[y\].
    pub f: f64,
    /// H = E\[x\].
    pub h: f64,
    /// E\[(x/H − 1)²\].
    pub c20: f64,
    /// E\[(x/H − 1)(y − F)\]: F·C11, defined for F = 0 too.
    pub f_c11: f64,
    /// E\[(y − F)²\]: F²·C02.
    pub ff_c02: f64,
    /// E\[(x/H − 1)³\].
    pub c30: f64,
    /// E\[(x/H − 1)²(y − F)\]: F·C21.
    pub f_c21: f64,
    /// E\[(x/H − 1)(y − F)²\]: F²·C12.
    pub ff_c12: f64,
    /// Mean and variance of r = y/x on the raw auxiliary.
    pub ratio: RatioPopulation,
    /// Mean and variance of y/x′ on a defensive auxiliary, with its weight.
    pub defended: (f64, RatioPopulation),
}

/// Moments of r = y/x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RatioPopulation {
    /// ρ = E\[r\].
    pub mean: f64,
    /// Var(r).
    pub variance: f64,
}

impl RatioPopulation {
    /// Not known.
    pub const UNKNOWN: Self = Self { mean: f64::NAN, variance: f64::NAN };
}

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

impl Population {
    /// The moments that a sample of `count` draws suggests for auxiliary integral `integral`, with
    /// the ratios on the raw auxiliary and on that of defensive weight `weight`.
    ///
    /// The auxiliary is taken in units of its sample mean, not of H: otherwise the noise of h̄, which
    /// a ratio takes out, would be counted against it, and f = 2h would seem to have an error.
    /// Covariances have the divisor N − 1; third moments N, and are biased by O(1/N). Below 2 draws,
    /// or where h̄ = 0, everything but `f` and `h` is NaN or infinite.
    pub fn from_sample<S>(moments: &S, count: u64, integral: f64, weight: f64) -> Self
    where
        S: HasComoments + HasRatioMean + HasThirdMoments,
    {
        let n = count as f64;
        let divisor = if count < 2 { f64::NAN } else { n - 1.0 };
        let Means { f, h: [h] } = moments.means(count);
        let ratio = |weight: f64| {
            let unit = (weight * integral + (1.0 - weight) * h) / integral;
            moments.ratio(weight, integral).map_or(RatioPopulation::UNKNOWN, |ratio| RatioPopulation {
                mean: unit * ratio.mean,
                variance: ratio.squares.map_or(f64::NAN, |squares| unit * unit * squares / divisor),
            })
        };
        let (spread, third) = (moments.comoments(), moments.third());
        Self {
            f,
            h: integral,
            c20: spread.hh[0][0] / divisor / h / h,
            f_c11: spread.fh(0) / divisor / h,
            ff_c02: spread.ff() / divisor,
            c30: third.hhh / n / h / h / h,
            f_c21: third.hhf / n / h / h,
            ff_c12: third.hff / n / h,
            ratio: ratio(0.0),
            defended: (weight, ratio(weight)),
        }
    }

    /// The law of (y, x′) with x′ = εH + (1−ε)x.
    pub fn on_defensive(&self, weight: f64) -> Self {
        let scale = 1.0 - weight;
        let (known, ratio) = self.defended;
        let ratio = if weight == known { ratio } else { RatioPopulation::UNKNOWN };
        Self {
            c20: scale * scale * self.c20,
            f_c11: scale * self.f_c11,
            c30: scale * scale * scale * self.c30,
            f_c21: scale * scale * self.f_c21,
            ff_c12: scale * self.ff_c12,
            ratio,
            ..*self
        }
    }

    /// F·A = F(C20 − C11): the first-order bias of the ratio of means, times N.
    fn a(&self) -> f64 {
        self.f * self.c20 - self.f_c11
    }

    /// F·D = F(C21 − C30).
    fn d(&self) -> f64 {
        self.f_c21 - self.f * self.c30
    }

    /// F·S = F·C20(C20 − C11).
    fn s(&self) -> f64 {
        self.c20 * self.a()
    }

    /// F²V = F²(C20 + C02 − 2C11) = Var(y − R·x): the first-order MSE of every ratio, times N.
    fn v(&self) -> f64 {
        let v = self.f * self.f * self.c20 + self.ff_c02 - 2.0 * self.f * self.f_c11;
        // For f ∝ h it is rounding noise, of either sign.
        if v < 0.0 { 0.0 } else { v }
    }

    /// Var(y − c·x) for c = `alpha`·R: the first-order MSE, times N, of whatever has that coefficient.
    fn v_at(&self, alpha: f64) -> f64 {
        let c = alpha * self.f;
        let v = self.ff_c02 + c * (c * self.c20 - 2.0 * self.f_c11);
        if v < 0.0 { 0.0 } else { v }
    }

    /// Var(y − β*x), the least of all; plain's where h is constant.
    fn v_least(&self) -> f64 {
        let explained = self.f_c11 * (self.f_c11 / self.c20);
        let v = if self.c20 == 0.0 { self.ff_c02 } else { self.ff_c02 - explained };
        if v < 0.0 { 0.0 } else { v }
    }

    /// α* = C11/C20, the best multiple of R.
    fn best_alpha(&self) -> f64 {
        if self.f_c11 == 0.0 { 0.0 } else { self.f_c11 / self.c20 / self.f }
    }

    /// −F(C21 − aC30)/C20 with a = C11/C20: the bias, times N, of β̂ fitted to the draws that it serves.
    fn fitting_bias(&self) -> f64 {
        if self.c20 == 0.0 { 0.0 } else { (self.f_c11 / self.c20 * self.c30 - self.f_c21) / self.c20 }
    }

    /// The 1/N² coefficient of the MSE of Beale and Tin: F²\[C02C20 + C11² − 4C11C20 + 2C20²\].
    fn second_mse(&self) -> f64 {
        let Self { f, c20, f_c11, ff_c02, .. } = *self;
        ff_c02 * c20 + f_c11 * f_c11 - 4.0 * f * f_c11 * c20 + 2.0 * f * f * c20 * c20
    }
}

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

impl<E: Predict> Predict for Defensive<E> {
    fn predict(&self, population: &Population, draws: u64, order: Order) -> Prediction {
        self.estimator.predict(&population.on_defensive(self.weight), draws, order)
    }
}
