//! Which estimators are shown, and in what order.

use crate::{Group, MethodReport, ProblemReport, Versus};

/// The estimators, group by group.
pub(super) fn grouped(problem: &ProblemReport) -> Vec<&MethodReport> {
    let mut methods: Vec<_> = problem.methods.iter().collect();
    methods.sort_by_key(|method| method.method.group());
    methods
}

/// The best of each group.
pub(super) fn shortlist(problem: &ProblemReport) -> Vec<&MethodReport> {
    let of = |group| best(problem.methods.iter().filter(move |method| method.method.group() == group));
    Group::ALL.into_iter().filter_map(of).collect()
}

/// The first of the catalogue among the [`leaders`], that the simplest of equals is named.
pub(super) fn best<'a>(methods: impl Iterator<Item = &'a MethodReport>) -> Option<&'a MethodReport> {
    leaders(methods).first().copied()
}

/// The consistent estimator with the least error at equal time, and those that cannot be told from it: within two
/// standard errors. What does not converge leads nowhere, however well it does with few draws.
pub(super) fn leaders<'a>(methods: impl Iterator<Item = &'a MethodReport>) -> Vec<&'a MethodReport> {
    let error = |method: &MethodReport| method.equal.error_at_equal_time;
    let consistent: Vec<_> = methods.filter(|method| method.method.is_consistent()).collect();
    let least = consistent.iter().copied().min_by(|a, b| error(a).ratio().total_cmp(&error(b).ratio()));
    let leads = |other: &&MethodReport| {
        least.is_some_and(|least| core::ptr::eq(least, *other) || is_tied(error(least), error(other)))
    };
    consistent.iter().copied().filter(leads).collect()
}

fn is_tied(least: Versus, other: Versus) -> bool {
    match (least, other) {
        (Versus::Exact, Versus::Exact) => true,
        (Versus::Times { ratio, std_error }, Versus::Times { ratio: other, std_error: their_error }) => {
            other - ratio <= 2.0 * libm::hypot(std_error, their_error)
        }
        _ => false,
    }
}
