//! Numbers in words.

use crate::Versus;

/// Three significant digits, or a power of ten where these would be long.
pub(super) fn short(x: f64) -> String {
    let size = libm::fabs(x);
    match size {
        _ if x == 0.0 => "0".into(),
        _ if !x.is_finite() => "–".into(),
        1e5.. => format!("{x:.1e}"),
        100.0.. => format!("{x:.0}"),
        10.0.. => format!("{x:.1}"),
        0.1.. => format!("{x:.2}"),
        0.001.. => format!("{x:.4}"),
        _ => format!("{x:.1e}"),
    }
}

/// "0.41", "≤0.01", "exact", "never".
pub(super) fn versus(versus: Versus) -> String {
    match versus {
        Versus::Times { ratio, .. } => short(ratio),
        Versus::AtMost(ratio) => format!("≤{}", short(ratio)),
        Versus::Exact => "exact".into(),
        Versus::Never => "never".into(),
    }
}

/// In %, with so many digits after the point; "–" for what is not a number.
pub(super) fn percent(share: f64, digits: usize) -> String {
    if share.is_finite() { format!("{:.digits$}", 100.0 * share) } else { "–".into() }
}

/// In %, from the least to the largest, likewise: "31", "31–40". What is not a number is passed over; "–" if all is.
pub(super) fn percents(shares: impl Iterator<Item = f64> + Clone, digits: usize) -> String {
    let least = shares.clone().fold(f64::NAN, f64::min);
    let (from, to) = (percent(least, digits), percent(shares.fold(f64::NAN, f64::max), digits));
    if from == to { from } else { format!("{from}–{to}") }
}

/// "12 ns", "3.4 µs", "1.2 ms".
pub(super) fn time(seconds: f64) -> String {
    let (scaled, unit) = match seconds {
        ..1e-6 => (seconds * 1e9, "ns"),
        ..1e-3 => (seconds * 1e6, "µs"),
        ..1.0 => (seconds * 1e3, "ms"),
        _ => (seconds, "s"),
    };
    let digits = if scaled < 9.95 { 1 } else { 0 };
    format!("{scaled:.digits$} {unit}")
}

/// The same with the power of ten of an axis.
pub(super) fn power_of_ten(exponent: i32) -> String {
    let text = exponent.to_string();
    let digits = text.chars().map(|c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32(u32::from(digit) - u32::from('0') + u32::from('⁰')).unwrap_or(digit),
    });
    format!("10{}", digits.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_three_digits_and_units_fit() {
        assert_eq!([0.41234, 12.34, 0.01234, 1234.5].map(short), ["0.41", "12.3", "0.0123", "1234"]);
        assert_eq!([3.2e-8, 3.42e-6, 0.012].map(time), ["32 ns", "3.4 µs", "12 ms"]);
        assert_eq!([percent(0.3149, 0), percent(0.3149, 1), percent(f64::NAN, 1)], ["31", "31.5", "–"]);
        let ranges = [&[0.4, f64::NAN, 0.31][..], &[0.4, 0.401], &[f64::NAN], &[]];
        assert_eq!(ranges.map(|range| percents(range.iter().copied(), 0)), ["31–40", "40", "–", "–"]);
        assert_eq!([power_of_ten(-13), power_of_ten(4)], ["10⁻¹³", "10⁴"]);
    }
}
