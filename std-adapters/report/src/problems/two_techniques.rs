//! A sum of two peaks, two techniques, and an auxiliary for each.

use crate::problems::truncated::TruncatedLogistic;
use core::f64::consts::PI;

/// f = 0.7 h₁(1 + 0.3 cos 10πx) + 0.2 h₂(1 + 0.3 sin 8πx) + 0.1 (1 − cos 2πx) on [0, 1]: the auxiliaries h₁ and
/// h₂ are logistic densities about 0.3 and 0.7, each like f in its own part. The techniques draw from wider
/// ones, g₁ about 0.3 and g₂ about 0.6.
///
/// Not a [`Solved`](crate::problems::Solved): that has one auxiliary and one proposal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TwoTechniques {
    auxiliaries: [TruncatedLogistic; 2],
    techniques: [TruncatedLogistic; 2],
}

/// Everything there is to know at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Functions {
    pub(crate) f: f64,
    pub(crate) h: [f64; 2],
    pub(crate) g: [f64; 2],
}

impl TwoTechniques {
    pub(crate) fn new() -> Self {
        let logistic = TruncatedLogistic::new;
        Self {
            auxiliaries: [logistic(0.3, 0.05), logistic(0.7, 0.07)],
            techniques: [logistic(0.3, 0.1), logistic(0.6, 0.15)],
        }
    }

    pub(crate) fn at(&self, x: f64) -> Functions {
        let [h1, h2] = self.auxiliaries.map(|h| h.pdf(x));
        let first = 0.7 * h1 * (1.0 + 0.3 * libm::cos(10.0 * PI * x));
        let second = 0.2 * h2 * (1.0 + 0.3 * libm::sin(8.0 * PI * x));
        let rest = 0.1 * (1.0 - libm::cos(2.0 * PI * x));
        Functions { f: first + second + rest, h: [h1, h2], g: self.techniques.map(|g| g.pdf(x)) }
    }

    /// The point that the uniform number `u` draws from technique `k`.
    pub(crate) fn draw(&self, k: usize, u: f64) -> f64 {
        self.techniques[k].quantile(u)
    }

    /// ∫`function`, by the midpoint rule: ∫f to 3·10⁻⁹.
    pub(crate) fn integral(&self, function: impl Fn(&Functions) -> f64) -> f64 {
        self.cells().map(|(volume, at)| volume * function(&at)).sum()
    }

    /// The cells of that rule: volume, and the functions in it.
    pub(crate) fn cells(&self) -> impl Iterator<Item = (f64, Functions)> {
        const CELLS: u32 = 1 << 12;
        let width = 1.0 / f64::from(CELLS);
        (0..CELLS).map(move |i| (width, self.at((f64::from(i) + 0.5) * width)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_have_the_integral_one_and_the_rule_is_fine_enough() {
        let problem = TwoTechniques::new();
        for k in 0..2 {
            assert!(libm::fabs(problem.integral(|at| at.h[k]) - 1.0) <= 1e-6);
            assert!(libm::fabs(problem.integral(|at| at.g[k]) - 1.0) <= 1e-6);
        }
        // SciPy 1.17.1, quad(f, 0, 1).
        let f = problem.integral(|at| at.f);
        assert!(libm::fabs(f - 0.982_009_733_5) <= 1e-6, "{f}");
    }
}
