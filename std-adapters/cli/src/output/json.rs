//! One JSON object, on one line. Unknown numbers are null.

use crate::verdict::{Line, Verdict};
use serde::{Serialize, Serializer};
use std::io::{self, Write};

#[derive(Serialize)]
struct Document<'a> {
    draws: u64,
    skipped: u64,
    channels: &'a [String],
    integrals: InOrder<'a>,
    estimates: Vec<Estimate<'a>>,
    favoured: Vec<Favoured<'a>>,
    favoured_unbiased: Vec<Favoured<'a>>,
}

/// A map that keeps the order of the columns.
struct InOrder<'a>(&'a Verdict);

impl Serialize for InOrder<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.integrals.iter().map(|known| (&known.column, known.value)))
    }
}

#[derive(Serialize)]
struct Estimate<'a> {
    estimator: &'static str,
    auxiliary: Option<&'a str>,
    channel: &'a str,
    value: Option<f64>,
    std_error: Option<f64>,
    flags: Vec<&'static str>,
}

#[derive(Serialize)]
struct Favoured<'a> {
    channel: &'a str,
    estimator: &'static str,
    auxiliary: Option<&'a str>,
    predicted_mse: f64,
}

pub(super) fn print(verdict: &Verdict, out: &mut dyn Write) -> io::Result<()> {
    let channels = &verdict.channels;
    let estimates = verdict.estimates.iter().map(|line| Estimate {
        estimator: line.method.id(),
        auxiliary: line.auxiliary.as_deref(),
        channel: &channels[line.channel],
        value: known(line.estimate.value),
        std_error: known(line.estimate.std_error),
        flags: line.estimate.flags.names().collect(),
    });
    let document = Document {
        draws: verdict.draws,
        skipped: verdict.skipped,
        channels,
        integrals: InOrder(verdict),
        estimates: estimates.collect(),
        favoured: all(verdict, |channel| verdict.favoured(channel)),
        favoured_unbiased: all(verdict, |channel| verdict.favoured_unbiased(channel)),
    };
    serde_json::to_writer(&mut *out, &document)?;
    writeln!(out)
}

fn all<'a>(verdict: &'a Verdict, favoured: impl Fn(usize) -> Option<&'a Line>) -> Vec<Favoured<'a>> {
    let of_channel = |line: &'a Line| Favoured {
        channel: &verdict.channels[line.channel],
        estimator: line.method.id(),
        auxiliary: line.auxiliary.as_deref(),
        predicted_mse: line.predicted_mse,
    };
    (0..verdict.channels.len()).filter_map(favoured).map(of_channel).collect()
}

fn known(number: f64) -> Option<f64> {
    number.is_finite().then_some(number)
}
