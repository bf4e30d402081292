//! What the numbers say, problem by problem.

use crate::output::words;
use crate::{MethodReport, ProblemReport, Versus};

/// One problem in one line.
pub(super) struct Summary<'a> {
    /// The consistent estimator with the least error at equal time.
    pub(super) best: &'a MethodReport,
    /// How many others cannot be told from it: within two standard errors.
    pub(super) ties: usize,
    /// Estimators whose measured MSE theory does not expect.
    pub(super) dissenters: Vec<&'static str>,
    /// All estimators.
    pub(super) methods: usize,
}

/// One problem in one line; `None` where nothing was measured.
pub(super) fn summary(problem: &ProblemReport) -> Option<Summary<'_>> {
    let error = |method: &MethodReport| method.equal.error_at_equal_time;
    let better = |a: &&MethodReport, b: &&MethodReport| error(a).ratio().total_cmp(&error(b).ratio());
    // What does not converge is nobody's best, however well it does with few draws.
    let candidates = || problem.methods.iter().filter(|method| method.method.is_consistent());
    let best = candidates().min_by(better)?;
    let tied = |other: &&MethodReport| match (error(best), error(other)) {
        (Versus::Exact, Versus::Exact) => true,
        (Versus::Times { ratio, std_error }, Versus::Times { ratio: other, std_error: their_error }) => {
            other - ratio <= 2.0 * libm::hypot(std_error, their_error)
        }
        _ => false,
    };
    let dissenters = problem.methods.iter().filter(|method| !method.theory.agrees);
    Some(Summary {
        best,
        ties: candidates().filter(tied).count().saturating_sub(1),
        dissenters: dissenters.map(|method| method.method.id()).collect(),
        methods: problem.methods.len(),
    })
}

impl Summary<'_> {
    /// "0.15 × plain", or "exact".
    pub(super) fn error(&self) -> String {
        match self.best.equal.error_at_equal_time {
            Versus::Exact => "exact".into(),
            other => format!("{} × plain", words::versus(other)),
        }
    }

    /// "15 of 15", or who does not.
    pub(super) fn theory(&self) -> String {
        let agreeing = self.methods - self.dissenters.len();
        if self.dissenters.is_empty() {
            format!("yes, {agreeing} of {agreeing}")
        } else {
            format!("{agreeing} of {}; not {}", self.methods, self.dissenters.join(", "))
        }
    }
}
