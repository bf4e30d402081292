//! `exhibits.csv`.

use crate::exhibits::Exhibits;
use crate::output::csv::{number, text};
use std::io;

const HEADER: [&str; 8] = ["exhibit", "estimator", "draws", "replicates", "channel", "quantity", "value", "std_error"];

/// A number of an exhibit, with what it is about.
struct Row<'a> {
    exhibit: &'static str,
    estimator: &'a str,
    draws: u64,
    replicates: u64,
    channel: &'a str,
    quantity: &'static str,
    value: f64,
    std_error: f64,
}

/// One row per number; the pictures are files of their own.
pub(crate) fn csv(exhibits: &Exhibits) -> io::Result<String> {
    let mut file = csv::Writer::from_writer(Vec::new());
    file.write_record(HEADER)?;
    for row in nested(exhibits).into_iter().chain(shadow(exhibits)).chain(two_techniques(exhibits)) {
        let words = [row.exhibit.into(), row.estimator.into(), row.draws.to_string(), row.replicates.to_string()];
        let more = [row.channel.into(), row.quantity.into(), number(row.value), number(row.std_error)];
        file.write_record(words.into_iter().chain(more))?;
    }
    text(file)
}

fn nested(exhibits: &Exhibits) -> Vec<Row<'_>> {
    let exhibit = &exhibits.nested;
    let mut rows = vec![];
    for (channel, name) in exhibit.channels.iter().enumerate() {
        let row = |estimator, draws, replicates, quantity, value, std_error| Row {
            exhibit: "nested",
            estimator,
            draws,
            replicates,
            channel: name,
            quantity,
            value,
            std_error,
        };
        rows.push(row("naive_ratio", 0, 0, "bias_limit", exhibit.limit[channel], 0.0));
        for curve in &exhibit.curves {
            rows.extend(curve.points.iter().map(|point| {
                let (bias, error) = (point.bias[channel], point.std_error[channel]);
                row(curve.estimator, point.draws, point.replicates, "bias", bias, error)
            }));
        }
    }
    rows
}

fn shadow(exhibits: &Exhibits) -> Vec<Row<'_>> {
    let exhibit = &exhibits.shadow;
    let row = |estimator, quantity, value, std_error| Row {
        exhibit: "shadow",
        estimator,
        draws: exhibit.draws,
        replicates: exhibit.replicates,
        channel: "all",
        quantity,
        value,
        std_error,
    };
    let of = exhibit.estimators.iter().flat_map(|shaded| {
        let (rmse, error) = shaded.in_shadow;
        [
            row(shaded.estimator, "rmse_in_shadow", rmse, error),
            row(shaded.estimator, "rmse_in_light", shaded.in_light, f64::NAN),
        ]
    });
    of.collect()
}

fn two_techniques(exhibits: &Exhibits) -> Vec<Row<'_>> {
    let exhibit = &exhibits.two_techniques;
    let mut rows = vec![];
    for combination in &exhibit.estimators {
        let row = |draws, replicates, quantity, (value, std_error)| Row {
            exhibit: "two-techniques",
            estimator: combination.estimator,
            draws,
            replicates,
            channel: "all",
            quantity,
            value,
            std_error,
        };
        rows.push(row(0, 0, "n_mse_limit", (combination.predicted, 0.0)));
        for (i, (draws, replicates)) in exhibit.draws.iter().zip(&exhibit.replicates).enumerate() {
            rows.push(row(*draws, *replicates, "n_mse", combination.measured[i]));
            rows.push(row(*draws, *replicates, "bias", combination.bias[i]));
        }
    }
    rows
}
