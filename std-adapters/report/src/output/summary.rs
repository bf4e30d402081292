//! What the numbers say, problem by problem.

use crate::output::selection::leaders;
use crate::output::words;
use crate::{MethodReport, ProblemReport, Versus};

/// One problem in one line.
pub(super) struct Summary<'a> {
    /// The simplest of those with the least error at equal time.
    pub(super) best: &'a MethodReport,
    /// How many others have an error that cannot be told from the least.
    pub(super) ties: usize,
    /// Estimators whose measured MSE theory does not expect.
    pub(super) dissenters: Vec<&'static str>,
    /// All estimators.
    pub(super) methods: usize,
}

/// One problem in one line; `None` where nothing was measured.
pub(super) fn summary(problem: &ProblemReport) -> Option<Summary<'_>> {
    let leaders = leaders(problem.methods.iter());
    let best = leaders.first().copied()?;
    let dissenters = problem.methods.iter().filter(|method| !method.theory.agrees);
    Some(Summary {
        best,
        ties: leaders.len() - 1,
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
