//! From rows to accumulators, in memory that does not grow with the number of draws.

use crate::columns::Columns;
use crate::fault::Fault;
use crate::integrals::Known;
use crate::number;
use crate::rows::{Row, Rows, Unreadable};
use ratiocv_core::moments::{Accumulate, Blocked, ExtremesBlock, IntegrandOf, Joined, Moments, UnivariateBlock};
use ratiocv_core::{Draw, Error, Integrals, planted};
use ratiocv_report::catalogue::{Diagnosed, everything};
use std::io::BufRead;

/// What the plain mean reads. On its own, so that no auxiliary can touch it.
pub type PlainMoments = Blocked<f64, Joined<UnivariateBlock<IntegrandOf<f64, 1>, 1>, (), (), ExtremesBlock<f64>>>;

/// What to do with a row that is not a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum OnBadDraw {
    /// Stop with an error.
    Error,
    /// Leave the whole row out, and count it.
    Skip,
}

/// Accumulators of all channels and auxiliaries, and what was read into them.
#[derive(Debug)]
pub struct Intake {
    /// How many draws were read.
    pub draws: u64,
    /// How many rows were left out.
    pub skipped: u64,
    /// Where the first of these is, and what is wrong with it.
    pub first_skipped: Option<String>,
    /// The channels, as in [`Columns`].
    pub channels: Vec<ChannelMoments>,
    columns: Columns,
    values: Vec<f64>,
}

/// The accumulators of one channel.
#[derive(Debug)]
pub struct ChannelMoments {
    /// Of f alone.
    pub plain: PlainMoments,
    /// Of f with each auxiliary.
    pub auxiliaries: Vec<Diagnosed<f64>>,
    pending: Vec<Vec<Draw<f64>>>,
}

/// Draws that wait for the accumulators, which are fastest by the batch.
const BATCH: usize = 256;

/// How often progress is shown, in draws.
const SHOW_EVERY: u64 = 1 << 14;

/// Why a row is not a draw.
struct BadDraw {
    column: Option<usize>,
    what: String,
}

impl BadDraw {
    #[cold]
    fn at(column: usize, what: impl Into<String>) -> Self {
        Self { column: Some(column), what: what.into() }
    }
}

impl Intake {
    /// Empty accumulators for these columns; `integrals` in the order of [`Columns::auxiliaries`].
    ///
    /// # Errors
    /// [`Error::Weight`].
    pub fn new(columns: Columns, integrals: &[Known], weight: f64) -> Result<Self, Error> {
        let mut integrals = integrals.iter();
        let channels = columns.channels.iter().map(|channel| {
            let known = integrals.by_ref().take(channel.auxiliaries.len());
            let auxiliaries = known.map(|known| everything(weight, &Integrals::new([known.value])));
            Ok(ChannelMoments {
                plain: PlainMoments::default(),
                auxiliaries: auxiliaries.collect::<Result<_, Error>>()?,
                pending: vec![Vec::with_capacity(BATCH); channel.auxiliaries.len().max(1)],
            })
        });
        Ok(Self {
            draws: 0,
            skipped: 0,
            first_skipped: None,
            channels: channels.collect::<Result<_, Error>>()?,
            values: vec![0.0; columns.names.len()],
            columns,
        })
    }

    /// Reads all `rows` of the file called `file`; `show` is told from time to time how many bytes
    /// and draws were read.
    ///
    /// # Errors
    /// A file that cannot be read, a bad draw unless they are skipped, and no draw at all.
    pub fn read(
        &mut self,
        rows: &mut Rows<impl BufRead>,
        file: &str,
        on_bad_draw: OnBadDraw,
        mut show: impl FnMut(u64, u64),
    ) -> Result<(), Fault> {
        loop {
            if (self.draws + self.skipped).is_multiple_of(SHOW_EVERY) {
                show(rows.bytes(), self.draws);
            }
            let row = match rows.next_row() {
                Ok(Some(row)) => row,
                Ok(None) => break,
                Err(error) => return Err(unreadable(&error, file).after(self.so_far())),
            };
            match self.take(&row) {
                Ok(()) => {}
                Err(bad) => {
                    let place = self.place(file, row.line, bad.column);
                    if on_bad_draw == OnBadDraw::Error {
                        let remedy = "correct the line, or leave such rows out with --on-bad-draw skip";
                        return Err(Fault::data(format!("{place}: {}", bad.what), remedy).after(self.so_far()));
                    }
                    self.skipped += 1;
                    self.first_skipped.get_or_insert_with(|| format!("{place}: {}", bad.what));
                }
            }
        }
        self.flush();
        match (self.draws, &self.first_skipped) {
            (1.., _) => Ok(()),
            (0, None) => {
                Err(Fault::data(format!("{file}: there is no draw after the header"), "add rows, one per draw"))
            }
            (0, Some(first)) => {
                let what =
                    format!("{file}: no draw is left: all {} rows were skipped; the first is {first}", self.skipped);
                Err(Fault::data(what, "correct the file"))
            }
        }
    }

    /// Takes one row as a draw, as a whole or not at all.
    #[inline]
    fn take(&mut self, row: &Row<'_>) -> Result<(), BadDraw> {
        let Self { columns, values, .. } = self;
        if row.open_quote {
            return Err(BadDraw { column: None, what: "a quote is opened and not closed".into() });
        }
        if planted!("csv_ragged": row.len() != values.len(), row.len() > values.len()) {
            return Err(ragged(row.len(), values.len()));
        }
        for (column, (value, field)) in values.iter_mut().zip(row.fields()).enumerate() {
            *value = number::parse(field).map_err(|error| BadDraw::at(column, error.to_string()))?;
        }
        if let Some(pdf) = columns.pdf {
            divide(values, pdf, &columns.names)?;
        }
        for (channel, moments) in columns.channels.iter().zip(&mut self.channels) {
            let f = values[channel.f];
            if channel.auxiliaries.is_empty() {
                moments.pending[0].push(Draw::new(f, 0.0));
            }
            for ((_, h), pending) in channel.auxiliaries.iter().zip(&mut moments.pending) {
                pending.push(Draw::new(f, values[*h]));
            }
        }
        self.draws += 1;
        if self.draws.is_multiple_of(BATCH as u64) {
            self.flush();
        }
        Ok(())
    }

    fn flush(&mut self) {
        for ChannelMoments { plain, auxiliaries, pending } in &mut self.channels {
            plain.add_batch(&pending[0]);
            for (moments, pending) in auxiliaries.iter_mut().zip(&*pending) {
                moments.add_batch(pending);
            }
            pending.iter_mut().for_each(Vec::clear);
        }
    }

    /// The accumulators, none of them with an open block.
    pub fn closed(&self) -> Vec<(PlainMoments, Vec<Diagnosed<f64>>)> {
        let close = |moments: &ChannelMoments| {
            (moments.plain.closed(), moments.auxiliaries.iter().map(Moments::closed).collect())
        };
        self.channels.iter().map(close).collect()
    }

    fn place(&self, file: &str, line: u64, column: Option<usize>) -> String {
        match column {
            None => format!("{file}, line {line}"),
            Some(column) => format!("{file}, line {line}, column {} ({})", column + 1, self.columns.names[column]),
        }
    }

    fn so_far(&self) -> String {
        match self.draws {
            0 => "no draw had been read before it".into(),
            1 => "1 draw before it was read without fault; no estimate was made of it".into(),
            draws => format!("{draws} draws before it were read without fault; no estimate was made of them"),
        }
    }
}

/// Divides all other columns by the pdf; 0/0 is 0, a draw of nothing that could not be sampled.
#[inline]
fn divide(values: &mut [f64], pdf: usize, names: &[String]) -> Result<(), BadDraw> {
    let density = values[pdf];
    if density < 0.0 {
        return Err(BadDraw::at(pdf, format!("the pdf is negative ({density})")));
    }
    for column in (0..values.len()).filter(|column| *column != pdf) {
        let value = values[column];
        if value == 0.0 {
            continue;
        }
        // Divided, not multiplied by a reciprocal: 1/pdf may overflow where value/pdf does not.
        values[column] = value / density;
        if !values[column].is_finite() {
            let why = if density == 0.0 { "it cannot have been drawn" } else { "the quotient overflows" };
            return Err(BadDraw::at(column, format!("{} is {value} where the pdf is {density}: {why}", names[column])));
        }
    }
    Ok(())
}

#[cold]
fn ragged(got: usize, expected: usize) -> BadDraw {
    let fields = if got == 1 { "field" } else { "fields" };
    BadDraw { column: None, what: format!("{got} {fields}, but the header has {expected}") }
}

/// A file that cannot be read any further.
pub fn unreadable(error: &Unreadable, file: &str) -> Fault {
    match error {
        Unreadable::Io(error) => {
            Fault::data(format!("cannot read {file}: {error}"), "check the file's name and rights")
        }
        Unreadable::TooLong(line) => Fault::data(
            format!("{file}, line {line}: the line does not end within 16 MiB"),
            "is this a CSV file, one line per draw?",
        ),
    }
}
