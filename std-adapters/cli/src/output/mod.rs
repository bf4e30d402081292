//! What `ratiocv estimate` prints.

mod csv;
mod json;
mod number;
mod table;

use crate::fault::Fault;
use crate::verdict::Verdict;
use clap::ValueEnum;
use std::io::Write;

/// How to print estimates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For reading
    Table,
    /// One object
    Json,
    /// One row per estimate
    Csv,
}

/// Prints `verdict` as `format`.
///
/// # Errors
/// Those of writing.
pub fn print(verdict: &Verdict, format: Format, out: &mut dyn Write) -> Result<(), Fault> {
    match format {
        Format::Table => table::print(verdict, out)?,
        Format::Json => json::print(verdict, out)?,
        Format::Csv => csv::print(verdict, out)?,
    }
    Ok(out.flush()?)
}
