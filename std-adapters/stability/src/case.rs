//! One case: data, not code.

use crate::answer::{ErrorBar, Right};
use crate::draws::Draws;
use crate::method::{Method, Several};
use crate::probe::Probes;
use ratiocv_core::Flags;

/// The precision of the draws, and of the textbook formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub enum Precision {
    /// `f32`.
    #[serde(rename = "f32")]
    Single,
    /// `f64`.
    #[serde(rename = "f64")]
    Double,
}

impl Precision {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::Single, Self::Double];

    /// `single` or `double`.
    pub(crate) fn of<T>(self, single: T, double: T) -> T {
        match self {
            Self::Single => single,
            Self::Double => double,
        }
    }

    /// `x` as draws of this precision hold it.
    pub(crate) fn rounded(self, x: f64) -> f64 {
        self.of(f64::from(x as f32), x)
    }

    /// "f32" or "f64".
    pub fn name(self) -> &'static str {
        self.of("f32", "f64")
    }
}

/// What is run.
#[derive(Debug)]
pub enum Ask {
    /// `method`, of draws with one auxiliary; of the merged moments, in either order, if there is a second part.
    One {
        /// The estimator.
        method: Method,
        /// The draws.
        draws: Draws,
        /// Draws accumulated apart.
        then: Option<Draws>,
        /// H.
        integral: f64,
    },
    /// `method`, of draws with two auxiliaries.
    Two {
        /// The estimator.
        method: Several,
        /// The draws.
        draws: Draws<2>,
        /// H of each.
        integrals: [f64; 2],
    },
    /// Coefficient `which` of the regression on five auxiliaries, 5 for the intercept.
    Five {
        /// Which.
        which: usize,
        /// The draws.
        draws: Draws<5>,
    },
    /// What is not draws and an estimator.
    Probe(Probes),
}

/// What is put beside the answer.
#[derive(Clone, Copy, Debug)]
pub enum Naive {
    /// The textbook formula of the method, in the precision of the draws.
    Formula,
    /// Another textbook computation.
    By(fn() -> f64),
    /// There is none.
    None,
}

/// A case with its right answer.
#[derive(Debug)]
pub struct Case {
    /// Its name: a letter for the section, and a number.
    pub id: &'static str,
    /// What is hard about it.
    pub about: &'static str,
    /// The precision of its draws.
    pub precision: Precision,
    /// What is run.
    pub ask: Ask,
    /// What must come out.
    pub right: Right,
    /// What the textbook makes of it.
    pub naive: Naive,
}

impl Case {
    /// `ask`, which must give `value` to within a few roundings.
    pub fn new(id: &'static str, about: &'static str, precision: Precision, ask: Ask, value: f64) -> Self {
        let naive = if matches!(ask, Ask::Probe(_)) { Naive::None } else { Naive::Formula };
        Self { id, about, precision, ask, right: Right::new(value, precision), naive }
    }

    /// Of draws that are pairs of f and h.
    pub fn of_pairs(
        id: &'static str,
        about: &'static str,
        precision: Precision,
        (method, pairs, integral): (Method, &[(f64, f64)], f64),
        value: f64,
    ) -> Self {
        let ask = Ask::One { method, draws: Draws::listed(pairs), then: None, integral };
        Self::new(id, about, precision, ask, value)
    }

    /// To so many digits.
    #[must_use]
    pub fn digits(mut self, digits: f64) -> Self {
        self.right.digits = digits;
        self
    }

    /// To the bit.
    #[must_use]
    pub fn exact(self) -> Self {
        self.digits(crate::answer::EXACT)
    }

    /// With this standard error.
    #[must_use]
    pub fn error(mut self, error: ErrorBar) -> Self {
        self.right.std_error = error;
        self
    }

    /// With these flags raised.
    #[must_use]
    pub fn must(mut self, flags: Flags) -> Self {
        self.right.must = flags;
        self
    }

    /// With these flags allowed beside advice.
    #[must_use]
    pub fn may(mut self, flags: Flags) -> Self {
        self.right.may |= flags;
        self
    }

    /// With no flag but those that must be.
    #[must_use]
    pub fn silent(mut self) -> Self {
        self.right.may = Flags::NONE;
        self
    }

    /// Right, or flagged so.
    #[must_use]
    pub fn or(mut self, flags: Flags) -> Self {
        self.right.excuse = flags;
        self
    }

    /// Beside this textbook computation.
    #[must_use]
    pub fn naive(mut self, by: fn() -> f64) -> Self {
        self.naive = Naive::By(by);
        self
    }

    /// Its section: the letter of its id, or `StRD`.
    pub fn section(&self) -> &'static str {
        crate::cases::section_of(self.id)
    }

    /// The number of draws.
    pub fn draws(&self) -> u64 {
        match &self.ask {
            Ask::One { draws, then, .. } => draws.total() + then.as_ref().map_or(0, Draws::total),
            Ask::Two { draws, .. } => draws.total(),
            Ask::Five { draws, .. } => draws.total(),
            Ask::Probe(_) => 0,
        }
    }
}
