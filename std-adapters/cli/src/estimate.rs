//! `ratiocv estimate`: every estimator, applied to draws that the user already has.

use crate::arguments::EstimateArguments;
use crate::columns::Columns;
use crate::fault::Fault;
use crate::intake::{Intake, unreadable};
use crate::integrals;
use crate::output::{self, Format};
use crate::progress;
use crate::rows::Rows;
use crate::verdict::Verdict;
use crate::words;
use ratiocv_report::catalogue::Method;
use std::fs::File;
use std::io::{BufRead, BufReader, Write, stdin};
use std::path::Path;

/// How much of a file is read at a time.
const BUFFER: usize = 1 << 18;

/// Runs the command: output to `out`, remarks to `notes`.
///
/// # Errors
/// What is wrong with the file, the command line or the output.
pub fn run(arguments: &EstimateArguments, out: &mut dyn Write, notes: &mut dyn Write) -> Result<(), Fault> {
    if arguments.file == Path::new("-") {
        return estimate(BufReader::with_capacity(BUFFER, stdin().lock()), "<stdin>", None, arguments, out, notes);
    }
    let name = arguments.file.display().to_string();
    let open = || {
        let file = File::open(&arguments.file)?;
        let about = file.metadata()?;
        if about.is_dir() {
            return Err(std::io::Error::other("it is a directory"));
        }
        Ok((file, about.is_file().then_some(about.len())))
    };
    let (file, bytes) = open().map_err(|error| {
        Fault::data(format!("cannot read {name}: {error}"), "check the file's name and rights; - reads standard input")
    })?;
    estimate(BufReader::with_capacity(BUFFER, file), &name, bytes, arguments, out, notes)
}

/// Estimates from the text `input` of `bytes` bytes, called `file` in messages.
///
/// # Errors
/// As [`run`].
pub fn estimate(
    input: impl BufRead,
    file: &str,
    bytes: Option<u64>,
    arguments: &EstimateArguments,
    out: &mut dyn Write,
    notes: &mut dyn Write,
) -> Result<(), Fault> {
    let methods = arguments.methods();
    let mut rows = Rows::new(input);
    let columns = header(&mut rows, file, methods.iter().any(|method| *method != Method::PLAIN))?;
    let known = integrals::of_columns(&columns, &arguments.integral, file)?;
    let mut intake = Intake::new(columns.clone(), &known, arguments.defensive)
        .map_err(|error| Fault::usage(error.to_string(), "give another --defensive"))?;

    let bar = progress::of_reading(bytes);
    let read = intake.read(&mut rows, file, arguments.on_bad_draw, |bytes, draws| {
        bar.set_position(bytes);
        bar.set_message(draws.to_string());
    });
    bar.finish_and_clear();
    read?;

    let verdict = Verdict::new(file, &columns, &intake, known, arguments.defensive, &methods);
    // Remarks that cannot be told from the output; a closed stderr is no reason to fail.
    if let Some(first) = &intake.first_skipped {
        let _ = writeln!(notes, "note: skipped {}; the first is {first}", words::rows(intake.skipped));
    }
    let assumed = verdict.assumed();
    if arguments.format != Format::Table && !assumed.is_empty() && methods != [Method::PLAIN] {
        let _ = writeln!(notes, "note: no --integral for {}: taken to be 1", words::listed(&assumed));
    }
    output::print(&verdict, arguments.format, out)
}

fn header(rows: &mut Rows<impl BufRead>, file: &str, need_auxiliaries: bool) -> Result<Columns, Fault> {
    let Some(header) = rows.next_row().map_err(|error| unreadable(&error, file))? else {
        let remedy = "give a header such as f.r,h.r, and one row per draw";
        return Err(Fault::data(format!("{file}: the file is empty"), remedy));
    };
    if header.open_quote {
        let what = format!("{file}, line {}: a quote is opened in the header and not closed", header.line);
        return Err(Fault::data(what, "close it"));
    }
    Columns::new(&header, need_auxiliaries).map_err(|bad| {
        let column = bad.column.map_or_else(String::new, |column| format!(", column {}", column + 1));
        Fault::data(format!("{file}, line {}{column}: {}", header.line, bad.what), bad.remedy)
    })
}
