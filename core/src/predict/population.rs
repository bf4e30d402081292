//! The moments of a law that predictions are made from.

use crate::moments::{HasComoments, HasRatioMean, HasThirdMoments, Means};

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
    pub(super) fn a(&self) -> f64 {
        self.f * self.c20 - self.f_c11
    }

    /// F·D = F(C21 − C30).
    pub(super) fn d(&self) -> f64 {
        self.f_c21 - self.f * self.c30
    }

    /// F·S = F·C20(C20 − C11).
    pub(super) fn s(&self) -> f64 {
        self.c20 * self.a()
    }

    /// F²V = F²(C20 + C02 − 2C11) = Var(y − R·x): the first-order MSE of every ratio, times N.
    pub(super) fn v(&self) -> f64 {
        let v = self.f * self.f * self.c20 + self.ff_c02 - 2.0 * self.f * self.f_c11;
        // For f ∝ h it is rounding noise, of either sign.
        if v < 0.0 { 0.0 } else { v }
    }

    /// Var(y − c·x) for c = `alpha`·R: the first-order MSE, times N, of whatever has that coefficient.
    pub(super) fn v_at(&self, alpha: f64) -> f64 {
        let c = alpha * self.f;
        let v = self.ff_c02 + c * (c * self.c20 - 2.0 * self.f_c11);
        if v < 0.0 { 0.0 } else { v }
    }

    /// Var(y − β*x), the least of all; plain's where h is constant.
    pub(super) fn v_least(&self) -> f64 {
        let explained = self.f_c11 * (self.f_c11 / self.c20);
        let v = if self.c20 == 0.0 { self.ff_c02 } else { self.ff_c02 - explained };
        if v < 0.0 { 0.0 } else { v }
    }

    /// α* = C11/C20, the best multiple of R.
    pub(super) fn best_alpha(&self) -> f64 {
        if self.f_c11 == 0.0 { 0.0 } else { self.f_c11 / self.c20 / self.f }
    }

    /// −F(C21 − aC30)/C20 with a = C11/C20: the bias, times N, of β̂ fitted to the draws that it serves.
    pub(super) fn fitting_bias(&self) -> f64 {
        if self.c20 == 0.0 { 0.0 } else { (self.f_c11 / self.c20 * self.c30 - self.f_c21) / self.c20 }
    }

    /// The 1/N² coefficient of the MSE of Beale and Tin: F²\[C02C20 + C11² − 4C11C20 + 2C20²\].
    pub(super) fn second_mse(&self) -> f64 {
        let Self { f, c20, f_c11, ff_c02, .. } = *self;
        ff_c02 * c20 + f_c11 * f_c11 - 4.0 * f * f_c11 * c20 + 2.0 * f * f * c20 * c20
    }
}
