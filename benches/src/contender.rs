//! A kernel under measurement.

use crate::answer::Answer;
use std::fmt;

/// Takes draws, again and again, and says what it made of them.
///
/// *Implemented by* the kernels; *called by* [`sets`](crate::sets).
pub trait Contender<D> {
    /// Goes through the draws once; the moments are those of all passes so far, or of the last one.
    fn pass(&mut self, draws: &[D]);
    /// What it knows, channel by channel.
    fn answer(&self) -> Vec<Answer>;
}

/// A contender with its draws, whose answer was right.
pub struct Measured {
    /// What is computed from which draws.
    pub set: &'static str,
    /// Who computes it.
    pub id: String,
    /// Draws times channels of one pass.
    pub samples: usize,
    pub(crate) pass: Box<dyn FnMut()>,
}

impl Measured {
    /// Goes through the draws once.
    pub fn pass(&mut self) {
        (self.pass)();
    }

    /// Its set and its id.
    pub fn name(&self) -> String {
        format!("{}/{}", self.set, self.id)
    }
}

impl fmt::Debug for Measured {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.name())
    }
}
