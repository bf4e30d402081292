//! What `ratiocv estimate` prints.

mod csv;
mod json;
mod number;
mod table;

use crate::arguments::Format;
use crate::fault::Fault;
use crate::verdict::Verdict;
use std::io::Write;

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

/// `1 row`, `2 rows`.
pub fn rows(count: u64) -> String {
    counted(count, "row")
}

/// `names`, the first few of many.
pub fn listed<T: AsRef<str>>(names: &[T]) -> String {
    const SHOWN: usize = 8;
    let mut list = names.iter().take(SHOWN).map(AsRef::as_ref).collect::<Vec<_>>().join(", ");
    if names.len() > SHOWN {
        list += &format!(" and {} more", names.len() - SHOWN);
    }
    list
}

fn counted(count: u64, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
