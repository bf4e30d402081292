//! Every estimator on every problem has the bias and the MSE that theory expects of it.
//!
//! N = 1024 draws, R estimates, seed 20. A cell is an estimator and a channel of a problem; in each, |bias − expected|
//! and |MSE − expected| may be at most z·(standard error) + |second order − first order| + rounding: the last term
//! of the expansion is a measure of those left out. With C comparisons, z is the normal quantile at which all of
//! them together fail by chance with probability α = 10⁻⁹: each at 1 − (1 − α)^(1/C) (Šidák 1967). What an estimate
//! that is 1 % too large does to these numbers must exceed the threshold in every cell, but where f/h scatters so much
//! that no number of estimates would do.

use crate::catalogue::Method;
use crate::measure::plan::Size;
use crate::measure::replicates::replicates;
use crate::measure::tally::Average;
use crate::measure::theory::{ROUNDING, predictions};
use crate::problems::{Problem, Solved, Visitor, population_of};
use ratiocv_core::predict::Prediction;
use statrs::distribution::{ContinuousCDF, Normal};

const DRAWS: u64 = 1024;
const WEIGHT: f64 = 0.01;
const ALPHA: f64 = 1e-9;

/// R: as many as let 1 % be seen, and for the normal law to be near.
fn estimates(id: &str) -> u64 {
    match id {
        "three-lights" => 12_288,
        "nested" | "signed" => 6144,
        "peaks-4d" => 3072,
        _ => 2048,
    }
}

/// What was measured in one channel, and what theory expects, to first and to second order.
struct Cell {
    what: String,
    /// Whether 1 % more must be seen.
    sharp: bool,
    measured: (Average, Average),
    expected: (Prediction, Prediction),
    /// Plain Monte Carlo's, which rounding is relative to.
    plain_mse: f64,
}

impl Cell {
    /// How far bias and MSE are from what is expected, and how far they may be.
    fn distances(&self, (bias, mse): (Average, Average), z: f64) -> [(f64, f64); 2] {
        let (first, second) = &self.expected;
        let distance = |measured: Average, first: f64, second: f64, rounding: f64| {
            let allowed = z * measured.std_error + (second - first).abs() + rounding;
            ((measured.mean - second).abs(), allowed)
        };
        let rounding = ROUNDING * self.plain_mse;
        [distance(bias, first.bias, second.bias, rounding.sqrt()), distance(mse, first.mse, second.mse, rounding)]
    }

    /// What is measured of estimates that are larger by the factor 1 + `more`: an error e becomes e + more·(1 + e).
    fn larger(&self, more: f64) -> (Average, Average) {
        let ((bias, mse), factor) = (self.measured, 1.0 + more);
        let of_square = factor * factor * mse.mean + 2.0 * factor * more * bias.mean + more * more;
        (
            Average { mean: factor * bias.mean + more, std_error: factor * bias.std_error },
            Average { mean: of_square, std_error: factor * factor * mse.std_error },
        )
    }
}

/// Where h comes near 0, and f/h has no variance to go by.
fn scatters(problem: &str, method: Method) -> bool {
    let of_ratios = ["mean_of_ratios", "hartley_ross"].iter().any(|id| method.id().ends_with(id));
    of_ratios && (problem == "signed" || problem == "nearly-vanishing" && !method.is_defensive())
}

struct Cells;

impl Visitor for Cells {
    type Output = Vec<Cell>;

    fn visit<S: Solved>(self, problem: &S) -> Vec<Cell> {
        let id = S::DESCRIPTION.id;
        let methods: Vec<Method> = Method::all().collect();
        let count = estimates(id);
        let size = Size { draws: DRAWS, replicates: count, chunk: 16, judged: false, rounds: 0, repeats: 0 };
        let populations = population_of(problem, WEIGHT).expect("a weight below 1");
        let tallies = replicates(problem, &methods, WEIGHT, size, 20).expect("a weight below 1");
        let plain: Vec<f64> = tallies[0].channels(count).map(|(_, mse)| mse.mean).collect();
        let mut cells = Vec::new();
        for (method, tally) in methods.iter().zip(&tallies) {
            let expected = predictions(*method, WEIGHT, &populations, DRAWS);
            for (channel, (measured, expected)) in tally.channels(count).zip(expected).enumerate() {
                let what = format!("{id}, {}, {}", method.id(), problem.channel(channel));
                let sharp = !scatters(id, *method);
                cells.push(Cell { what, sharp, measured, expected, plain_mse: plain[channel] });
            }
        }
        cells
    }
}

#[test]
fn bias_and_mse_are_what_theory_expects_and_one_percent_more_is_not() {
    let cells: Vec<Cell> = Problem::all().flat_map(|problem| problem.visit(Cells)).collect();
    let comparisons = 2 * cells.len();
    assert!(comparisons >= 2 * 24 * 11);
    // Both tails; −ln_1p keeps the digits of so small a number.
    let each = -(f64::ln_1p(-ALPHA) / comparisons as f64).exp_m1();
    let z = -Normal::standard().inverse_cdf(each / 2.0);
    let mut wrong = Vec::new();
    let mut worst = [0.0_f64; 2];
    for cell in &cells {
        let distances = cell.distances(cell.measured, z);
        for ((name, (distance, allowed)), worst) in ["bias", "MSE"].into_iter().zip(distances).zip(&mut worst) {
            *worst = worst.max(distance / allowed);
            if distance.is_nan() || distance > allowed {
                wrong.push(format!("{}: {name} off by {distance:e}, {allowed:e} allowed", cell.what));
            }
        }
        let seen = cell.distances(cell.larger(0.01), z).iter().any(|(distance, allowed)| distance > allowed);
        if cell.sharp && !seen {
            wrong.push(format!("{}: 1 % more would not be seen: {distances:?}", cell.what));
        }
    }
    println!("{comparisons} comparisons, z = {z:.2}; the greatest bias and MSE, of those allowed: {worst:?}");
    assert!(wrong.is_empty(), "z = {z:.2}\n{}", wrong.join("\n"));
}
