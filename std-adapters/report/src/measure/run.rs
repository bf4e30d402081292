//! The whole measurement.

use crate::catalogue::Method;
use crate::exhibits::Exhibits;
use crate::measure::clock::clock;
use crate::measure::compare::compare;
use crate::measure::plan::{Size, plan};
use crate::measure::replicates::replicates;
use crate::measure::report::{ChannelPoint, MethodReport, Point, ProblemReport, Report};
use crate::measure::theory::{figures, judge, mean, predictions};
use crate::measure::{Error, Options, Progress};
use crate::problems::{Problem, Solved, Visitor, population_of};
use crate::provenance::Provenance;
use core::cell::Cell;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::time::Instant;

/// Plain Monte Carlo is compared after this fraction of its most draws, so that slower estimators too
/// are measured, not extrapolated, at its time.
const REFERENCE: usize = 2;

/// Measures.
///
/// Everything but the run times is the same to the bit for the same options, whatever the machine and
/// the number of threads.
///
/// # Errors
/// See [`Error`].
pub fn run(options: &Options, progress: &dyn Progress) -> Result<Report, Error> {
    if !(options.budget_seconds > 0.0 && options.budget_seconds.is_finite()) {
        return Err(Error::Budget(options.budget_seconds));
    }
    let start = Instant::now();
    let pool = ThreadPoolBuilder::new().num_threads(options.threads.unwrap_or(0)).build().map_err(Error::Threads)?;
    let mut problems = Vec::with_capacity(options.problems.len());
    let of_exhibits = if options.exhibits { Exhibits::STEPS } else { 0 };
    let steps = options.problems.iter().map(|problem| steps(options, *problem)).sum::<usize>() + of_exhibits;
    let steps = Steps { progress, done: Cell::new(0), total: steps as u64 };
    for problem in &options.problems {
        problems.push(problem.visit(Measure { options, problem: *problem, pool: &pool, steps: &steps })?);
    }
    let exhibits = options.exhibits.then(|| Exhibits::measure(options, &pool, &|doing| steps.next(doing)));
    steps.progress.report(steps.total, steps.total, "done");
    let mut provenance = Provenance::now(options, pool.current_num_threads());
    provenance.wall_seconds = start.elapsed().as_secs_f64();
    Ok(Report { provenance, problems, exhibits })
}

/// The estimators to measure: plain first, none twice.
fn methods(options: &Options) -> Vec<Method> {
    Method::all().filter(|method| *method == Method::PLAIN || options.methods.contains(method)).collect()
}

/// One for the population, and two for each size.
fn steps(options: &Options, problem: Problem) -> usize {
    1 + 2 * sizes(options, problem).len()
}

fn sizes(options: &Options, problem: Problem) -> Vec<Size> {
    plan(options, problem.integrals().len(), options.problems.len())
}

struct Steps<'a> {
    progress: &'a dyn Progress,
    done: Cell<u64>,
    total: u64,
}

impl Steps<'_> {
    fn next(&self, doing: &str) {
        self.progress.report(self.done.get(), self.total, doing);
        self.done.set(self.done.get() + 1);
    }
}

struct Measure<'a> {
    options: &'a Options,
    problem: Problem,
    pool: &'a ThreadPool,
    steps: &'a Steps<'a>,
}

impl Visitor for Measure<'_> {
    type Output = Result<ProblemReport, Error>;

    fn visit<S: Solved>(self, problem: &S) -> Self::Output {
        let Self { options, pool, steps, .. } = self;
        let (id, weight, methods) = (S::DESCRIPTION.id, options.defensive_weight, methods(options));
        steps.next(&format!("{id}: its law"));
        let populations = pool.install(|| population_of(problem, weight)).map_err(Error::Weight)?;
        let mut points: Vec<Vec<Point>> = vec![vec![]; methods.len()];
        let sizes = sizes(options, self.problem);
        for size in &sizes {
            let Size { draws, replicates: count, .. } = *size;
            steps.next(&format!("{id}: {count} estimates of {draws} draws"));
            let tallies =
                pool.install(|| replicates(problem, &methods, weight, *size, options.seed)).map_err(Error::Weight)?;
            steps.next(&format!("{id}: run time of {draws} draws"));
            let seconds = clock(problem, &methods, weight, *size, options.seed);
            for (index, method) in methods.iter().enumerate() {
                let predicted = predictions(*method, weight, &populations, draws);
                let tally = &tallies[index];
                let channels = tally.channels(count).zip(&predicted).zip(tally.coverages());
                points[index].push(Point {
                    draws,
                    replicates: count,
                    relative: figures(tally.all(count), mean(&predicted)),
                    channels: channels
                        .map(|((measured, predicted), coverage)| ChannelPoint {
                            relative: figures(measured, *predicted),
                            coverage,
                        })
                        .collect(),
                    coverage: tally.coverage(),
                    seconds: seconds[index],
                });
            }
        }
        Ok(summed_up(self.problem, &methods, points))
    }
}

/// What the points of all estimators say together; plain is the first.
fn summed_up(problem: Problem, methods: &[Method], points: Vec<Vec<Point>>) -> ProblemReport {
    let last = points[0].len() - 1;
    let reference = last.saturating_sub(REFERENCE);
    let plain = points[0].clone();
    let methods = methods.iter().zip(points).map(|(method, points)| MethodReport {
        method: *method,
        equal: compare(&points, &plain, reference, method.is_consistent()),
        theory: judge(&points[last], plain[last].relative.mse),
        points,
    });
    ProblemReport { problem, reference_draws: plain[reference].draws, methods: methods.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn small(threads: usize) -> Report {
        let ids = ["signed", "three-lights", "spectrum-32"];
        let problems = ids.iter().filter_map(|id| Problem::from_id(id)).collect();
        let options = Options {
            problems,
            seed: 7,
            threads: Some(threads),
            budget_seconds: 0.2,
            quick: true,
            exhibits: false,
            ..Options::default()
        };
        run(&options, &()).unwrap()
    }

    /// Everything but the times, as bits.
    fn bits(report: &Report) -> Vec<u64> {
        let points = report.problems.iter().flat_map(|problem| &problem.methods).flat_map(|method| &method.points);
        let figures = points.flat_map(|point| {
            point.channels.iter().map(|channel| channel.relative).chain([point.relative]).collect::<Vec<_>>()
        });
        let numbers = figures.flat_map(|figures| {
            let (second, first) = (figures.predicted, figures.first_order);
            let predicted = [second.bias, second.mse, first.bias, first.mse];
            [figures.bias, figures.bias_std_error, figures.mse, figures.mse_std_error].into_iter().chain(predicted)
        });
        numbers.map(f64::to_bits).collect()
    }

    #[test]
    fn threads_change_no_bit() {
        let one = bits(&small(1));
        assert!(one.len() > 3 * 15 * 8 * 8);
        assert_eq!(one, bits(&small(2)));
        assert_eq!(one, bits(&small(5)));
    }

    #[test]
    fn plain_is_always_there_and_first() {
        let methods = methods(&Options {
            methods: [Method::from_id("mickey"), Method::from_id("mickey")].into_iter().flatten().collect(),
            ..Options::default()
        });
        assert_eq!(methods.iter().map(|method| method.id()).collect::<Vec<_>>(), ["mc", "mickey"]);
    }

    #[test]
    fn a_bad_budget_and_a_bad_weight_are_errors() {
        let zero = Options { budget_seconds: 0.0, ..Options::default() };
        assert!(matches!(run(&zero, &()), Err(Error::Budget(_))));
        let heavy = Options { defensive_weight: 1.0, budget_seconds: 0.1, quick: true, ..Options::default() };
        assert!(matches!(run(&heavy, &()), Err(Error::Weight(_))));
    }
}
