//! Planted bugs, as in `ratiocv-core` (CONTRIBUTING.md, "Planted bugs").

/// `planted!("name": right, wrong)` is `right`; `wrong` only in a build with `--cfg planted_bugs`, and only if
/// the environment variable `RATIOCV_PLANTED` says `name`.
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
pub(crate) fn is_on(name: &str) -> bool {
    static CHOSEN: std::sync::OnceLock<String> = std::sync::OnceLock::new();
    CHOSEN.get_or_init(|| std::env::var("RATIOCV_PLANTED").unwrap_or_default()) == name
}
