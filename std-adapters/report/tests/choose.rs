//! How much worse than the best fixed choice the chooser is, on every problem.

use ratiocv_report::catalogue::Method;
use ratiocv_report::{MethodReport, Options, ProblemReport, run};

/// The MSE of `id` at `draws` draws, relative to F², and its standard error.
fn mse(problem: &ProblemReport, id: &str, draws: u64) -> (f64, f64) {
    let of = |method: &&MethodReport| method.method.id() == id;
    let method = problem.methods.iter().find(of).expect("an estimator that was measured");
    let point = method.points.iter().find(|point| point.draws == draws).expect("a size that was measured");
    (point.relative.mse, point.relative.mse_std_error)
}

/// Seed 1, the replicates of a quick report: some 10⁴ at 64 draws of the scalar problems. All estimators
/// share their draws, so that ratios of MSEs are far less noisy than the MSEs; the seed makes the outcome
/// the same on every machine.
#[test]
fn the_chooser_is_nearly_as_good_as_the_best_fixed_choice() {
    let ids = ["mc", "ratio", "difference", "mickey", "cross_fitted_difference", "choose", "choose_unbiased"];
    let methods = ids.map(|id| Method::from_id(id).expect("an id")).to_vec();
    let report = run(&Options { quick: true, methods, ..Options::default() }, &()).expect("a report");
    assert!(report.problems.len() >= 10);
    for problem in &report.problems {
        for draws in [16, 64, 256] {
            let least = |ids: &[&str]| ids.iter().map(|id| mse(problem, id, draws).0).fold(f64::INFINITY, f64::min);
            let (plain, best) = (mse(problem, "mc", draws), least(&["mc", "ratio", "difference"]));
            let unbiased = least(&["mc", "mickey", "cross_fitted_difference"]);
            let (choose, choose_unbiased) = (mse(problem, "choose", draws).0, mse(problem, "choose_unbiased", draws).0);
            // What is exact is exact to rounding.
            let rounding = 1e-25;
            println!(
                "{:22} {draws:4} draws: choose/best {:.3}, /plain {:.3}; unbiased: /best {:.3}, /plain {:.3}",
                problem.problem.id(),
                choose / best,
                choose / plain.0,
                choose_unbiased / unbiased,
                choose_unbiased / plain.0,
            );
            let what = format!("{} at {draws} draws", problem.problem.id());
            assert!(choose <= 1.10 * plain.0 + rounding, "{what}: {choose} against plain's {}", plain.0);
            // Rare draws of `importance-sampled` decide its moments, and 64 may miss them: 1.09 and 1.24 in the
            // default report, ± 0.04 with the replicates of a quick one; four of these are allowed.
            let (most, most_unbiased) = match (problem.problem.id(), draws) {
                (_, 16) => continue,
                ("importance-sampled", 64) => (1.25, 1.40),
                _ => (1.05, 1.10),
            };
            assert!(choose <= most * best + rounding, "{what}: {choose} against {best}");
            assert!(
                choose_unbiased <= most_unbiased * unbiased + rounding,
                "{what}: {choose_unbiased} against {unbiased}"
            );
        }
    }
}
