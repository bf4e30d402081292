//! Error bars that mean less than they say.

use crate::output::words::percents;
use crate::{Coverage, MethodReport, Point, ProblemReport};

/// Estimators of one group whose coverage is poor, on one problem after one number of draws.
pub(super) struct Poor<'a> {
    pub(super) problem: &'a ProblemReport,
    pub(super) draws: u64,
    methods: Vec<(&'a MethodReport, Coverage)>,
    worst: Vec<Coverage>,
}

/// Group by group, those among `methods`, which are sorted by group, that are consistent: the intervals of what
/// is not must miss.
pub(super) fn poor<'a>(problem: &'a ProblemReport, methods: &[&'a MethodReport]) -> Vec<Poor<'a>> {
    let mut found: Vec<Poor<'a>> = vec![];
    for (index, draws) in judged_draws(problem) {
        for group in methods.chunk_by(|a, b| a.method.group() == b.method.group()) {
            let points = group.iter().filter(|method| method.method.is_consistent()).map(|method| {
                let point: &Point = &method.points[index];
                (*method, point.coverage, point.worst_coverage())
            });
            let poor = points.filter_map(|(method, coverage, worst)| {
                let coverage = coverage.filter(Coverage::is_poor)?;
                Some(((method, coverage), worst.map_or(coverage, |(_, worst)| worst)))
            });
            let (methods, worst): (Vec<_>, Vec<_>) = poor.unzip();
            if !methods.is_empty() {
                found.push(Poor { problem, draws, methods, worst });
            }
        }
    }
    found
}

/// The places and numbers of draws of the points whose intervals were judged.
pub(super) fn judged_draws(problem: &ProblemReport) -> impl Iterator<Item = (usize, u64)> {
    let points = problem.methods.first().map_or(&[][..], |plain| &plain.points);
    points.iter().enumerate().filter(|(_, point)| point.coverage.is_some()).map(|(index, point)| (index, point.draws))
}

impl Poor<'_> {
    /// Their ids.
    pub(super) fn ids(&self) -> Vec<&'static str> {
        self.methods.iter().map(|(method, _)| method.method.id()).collect()
    }

    /// From the least to the largest, in %, with so many digits after the point.
    fn range(&self, digits: usize, get: impl Fn(&Coverage) -> f64) -> String {
        percents(self.methods.iter().map(|(_, coverage)| get(coverage)), digits)
    }

    pub(super) fn share(&self) -> String {
        self.range(1, |coverage| coverage.share)
    }

    /// That of the worst channel.
    pub(super) fn worst(&self) -> String {
        percents(self.worst.iter().map(|coverage| coverage.share), 1)
    }

    pub(super) fn flagged(&self) -> String {
        self.range(0, |coverage| coverage.flagged)
    }

    pub(super) fn missed_flagged(&self) -> String {
        self.range(0, |coverage| coverage.missed_flagged)
    }

    pub(super) fn without(&self) -> String {
        self.range(0, |coverage| coverage.without)
    }
}
