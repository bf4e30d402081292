//! What a case must return.

use crate::case::Precision;
use ratiocv_core::{ChannelEstimate, Flags};

/// The digits of two equal numbers.
pub(crate) const EXACT: f64 = 17.0;

/// What a standard error must be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ErrorBar {
    /// Not asked.
    Any,
    /// Unknown.
    Unknown,
    /// This, to the digits of the value.
    Near(f64),
    /// Known, and at most this.
    AtMost(f64),
}

/// The right answer of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Right {
    /// The value; NaN where it must be unknown.
    pub value: f64,
    /// Its digits: −log₁₀ of the relative error, absolute where the value is 0; 17 for every bit.
    pub digits: f64,
    /// The standard error.
    pub std_error: ErrorBar,
    /// Flags that must be raised.
    pub must: Flags,
    /// Flags that may be. No other may.
    pub may: Flags,
    /// Any of these excuses a value without digits and an unknown error: not right, but not silent.
    pub excuse: Flags,
}

impl Right {
    /// `value` to within a few roundings of `precision`; of the flags, advice alone.
    pub fn new(value: f64, precision: Precision) -> Self {
        let digits = if precision == Precision::Single { 6.5 } else { 15.0 };
        let own = [Flags::OVERFLOW, Flags::UNDERFLOW, Flags::NO_SUPPORT];
        let advice = Flags::ALL.iter().map(|(flag, _)| *flag).filter(|flag| !flag.fell_back() && !own.contains(flag));
        let may = advice.fold(Flags::NONE, |may, flag| may | flag);
        Self { value, digits, std_error: ErrorBar::Any, must: Flags::NONE, may, excuse: Flags::NONE }
    }

    /// Whether `ours` is right.
    ///
    /// # Errors
    /// What is broken: digits, error bar or flags.
    pub fn judge(&self, ours: ChannelEstimate) -> Result<(), String> {
        let ChannelEstimate { value, std_error, flags } = ours;
        let digits = digits_of(value, self.value);
        let excused = Flags::ALL.iter().any(|(flag, _)| self.excuse.contains(*flag) && flags.contains(*flag));
        // Written so that a NaN fails.
        if !(digits >= self.digits || excused) {
            return Err(format!("{value:e} has {digits:.1} digits and needs {}", self.digits));
        }
        let fits = match self.std_error {
            ErrorBar::Any => true,
            ErrorBar::Unknown => std_error.is_nan(),
            ErrorBar::Near(right) => digits_of(std_error, right) >= self.digits,
            ErrorBar::AtMost(most) => std_error <= most,
        };
        if !(fits || (excused && std_error.is_nan())) {
            return Err(format!("the standard error is {std_error:e} and must be {:?}", self.std_error));
        }
        if !flags.contains(self.must) {
            return Err(format!("flags {flags}, without {}", self.must));
        }
        if !(self.may | self.must | self.excuse).contains(flags) {
            return Err(format!("flags {flags}, of which only {} may be", self.may | self.must | self.excuse));
        }
        Ok(())
    }
}

/// Correct decimal digits of `ours`: 17 where it is `right`, to the bit or both NaN; 16 for a zero of the other sign;
/// −∞ for a NaN or an infinity that should be a number; of the absolute error where `right` is 0.
pub fn digits_of(ours: f64, right: f64) -> f64 {
    if ours.to_bits() == right.to_bits() || (ours.is_nan() && right.is_nan()) {
        return EXACT;
    }
    if ours == right {
        return EXACT - 1.0;
    }
    let error = if right == 0.0 { ours.abs() } else { ((ours - right) / right).abs() };
    let digits = -libm::log10(error);
    if digits.is_nan() { f64::NEG_INFINITY } else { digits.min(EXACT) }
}
