//! Fitted coefficients by their definition: sums over the draws' deviations from 1e9, which are exact.

use crate::ladder::mean_deviations;

/// Means (less 1e9) and sums of squares and products about them.
struct Sums {
    n: f64,
    f: f64,
    h: f64,
    ff: f64,
    fh: f64,
    hh: f64,
}

fn sums(draws: &[(f64, f64)]) -> Sums {
    let (f, h) = mean_deviations(draws);
    let sum =
        |product: &dyn Fn(f64, f64) -> f64| draws.iter().map(|d| product(d.0 - 1e9 - f, d.1 - 1e9 - h)).sum::<f64>();
    Sums { n: draws.len() as f64, f, h, ff: sum(&|f, _| f * f), fh: sum(&|f, h| f * h), hh: sum(&|_, h| h * h) }
}

impl Sums {
    /// β̂ = s_xy/s_xx, shrunk by 1 less the reciprocal of its F statistic.
    fn beta(&self) -> f64 {
        let beta = self.fh / self.hh;
        let noise = (self.ff - beta * self.fh) / (self.n - 2.0);
        assert!(noise < beta * self.fh, "draws that h explains");
        beta * (1.0 - noise / (beta * self.fh))
    }

    /// Σ((f − f̄) − c(h − h̄))².
    fn about(&self, c: f64) -> f64 {
        self.ff - 2.0 * c * self.fh + c * c * self.hh
    }
}

/// Value and error of ȳ + β̂(H − x̄), s² with N − 2 degrees of freedom: s²(1/N + (H − x̄)²/Σ(x − x̄)²). At 1e9
/// α̂ = β̂x̄/ȳ and β̂ are the same but for 1e-8, and so are all estimators with fitted coefficients.
pub(crate) fn difference_at_1e9(draws: &[(f64, f64)], integral: f64) -> (f64, f64) {
    let s = sums(draws);
    let (beta, apart) = (s.beta(), integral - 1e9 - s.h);
    let variance = s.about(beta) / (s.n - 2.0) * (1.0 / s.n + apart * apart / s.hh);
    (1e9 + (s.f + beta * apart), variance.sqrt())
}

/// The same in two folds, each with the β̂ of the other, which costs it nothing.
pub(crate) fn cross_fitted_at_1e9(draws: &[(f64, f64)], integral: f64) -> (f64, f64) {
    let fold = |fold: usize| sums(&draws.iter().skip(fold).step_by(2).copied().collect::<Vec<_>>());
    let (mut value, mut variance) = (1e9, 0.0);
    for one in [0, 1] {
        let (own, beta) = (fold(one), fold(1 - one).beta());
        let share = own.n / draws.len() as f64;
        value += share * (own.f + beta * (integral - 1e9 - own.h));
        variance += share * share * own.about(beta) / (own.n - 1.0) / own.n;
    }
    (value, variance.sqrt())
}
