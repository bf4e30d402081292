//! `ratiocv report`: error against run time, measured.

use crate::arguments::ReportArguments;
use crate::fault::Fault;
use std::io::Write;

/// Runs the command.
///
/// # Errors
/// An unknown problem, and files that cannot be written.
pub fn run(_: &ReportArguments, _: &mut dyn Write) -> Result<(), Fault> {
    Err(Fault::data("the report is not there yet", "use `ratiocv estimate`"))
}
