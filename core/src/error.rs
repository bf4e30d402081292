//! What can be wrong with a call. What can be wrong with the data is a flag, per channel.

use core::fmt;

/// Why there is no estimate; `Display` says what to do about it.
///
/// ```
/// use ratiocv_core::{moments::Comoments, Beale, Error, Estimator, Integrals};
/// let error = Beale.estimate(&Comoments::<f64>::default(), &Integrals::ONE).unwrap_err();
/// assert_eq!(error, Error::TooFewDraws { estimator: "beale", needed: 2, got: 0 });
/// assert_eq!(
///     error.to_string(),
///     "beale needs at least 2 draws and has 0: add draws, or use estimate_anyway for a flagged fall-back"
/// );
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The estimator is not defined for so few draws.
    TooFewDraws {
        /// The estimator's id.
        estimator: &'static str,
        /// The least number it is defined for.
        needed: u64,
        /// The number of draws.
        got: u64,
    },
    /// A defensive weight outside [0, 1), or NaN.
    Weight(f64),
    /// A parameter outside its range, or NaN.
    Parameter {
        /// Its name.
        parameter: &'static str,
        /// Its value.
        got: f64,
        /// What it must be, and the remedy.
        needed: &'static str,
    },
    /// The ratios f/h were accumulated on an auxiliary other than the one of the estimate.
    OtherAuxiliary {
        /// The estimator's id.
        estimator: &'static str,
        /// The channel.
        channel: usize,
    },
    /// Two lengths that must agree do not.
    LengthMismatch {
        /// What is too short or too long.
        what: &'static str,
        /// The length that it should have.
        expected: usize,
        /// The length that it has.
        got: usize,
    },
    /// An entry of a table of weights is negative, infinite or NaN.
    TableEntry {
        /// What the table holds.
        what: &'static str,
        /// The number of the entry.
        index: usize,
        /// The entry.
        value: f64,
    },
    /// No entry of a table of weights is positive.
    TableOfZeros {
        /// What the table holds.
        what: &'static str,
    },
    /// A channel was put into a stratum that is not there.
    NoSuchStratum {
        /// The channel.
        channel: usize,
        /// Its stratum.
        stratum: usize,
        /// The number of strata.
        strata: usize,
    },
    /// Fewer draws than strata.
    TooFewForStrata {
        /// The number of draws.
        draws: u64,
        /// The number of strata.
        strata: usize,
    },
    /// The exponent of a power heuristic that is not positive or not finite.
    Exponent(f64),
    /// Counts of techniques that are negative, not finite, or all 0.
    Counts,
    /// A draw for an accumulator that a film does not have.
    NoSuchAccumulator {
        /// Its index.
        index: usize,
        /// The number of accumulators.
        accumulators: usize,
    },
    /// A film's memory, its image or its fellow has the wrong size.
    FilmSize {
        /// What is too large or too small.
        what: &'static str,
        /// The size that it must have.
        needed: usize,
        /// The size that it has.
        got: usize,
    },
    /// A draw has a number that is not finite, and was to be refused ([`Checked`](crate::moments::Checked)).
    NotFinite {
        /// The draw's number, from 0.
        draw: u64,
    },
    /// A flag was raised, and the caller asked for none ([`Estimate::strict`](crate::Estimate::strict)).
    Flagged {
        /// The first channel with a flag.
        channel: usize,
        /// Its flags.
        flags: crate::Flags,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFewDraws { estimator, needed, got } => write!(
                f,
                "{estimator} needs at least {needed} draws and has {got}: \
                 add draws, or use estimate_anyway for a flagged fall-back"
            ),
            Self::Weight(weight) => write!(
                f,
                "the defensive weight is {weight} and must be at least 0 and below 1: 0.01 is the usual choice"
            ),
            Self::Parameter { parameter, got, needed } => write!(f, "{parameter} is {got} and must be {needed}"),
            Self::OtherAuxiliary { estimator, channel } => write!(
                f,
                "{estimator}, channel {channel}: the ratios f/h were accumulated for another defensive weight or known \
                 integral: make the accumulator with the estimator's own error_bar(&integrals)"
            ),
            Self::LengthMismatch { what, expected, got } => {
                write!(f, "{what} has length {got} and needs {expected}: give one entry per draw and channel")
            }
            Self::TableEntry { what, index, value } => {
                write!(f, "{what} {index} is {value}: give a finite number that is not negative")
            }
            Self::TableOfZeros { what } => write!(f, "no {what} is positive: give at least one that is"),
            Self::NoSuchStratum { channel, stratum, strata } => write!(
                f,
                "channel {channel} is in stratum {stratum} of {strata}: number the strata from 0 and give each channel one of \
                 them"
            ),
            Self::TooFewForStrata { draws, strata } => {
                write!(f, "{draws} draws for {strata} strata: give every stratum at least one, or join strata")
            }
            Self::Exponent(exponent) => write!(
                f,
                "the exponent of the power heuristic is {exponent} and must be positive and finite: 1 is the balance \
                 heuristic, 2 the usual power heuristic"
            ),
            Self::Counts => write!(
                f,
                "the counts of the techniques must be finite, not negative, and not all 0: give the number of draws \
                 from each technique, or its probability"
            ),
            Self::NoSuchAccumulator { index, accumulators } => {
                write!(
                    f,
                    "there is no accumulator {index} in a film of {accumulators}: number pixels, or packs of them, from 0"
                )
            }
            Self::FilmSize { what, needed, got } => write!(
                f,
                "{what}: {got}, and must be {needed}: give one accumulator per pixel or pack of pixels, one entry of an \
                 image per pixel and channel, and merge films of the same image"
            ),
            Self::NotFinite { draw } => write!(
                f,
                "draw {draw} has a number that is not finite: mend the integrand, leave such draws out with Skip, or let \
                 them be flagged"
            ),
            Self::Flagged { channel, flags } => write!(
                f,
                "channel {channel} raised {flags}: see Flags for each remedy, or take the value without strict()"
            ),
        }
    }
}

impl core::error::Error for Error {}

/// `weight`, if it is a defensive weight.
pub(crate) fn weight_in_range(weight: f64) -> Result<f64, Error> {
    if (0.0..1.0).contains(&weight) { Ok(weight) } else { Err(Error::Weight(weight)) }
}
