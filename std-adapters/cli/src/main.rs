//! The `ratiocv` binary: parse, run, exit.

use clap::Parser;
use ratiocv_cli::arguments::{Arguments, Command};
use ratiocv_cli::{estimate, list, render, report, stability, style};
use std::io::{BufWriter, IsTerminal, Write, stderr, stdout};
use std::process::ExitCode;

fn main() -> ExitCode {
    let Arguments { command, report } = Arguments::parse();
    let bold = style::is_wanted(stdout().is_terminal(), std::env::var_os("NO_COLOR").as_deref());
    let mut out = BufWriter::new(stdout().lock());
    let mut notes = stderr();
    let done = match command {
        None => report::run(&report, bold, &mut out, &mut notes),
        Some(Command::Report(report)) => report::run(&report, bold, &mut out, &mut notes),
        Some(Command::Render(arguments)) => render::run(&arguments, &mut out, &mut notes),
        Some(Command::List) => list::run(&mut out),
        Some(Command::Estimate(arguments)) => estimate::run(&arguments, &mut out, &mut notes),
        Some(Command::Stability(arguments)) => stability::run(&arguments, &mut out),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) => {
            if !fault.is_silent() {
                // A closed stderr is no reason to panic.
                let _ = writeln!(notes, "error: {fault}");
            }
            // The buffer is dropped, not flushed again: what failed once would fail again.
            let _ = out.into_parts();
            ExitCode::from(fault.exit_code())
        }
    }
}
