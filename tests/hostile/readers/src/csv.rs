//! `ratiocv estimate` on any bytes.

use clap::Parser;
use ratiocv_cli::arguments::{Arguments, Command, EstimateArguments};
use ratiocv_cli::estimate::estimate;

/// A file of draws, after a first byte that chooses the options: a table, JSON or CSV that is one, with as many draws as
/// there are good rows; or an error that names the file and the remedy.
pub fn csv(bytes: &[u8]) {
    let Some((options, text)) = bytes.split_first() else { return };
    let format = ["table", "json", "csv"][usize::from(options % 3)];
    let policy = ["error", "skip"][usize::from(options / 3 % 2)];
    let weight = ["0", "0.01", "0.999"][usize::from(options / 6 % 3)];
    let (mut out, mut notes) = (Vec::new(), Vec::new());
    match estimate(text, "any.csv", None, &arguments(format, policy, weight), &mut out, &mut notes) {
        Ok(()) => {
            let out = String::from_utf8(out).expect("output is UTF-8");
            if format == "json" {
                serde_json::from_str::<serde_json::Value>(&out).expect("output is JSON");
            } else if format == "csv" {
                assert!(!out.contains("NaN") && !out.contains("inf"), "{out}");
            }
            // Whatever the rows are, none has another number of commas than the header, but in quotes.
            let lossy = String::from_utf8_lossy(text);
            let mut lines = lossy.lines().filter(|line| !line.trim_ascii().is_empty());
            let commas = |line: &str| line.matches(',').count();
            let header = lines.next().map_or(0, commas);
            let ragged = !text.contains(&b'"') && !text.contains(&b'\r') && lines.any(|line| commas(line) != header);
            assert!(policy == "skip" || !ragged, "a row with too few or too many fields was read:\n{lossy}");
        }
        Err(fault) => {
            let fault = fault.to_string();
            assert!(fault.starts_with("any.csv") && fault.contains("help: "), "{fault}");
        }
    }
}

fn arguments(format: &str, policy: &str, weight: &str) -> EstimateArguments {
    let line = ["ratiocv", "estimate", "-", "--format", format, "--on-bad-draw", policy, "--defensive", weight];
    match Arguments::try_parse_from(line).expect("a good command line").command {
        Some(Command::Estimate(arguments)) => arguments,
        other => panic!("{other:?}"),
    }
}
