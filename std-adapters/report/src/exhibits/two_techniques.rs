//! Two techniques, two auxiliaries, and all ways to put them together.

use crate::exhibits::replicates::average;
use crate::measure::{Options, cell_seed};
use crate::problems::{Functions, TwoTechniques};
use rand_pcg::Pcg64;
use ratiocv_core::moments::{Accumulate, Comoments, ComomentsState, GroupedPairs, Pairs, Sums};
use ratiocv_core::weights::{OptimalWeights, Pilot, PowerHeuristic};
use ratiocv_core::{
    DeterministicMixture, Difference, Draw, Estimator, Integrals, OptimalDefensive, Plain, RandomMixture, RatioOfMeans,
    RegressionRatio, Spectrum, unit_interval,
};

/// MSE at equal numbers of draws, on the scalar f that is 0.7 h₁ and 0.2 h₂ with ripples and a background.
///
/// All draws from the mixture (g₁ + g₂)/2 (shared), or half of them from each technique (separate).
#[derive(Clone, Debug, serde::Serialize)]
pub struct TwoTechniquesMse {
    /// F.
    pub f_integral: f64,
    /// Draws per estimate, ascending.
    pub draws: Vec<u64>,
    /// Independent estimates, for each of [`draws`](Self::draws).
    pub replicates: Vec<u64>,
    /// The estimators, those of shared draws first.
    pub estimators: Vec<Combination>,
    /// (x, f, h₁, h₂, g₁, g₂), to be looked at.
    #[serde(skip)]
    pub curves: Vec<[f64; 6]>,
}

/// One way to use two auxiliaries.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Combination {
    /// Its id.
    pub estimator: &'static str,
    /// What it does.
    pub about: &'static str,
    /// Whether all draws come from the mixture.
    pub shared: bool,
    /// N·MSE/F² as N → ∞, by quadrature.
    pub predicted: f64,
    /// N·MSE/F² and its standard error, for each number of draws.
    pub measured: Vec<(f64, f64)>,
    /// Bias over F and its standard error, for each number of draws.
    pub bias: Vec<(f64, f64)>,
}

/// Draws per estimate.
const DRAWS: [u64; 3] = [16, 64, 256];
/// Draws at each of these.
const TOTAL: u64 = 1 << 20;
const QUICK_TOTAL: u64 = 1 << 18;

/// Id, and what it does: first those of shared draws.
const COMBINATIONS: [(&str, &str); COUNT] = [
    ("mc", "no auxiliary"),
    ("ratio_1", "ratio on h₁ alone"),
    ("ratio_2", "ratio on h₂ alone"),
    ("random_mixture_equal", "ratio on (h₁ + h₂)/2"),
    ("random_mixture", "ratio on the best mixture of h₁ and h₂, weights learned"),
    ("optimal_defensive_ratio", "the same with g as a third: the difference again, unless a weight is clamped"),
    ("deterministic_mixture_balance", "two ratios, f divided by the balance heuristic on h"),
    ("deterministic_mixture_power", "two ratios, f divided by the power heuristic on h"),
    ("multiple_regression_ratio", "product of both ratios, exponents learned"),
    ("difference", "difference control variate, coefficients learned"),
    ("separate_mc_balance", "no auxiliary: multiple importance sampling, balance heuristic"),
    ("separate_balance_on_g", "two ratios, f divided by the balance heuristic on g"),
    ("separate_balance_on_h", "two ratios, f divided by the balance heuristic on h"),
    ("separate_optimal", "two ratios, f divided by the closed-form optimal weights"),
];
const COUNT: usize = 14;
/// How many of them have shared draws.
const SHARED: usize = 10;

/// The weights by which f is divided among the techniques.
#[derive(Clone, Copy, Debug)]
struct Division {
    optimal: OptimalWeights<f64, 2>,
}

impl Division {
    /// w_k by a heuristic on two functions.
    fn by(heuristic: PowerHeuristic, functions: &[f64; 2]) -> [f64; 2] {
        heuristic.weights(&[1.0, 1.0], functions)
    }

    /// u_k = w_k f of each way of separate draws, in the order of the list.
    fn parts(&self, at: &Functions) -> [[f64; 2]; COUNT - SHARED] {
        let on = |functions| Self::by(PowerHeuristic::BALANCE, functions).map(|w| w * at.f);
        [on(&at.g), on(&at.g), on(&at.h), self.optimal.parts(at.f, at.h, at.g)]
    }
}

/// Whether way `way` of separate draws divides by the means of h.
const fn has_ratios(way: usize) -> bool {
    way > 0
}

impl TwoTechniquesMse {
    pub(super) fn measure(options: &Options) -> Self {
        let problem = TwoTechniques::new();
        let exact = problem.integral(|at| at.f);
        let mut pilot = Pilot::new([1.0, 1.0]).unwrap_or_else(|error| panic!("{error}"));
        problem.cells().for_each(|(volume, at)| pilot.add_cell(volume, at.f, at.h, at.g));
        let division = Division { optimal: pilot.optimal() };
        let predicted = predictions(&problem, &division, exact);
        let mut estimators: Vec<Combination> = COMBINATIONS
            .iter()
            .zip(predicted)
            .enumerate()
            .map(|(number, (&(estimator, about), predicted))| Combination {
                estimator,
                about,
                shared: number < SHARED,
                predicted,
                measured: vec![],
                bias: vec![],
            })
            .collect();
        let total = if options.quick { QUICK_TOTAL } else { TOTAL };
        for draws in DRAWS {
            let seed = cell_seed(options.seed, "two-techniques", draws);
            let averages = average(seed, total / draws, |rng| {
                estimates(&problem, &division, draws, rng).map(|value| {
                    let error = value / exact - 1.0;
                    Spectrum([error, draws as f64 * error * error])
                })
            });
            for (combination, average) in estimators.iter_mut().zip(averages) {
                let of = |quantity: usize| (average.value[quantity], average.std_error[quantity]);
                combination.bias.push(of(0));
                combination.measured.push(of(1));
            }
        }
        let curve = |i: u32| {
            let x = f64::from(i) / 400.0;
            let Functions { f, h: [h1, h2], g: [g1, g2] } = problem.at(x);
            [x, f, h1, h2, g1, g2]
        };
        Self {
            f_integral: exact,
            draws: DRAWS.to_vec(),
            replicates: DRAWS.map(|draws| total / draws).to_vec(),
            estimators,
            curves: (0..=400).map(curve).collect(),
        }
    }
}

/// All estimates, from the same `draws` shared draws, or as many separate ones.
fn estimates(problem: &TwoTechniques, division: &Division, draws: u64, rng: &mut Pcg64) -> [f64; COUNT] {
    let one = Integrals::<f64, 2>([1.0; 2]);
    let mut moments = Comoments::<f64, 2>::default();
    let mut mixtures = [GroupedPairs::<f64, 2, 8>::default(); 2];
    for _ in 0..draws {
        let k = (2.0 * unit_interval(rng)) as usize;
        let at = problem.at(problem.draw(k, unit_interval(rng)));
        let g = (at.g[0] + at.g[1]) / 2.0;
        let draw = Draw { f: at.f / g, h: at.h.map(|h| h / g) };
        moments.add(draw);
        for (mixture, heuristic) in mixtures.iter_mut().zip([PowerHeuristic::BALANCE, PowerHeuristic::SQUARE]) {
            mixture.add(Pairs::weighted(draw, Division::by(heuristic, &at.h)));
        }
    }
    let mut separate = [[Sums::<f64>::default(); 2]; COUNT - SHARED];
    for k in 0..2 {
        for _ in 0..draws / 2 {
            let at = problem.at(problem.draw(k, unit_interval(rng)));
            for (sums, parts) in separate.iter_mut().zip(division.parts(&at)) {
                sums[k].add(Draw::new(parts[k] / at.g[k], at.h[k] / at.g[k]));
            }
        }
    }
    let mixture = |k: usize| DeterministicMixture.estimate_anyway(&mixtures[k], &one).value;
    let random = RandomMixture::<RatioOfMeans>::default();
    let separately = |way: usize| -> f64 {
        let part = |sums| match has_ratios(way) {
            true => RatioOfMeans.estimate_anyway(sums, &Integrals::ONE).value,
            false => Plain.estimate_anyway(sums, &Integrals::ONE).value,
        };
        separate[way].iter().map(part).sum()
    };
    [
        value(&moments, &Plain),
        value(&moments, &random.fixed([1.0, 0.0])),
        value(&moments, &random.fixed([0.0, 1.0])),
        value(&moments, &random.fixed([0.5, 0.5])),
        value(&moments, &random),
        value(&moments, &OptimalDefensive::<RatioOfMeans>::default()),
        mixture(0),
        mixture(1),
        value(&moments, &RegressionRatio::default()),
        value(&moments, &Difference::default()),
        separately(0),
        separately(1),
        separately(2),
        separately(3),
    ]
}

/// The value of `estimator` on auxiliaries that have the integral 1.
fn value<E: Estimator<ComomentsState<f64, 2>, 2>>(moments: &Comoments<f64, 2>, estimator: &E) -> f64 {
    estimator.estimate_anyway(moments, &Integrals([1.0; 2])).value
}

/// N·MSE/F² to first order.
fn predictions(problem: &TwoTechniques, division: &Division, exact: f64) -> [f64; COUNT] {
    let over_g =
        |function: &dyn Fn(&Functions) -> f64| problem.integral(|at| function(at) / ((at.g[0] + at.g[1]) / 2.0));
    // Of shared draws: Var(y − c₁x₁ − c₂x₂).
    let about = |[c1, c2]: [f64; 2]| {
        let rest = |at: &Functions| at.f - c1 * at.h[0] - c2 * at.h[1];
        let mean = exact - c1 - c2;
        (over_g(&|at| rest(at) * rest(at)) - mean * mean) / exact / exact
    };
    let hh = |i: usize, j: usize| over_g(&|at| at.h[i] * at.h[j]) - 1.0;
    let fh = |i: usize| over_g(&|at| at.f * at.h[i]) - exact;
    let (a, b, c) = (hh(0, 0), hh(0, 1), hh(1, 1));
    let determinant = a * c - b * b;
    let best = [(fh(0) * c - fh(1) * b) / determinant, (fh(1) * a - fh(0) * b) / determinant];
    // The best mixture: y/F − u₁ regressed on u₂ − u₁.
    let second = ((fh(1) - fh(0)) / exact - b + a) / (c - 2.0 * b + a);
    let divided = |heuristic: PowerHeuristic| {
        core::array::from_fn(|k| problem.integral(|at| Division::by(heuristic, &at.h)[k] * at.f))
    };
    // Of separate draws: the sum over techniques, each with half of the draws.
    let separate = |way: usize| -> f64 {
        let of_technique = |k: usize| {
            let part = |at: &Functions| division.parts(at)[way][k];
            let sum = problem.integral(part);
            let slope = if has_ratios(way) { sum } else { 0.0 };
            let square = |at: &Functions| {
                let rest = part(at) - slope * at.h[k];
                rest * rest / at.g[k]
            };
            2.0 * (problem.integral(square) - (sum - slope) * (sum - slope))
        };
        (of_technique(0) + of_technique(1)) / exact / exact
    };
    [
        about([0.0, 0.0]),
        about([exact, 0.0]),
        about([0.0, exact]),
        about([exact / 2.0, exact / 2.0]),
        about([exact * (1.0 - second), exact * second]),
        about(best),
        about(divided(PowerHeuristic::BALANCE)),
        about(divided(PowerHeuristic::SQUARE)),
        about(best),
        about(best),
        separate(0),
        separate(1),
        separate(2),
        separate(3),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_draws_have_the_predicted_error_and_the_bias_vanishes() {
        let exhibit = TwoTechniquesMse::measure(&Options { quick: true, ..Options::default() });
        let last = exhibit.draws.len() - 1;
        for Combination { estimator, predicted, measured, bias, .. } in &exhibit.estimators {
            // 1024 estimates: five standard errors, and a tenth for what is of second order.
            let (mse, error) = measured[last];
            assert!(libm::fabs(mse - predicted) <= 5.0 * error + 0.1 * predicted, "{estimator}: {mse} {predicted}");
            let (bias, error) = bias[last];
            assert!(libm::fabs(bias) <= 5.0 * error + 0.01, "{estimator}: {bias}");
        }
        let predicted: Vec<f64> = exhibit.estimators.iter().map(|combination| combination.predicted).collect();
        let least = predicted[SHARED..].iter().copied().fold(f64::INFINITY, f64::min);
        assert_eq!(predicted[COUNT - 1], least);
        assert!(predicted[9] <= predicted[4] && predicted[4] <= predicted[6] && predicted[6] < predicted[0] / 3.0);
    }
}
