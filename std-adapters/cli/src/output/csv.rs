//! One row per estimate. Unknown numbers are empty.

use crate::verdict::Verdict;
use std::io::{self, Write};

pub(super) fn print(verdict: &Verdict, out: &mut dyn Write) -> io::Result<()> {
    let mut rows = csv::Writer::from_writer(out);
    let header = ["estimator", "auxiliary", "channel", "value", "std_error", "flags", "predicted_mse", "favoured"];
    rows.write_record(header).map_err(as_io)?;
    for line in &verdict.estimates {
        let is = |favoured: Option<_>| favoured == Some(line);
        let favoured = match (is(verdict.favoured(line.channel)), is(verdict.favoured_unbiased(line.channel))) {
            (true, _) => "yes",
            (false, true) => "unbiased",
            (false, false) => "",
        };
        let flags: Vec<_> = line.estimate.flags.names().collect();
        let fields = [
            line.method.id(),
            line.auxiliary.as_deref().unwrap_or_default(),
            &verdict.channels[line.channel],
            &known(line.estimate.value),
            &known(line.estimate.std_error),
            &flags.join(" "),
            &known(line.predicted_mse),
            favoured,
        ];
        rows.write_record(fields).map_err(as_io)?;
    }
    rows.flush()
}

fn known(number: f64) -> String {
    if number.is_finite() { format!("{number:?}") } else { String::new() }
}

/// `io::Error::from` would hide what kind of error it is: a closed pipe is none.
fn as_io(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}
