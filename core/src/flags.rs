//! What an estimate says about itself, channel by channel.

use core::fmt;
use core::ops::{BitAnd, BitOr, BitOrAssign};

/// A set of remarks on one channel of an estimate.
///
/// ```
/// use ratiocv_core::Flags;
/// let flags = Flags::DENOM_ZERO | Flags::LOW_ESS;
/// assert!(flags.contains(Flags::LOW_ESS) && flags.fell_back());
/// assert_eq!(flags.to_string(), "DENOM_ZERO LOW_ESS");
/// assert_eq!(Flags::NONE.to_string(), "-");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Flags(u32);

macro_rules! flags {
    ($($(#[doc = $doc:literal])+ $name:ident = $bit:literal;)+) => {
        impl Flags {
            $($(#[doc = $doc])+ pub const $name: Self = Self(1 << $bit);)+

            /// Every flag with its name, in order.
            pub const ALL: &'static [(Self, &'static str)] = &[$((Self::$name, stringify!($name))),+];
        }
    };
}

flags! {
    /// No draw: no value (NaN).
    EMPTY = 0;
    /// Every f so far is 0, the black pixel: the value is 0 and its error unknown, since nothing has
    /// been seen of the integrand. So it is where moments cannot tell f from 0: its mean is 0, and its
    /// squares vanished, or are not kept and the auxiliaries are 0 too. *Remedy:* more draws, or a
    /// proposal that finds it.
    NO_SUPPORT = 1;
    /// The denominator is exactly 0: the plain mean was taken. *Remedy:* a defensive auxiliary.
    DENOM_ZERO = 2;
    /// The denominator has the wrong sign for a fractional power: the plain mean was taken.
    DENOM_SIGN = 3;
    /// A draw, or a sum of draws, is not a finite number. If only the auxiliary is bad the plain mean
    /// was taken; if f is bad the value is NaN.
    NONFINITE = 4;
    /// Squares left the range of the lanes' scalar: the value is good (the plain mean, where the
    /// estimator reads squares), the error unknown. *Remedy:* `Widened` accumulators, or scaled data.
    OVERFLOW = 5;
    /// Squares vanished below the range of the lanes' scalar; as OVERFLOW.
    UNDERFLOW = 6;
    /// The known integral is 0 or not finite: the plain mean was taken.
    BAD_INTEGRAL = 7;
    /// One draw: no error bar; estimators that need two fell back to the ratio of means.
    ONE_SAMPLE = 8;
    /// The denominator is within five standard errors of 0, or too few of its digits are left after
    /// cancellation: the ratio may be far off. *Remedy:* more draws, or a defensive auxiliary.
    DENOM_ILL = 9;
    /// The estimate is negative though the plain mean is not: possible for unbiased estimators.
    NEGATIVE = 10;
    /// The effective sample size (Σh)²/Σh² is below min(100, N/10): a few draws make the denominator.
    LOW_ESS = 11;
    /// One draw carries more than a tenth of Σf² among at least 100: the error bar means little.
    HEAVY_TAIL = 12;
    /// Auxiliaries were linearly dependent.
    RANK = 13;
    /// A fitted exponent or coefficient was clamped, or could not be determined.
    ALPHA = 14;
    /// A draw had h = 0 ≠ f: f/h has no mean; the plain mean was taken. *Remedy:* a defensive auxiliary.
    UNBOUNDED_RATIO = 15;
    /// Weights that should sum to 1 do not.
    WEIGHTS = 16;
    /// The mean of h is further from H than chance allows: h, its pdf, or H is wrong.
    AUX_MISMATCH = 17;
    /// The error is below rounding: the rounding floor is reported.
    ROUNDING = 18;
}

impl Flags {
    /// No remark.
    pub const NONE: Self = Self(0);

    /// Those that mean that the value is not the estimator's own.
    const FALL_BACK: Self = Self(
        Self::EMPTY.0
            | Self::DENOM_ZERO.0
            | Self::DENOM_SIGN.0
            | Self::NONFINITE.0
            | Self::BAD_INTEGRAL.0
            | Self::UNBOUNDED_RATIO.0,
    );

    /// Whether every flag of `other` is set.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Whether no flag is set.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Whether a flag says that the value is not the estimator's own but the plain mean's (or NaN).
    /// All other flags are advice.
    pub const fn fell_back(self) -> bool {
        self.0 & Self::FALL_BACK.0 != 0
    }

    /// A bit for each flag that is set, for images and files of flags; which bit is whose is the order of
    /// the table above in this version, and may be another one in the next.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// The names of the flags that are set.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        Self::ALL.iter().filter(move |(flag, _)| self.contains(*flag)).map(|(_, name)| *name)
    }

    /// These but `others`.
    ///
    /// ```
    /// use ratiocv_core::Flags;
    /// let flags = Flags::NO_SUPPORT | Flags::LOW_ESS;
    /// assert_eq!(flags.without(Flags::NO_SUPPORT | Flags::RANK), Flags::LOW_ESS);
    /// ```
    #[must_use]
    pub const fn without(self, others: Self) -> Self {
        Self(self.0 & !others.0)
    }

    /// `flag` if `condition`, else nothing.
    pub(crate) const fn when(condition: bool, flag: Self) -> Self {
        if condition { flag } else { Self::NONE }
    }
}

impl BitOr for Flags {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitAnd for Flags {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOrAssign for Flags {
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

/// The names, separated by spaces; `-` if there is none.
impl fmt::Display for Flags {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("-");
        }
        for (i, name) in self.names().enumerate() {
            f.write_str(if i > 0 { " " } else { "" })?;
            f.write_str(name)?;
        }
        Ok(())
    }
}
