//! One line on each flag, for those who read a table and not the library's documentation.

use ratiocv_core::Flags;

/// What `flag` (a single one) means and what helps.
pub fn meaning(flag: Flags) -> &'static str {
    match flag {
        Flags::EMPTY => "no draw: no value",
        Flags::NO_SUPPORT => "every f is 0: the error is unknown; draw more, or sample where f is not 0",
        Flags::DENOM_ZERO => "the denominator is 0: the plain mean was taken; use a defensive estimator",
        Flags::DENOM_SIGN => "the denominator has the wrong sign: the plain mean was taken",
        Flags::NONFINITE => "a sum overflowed: the plain mean was taken, or there is no value; scale the data",
        Flags::OVERFLOW => "squares overflowed: the error is unknown; scale the data",
        Flags::UNDERFLOW => "squares underflowed: the error is unknown; scale the data",
        Flags::BAD_INTEGRAL => "the known integral is 0 or not finite: the plain mean was taken",
        Flags::ONE_SAMPLE => "one draw: the error is unknown",
        Flags::DENOM_ILL => {
            "the denominator is close to 0: the ratio may be far off; draw more, or use a defensive one"
        }
        Flags::NEGATIVE => "the value is negative though the plain mean is not: chance, draw more",
        Flags::LOW_ESS => "few draws make the denominator: the error bar means little; draw more",
        Flags::HEAVY_TAIL => "one draw makes a tenth of the sum of squares: the error bar means little; sample better",
        Flags::RANK => "auxiliaries are linearly dependent: remove one",
        Flags::ALPHA => "a fitted coefficient was clamped, or could not be determined; draw more",
        Flags::UNBOUNDED_RATIO => "f/h is infinite for a draw: the plain mean was taken; use a defensive estimator",
        Flags::WEIGHTS => "weights do not sum to 1",
        Flags::AUX_MISMATCH => {
            "the mean of h is further from its integral than chance allows: check --integral, h and pdf"
        }
        Flags::ROUNDING => "the error is below rounding: the rounding floor is given",
        _ => "see the documentation of ratiocv_core::Flags",
    }
}

#[cfg(test)]
mod tests {
    use super::{Flags, meaning};

    #[test]
    fn every_flag_has_its_own_line() {
        let lines: std::collections::BTreeSet<_> = Flags::ALL.iter().map(|(flag, _)| meaning(*flag)).collect();
        assert_eq!(lines.len(), Flags::ALL.len());
        assert!(lines.iter().all(|line| !line.starts_with("see")));
    }
}
