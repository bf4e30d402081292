//! Whether output may be styled.

use std::ffi::OsStr;

/// Whether to style what goes to standard output: only on a terminal, and not where the environment variable
/// `NO_COLOR`, of value `no_color`, is set and not empty (<https://no-color.org>).
pub fn is_wanted(terminal: bool, no_color: Option<&OsStr>) -> bool {
    terminal && no_color.is_none_or(OsStr::is_empty)
}

#[cfg(test)]
mod tests {
    use super::is_wanted;
    use std::ffi::OsStr;

    #[test]
    fn no_color_and_pipes_are_respected() {
        assert!(is_wanted(true, None) && is_wanted(true, Some(OsStr::new(""))));
        assert!(!is_wanted(true, Some(OsStr::new("1"))) && !is_wanted(true, Some(OsStr::new("0"))));
        assert!(!is_wanted(false, None) && !is_wanted(false, Some(OsStr::new("1"))));
    }
}
