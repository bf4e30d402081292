//! Numbers for reading: few digits, powers of ten where they help.

/// `value` with `digits` significant digits; `unknown` for NaN.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if value.is_nan() {
        return "unknown".into();
    }
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let scientific = format!("{value:.*e}", digits - 1);
    // The exponent after rounding: 9.9996 is 1.000e1 in four digits.
    let exponent: i32 = scientific.rsplit_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0);
    if (-4..=6).contains(&exponent) {
        format!("{value:.*}", usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0))
    } else {
        scientific
    }
}

#[cfg(test)]
mod tests {
    use super::significant;

    #[test]
    fn numbers_are_short_and_right() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1.000"),
            (-1.23456, "-1.235"),
            (9.9996, "10.00"),
            (12345.6, "12346"),
            (0.000123456, "0.0001235"),
            (0.0000123456, "1.235e-5"),
            (1.5e10, "1.500e10"),
            (f64::NAN, "unknown"),
        ] {
            assert_eq!(significant(value, 4), text);
        }
    }
}
