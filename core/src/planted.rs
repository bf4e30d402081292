//! Planted bugs: proof that the test suite can fail (CONTRIBUTING.md, "Planted bugs"). Public for the other packages
//! alone.

/// `planted!("name": right, wrong)` is `right`. Only in a build with `--cfg planted_bugs`, and only
/// if the environment variable `RATIOCV_PLANTED` says `name`, is it `wrong`. No Cargo feature can
/// turn it on.
#[doc(hidden)]
#[macro_export]
macro_rules! planted {
    ($name:literal: $right:expr, $wrong:expr) => {{
        #[cfg(planted_bugs)]
        let value = if $crate::planted::is_on($name) { $wrong } else { $right };
        #[cfg(not(planted_bugs))]
        let value = $right;
        value
    }};
}
pub(crate) use planted;

#[cfg(planted_bugs)]
#[doc(hidden)]
pub fn is_on(name: &str) -> bool {
    use std::string::String;
    static CHOSEN: std::sync::OnceLock<String> = std::sync::OnceLock::new();
    CHOSEN.get_or_init(|| std::env::var("RATIOCV_PLANTED").unwrap_or_default()) == name
}
