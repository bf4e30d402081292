//! One field to one finite number.

use core::fmt;

/// Why a field is not a number that an estimator can use.
#[derive(Clone, Debug, PartialEq)]
pub enum NotUsable {
    /// Nothing is there.
    Empty,
    /// Something else is there.
    Malformed(String),
    /// NaN or an infinity, spelt out or by overflow.
    NotFinite(String),
}

/// Longer fields are cut short in messages.
const SHOWN: usize = 40;

/// The number in `field`, spaces around it allowed.
///
/// # Errors
/// [`NotUsable`].
#[inline]
pub fn parse(field: &str) -> Result<f64, NotUsable> {
    match field.parse() {
        Ok(value) if f64::is_finite(value) => Ok(value),
        _ => parse_with_care(field),
    }
}

#[cold]
fn parse_with_care(field: &str) -> Result<f64, NotUsable> {
    let field = field.trim();
    if field.is_empty() {
        return Err(NotUsable::Empty);
    }
    match field.parse::<f64>() {
        Err(_) => Err(NotUsable::Malformed(shown(field))),
        Ok(value) if !value.is_finite() => Err(NotUsable::NotFinite(shown(field))),
        Ok(value) => Ok(value),
    }
}

/// `field` as it can stand in a message: short, and without control characters.
pub fn shown(text: &str) -> String {
    let mut shown: String = text.chars().take(SHOWN).flat_map(char::escape_debug).collect();
    if text.chars().nth(SHOWN).is_some() {
        shown.push('…');
    }
    format!("'{shown}'")
}

impl fmt::Display for NotUsable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "the field is empty"),
            Self::Malformed(field) => write!(f, "{field} is not a number"),
            Self::NotFinite(field) => write!(f, "{field} is not a finite number"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{NotUsable, parse};

    #[test]
    fn numbers_as_programs_write_them() {
        for (field, value) in
            [("1", 1.0), ("-2.5e-3", -0.0025), (" 4 ", 4.0), ("+.5", 0.5), ("\t1e3", 1000.0), ("5e-324", 5e-324)]
        {
            assert_eq!(parse(field), Ok(value), "{field}");
        }
        assert!(parse("-0").expect("a number").is_sign_negative());
    }

    #[test]
    fn everything_else_is_named() {
        assert_eq!(parse(""), Err(NotUsable::Empty));
        assert_eq!(parse("  "), Err(NotUsable::Empty));
        for field in ["NaN", "inf", "-Infinity", "1e999"] {
            assert_eq!(parse(field), Err(NotUsable::NotFinite(format!("'{field}'"))));
        }
        for field in ["abc", "1.0f", "1 2", "0x10", "1d5", "--1"] {
            assert_eq!(parse(field), Err(NotUsable::Malformed(format!("'{field}'"))));
        }
        assert_eq!(parse("\u{fffd}\0").unwrap_err().to_string(), "'\u{fffd}\\0' is not a number");
        assert_eq!(parse(&"x".repeat(50)).unwrap_err().to_string(), format!("'{}…' is not a number", "x".repeat(40)));
    }
}
