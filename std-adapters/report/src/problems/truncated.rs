//! Densities on [0, 1] with closed-form distribution functions.

/// λe^(−λx)/(1 − e^(−λ)): the exponential distribution, cut off at 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct TruncatedExponential {
    rate: f64,
    /// 1 − e^(−λ): how much of the distribution lies below 1.
    mass: f64,
}

impl TruncatedExponential {
    pub(super) fn new(rate: f64) -> Self {
        Self { rate, mass: -libm::expm1(-rate) }
    }

    pub(super) fn pdf(&self, x: f64) -> f64 {
        self.rate * libm::exp(-self.rate * x) / self.mass
    }

    /// The point below which a share `u` of the distribution lies.
    pub(super) fn quantile(&self, u: f64) -> f64 {
        -libm::log1p(-u * self.mass) / self.rate
    }

    /// ∫pdf(x) cos(ωx) dx, for ω a multiple of 2π.
    pub(super) fn cosine(&self, omega: f64) -> f64 {
        self.rate * self.rate / (self.rate * self.rate + omega * omega)
    }
}

/// The logistic distribution about `centre`, cut off at 0 and 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct TruncatedLogistic {
    centre: f64,
    scale: f64,
    /// The untruncated distribution function at 0, and what of it lies in [0, 1].
    below: f64,
    mass: f64,
}

impl TruncatedLogistic {
    pub(super) fn new(centre: f64, scale: f64) -> Self {
        let distribution = |x: f64| 1.0 / (1.0 + libm::exp((centre - x) / scale));
        let below = distribution(0.0);
        Self { centre, scale, below, mass: distribution(1.0) - below }
    }

    pub(super) fn pdf(&self, x: f64) -> f64 {
        // e^−|z|: neither side overflows.
        let e = libm::exp(-libm::fabs(x - self.centre) / self.scale);
        e / ((1.0 + e) * (1.0 + e) * self.scale * self.mass)
    }

    /// The point below which a share `u` of the distribution lies.
    pub(super) fn quantile(&self, u: f64) -> f64 {
        let p = self.below + u * self.mass;
        self.centre + self.scale * libm::log(p / (1.0 - p))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫pdf below the quantile of u is u, by the midpoint rule.
    fn check(pdf: impl Fn(f64) -> f64, quantile: impl Fn(f64) -> f64) {
        for u in [0.0, 0.1, 0.5, 0.9, 1.0] {
            let (end, steps) = (quantile(u), 20_000);
            let step = end / f64::from(steps);
            let mass: f64 = (0..steps).map(|i| pdf((f64::from(i) + 0.5) * step) * step).sum();
            assert!((mass - u).abs() <= 1e-6, "{mass} below the quantile of {u}");
        }
    }

    #[test]
    fn quantiles_invert_the_distribution_functions() {
        let exponential = TruncatedExponential::new(6.0);
        check(|x| exponential.pdf(x), |u| exponential.quantile(u));
        let logistic = TruncatedLogistic::new(0.7, 0.055);
        check(|x| logistic.pdf(x), |u| logistic.quantile(u));
    }
}
