//! `ratiocv stability`: stiff cases with known answers, and what becomes of them.

use crate::arguments::{StabilityArguments, StabilityFormat};
use crate::fault::Fault;
use crate::words::rows;
use ratiocv_stability::{Contender, Table, cases};
use std::io::Write;

/// Runs the cases that are asked for and prints their table to `out`.
///
/// # Errors
/// An id that no case has; rows that fail, after all of them are printed.
pub fn run(arguments: &StabilityArguments, out: &mut dyn Write) -> Result<(), Fault> {
    let mut chosen = Vec::new();
    for id in &arguments.only {
        let named = cases::named(id);
        if named.is_empty() {
            let what = format!("there is no case '{id}'");
            return Err(Fault::usage(what, "give a section, A to H or StRD, or a case of it, such as A10"));
        }
        chosen.extend(named);
    }
    let contender = if arguments.textbook { Contender::Naive } else { Contender::Ours };
    let table = Table::of(if arguments.only.is_empty() { cases::all() } else { chosen }, contender);
    match arguments.format {
        StabilityFormat::Table => writeln!(out, "{table}")?,
        StabilityFormat::Json => {
            let json = table.json().map_err(|error| Fault::data(error.to_string(), "take --format table"))?;
            writeln!(out, "{json}")?;
        }
        StabilityFormat::Html => write!(out, "{}", table.page())?,
    }
    out.flush()?;
    match table.failures().count() as u64 {
        0 => Ok(()),
        failed if arguments.textbook => {
            let what = format!("{} failed", rows(failed));
            Err(Fault::data(what, "these are the textbook's; without --textbook the library's own are judged"))
        }
        failed => {
            let what = format!("{} failed", rows(failed));
            Err(Fault::data(what, "the table says which; please report it with the output of --format json"))
        }
    }
}
