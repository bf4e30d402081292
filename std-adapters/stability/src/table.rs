//! The rows, as text and as JSON.

use crate::case::Case;
use crate::row::{Contender, Row, shown_digits};
use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, LineStyle, TableStyle};
use core::fmt;

const WIDTH: u16 = 132;

/// All rows.
#[derive(Clone, Debug)]
pub struct Table {
    /// In the order of the cases.
    pub rows: Vec<Row>,
}

/// A line of JSON; unknown numbers are null.
#[derive(serde::Serialize)]
struct Line<'a> {
    section: &'a str,
    id: &'a str,
    about: &'a str,
    precision: crate::Precision,
    asked: &'a str,
    right: Option<f64>,
    value: Option<f64>,
    std_error: Option<f64>,
    flags: Vec<&'static str>,
    digits: f64,
    needed: f64,
    naive: Option<f64>,
    naive_digits: Option<f64>,
    runs: usize,
    passes: bool,
    flagged_in_place_of_right: bool,
    broken: Option<&'a str>,
}

impl Table {
    /// Runs `cases`.
    pub fn of(cases: impl IntoIterator<Item = Case>, contender: Contender) -> Self {
        Self { rows: cases.into_iter().map(|case| Row::of(&case, contender)).collect() }
    }

    /// The rows that fail.
    pub fn failures(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| !row.passes())
    }

    /// How many rows, runs, rows that are not right but flagged, and failures.
    pub fn summary(&self) -> String {
        let runs: usize = self.rows.iter().map(|row| row.runs).sum();
        let flagged = self.rows.iter().filter(|row| row.excused()).count();
        let failed = self.failures().count();
        format!("{} rows, {runs} runs, {flagged} flagged in place of right, {failed} failed", self.rows.len())
    }

    /// One JSON object on one line. Digits are at most 17, for every bit, and at least −1, for none.
    ///
    /// # Errors
    /// None that is known of: numbers and strings alone are written.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        #[derive(serde::Serialize)]
        struct Document<'a> {
            rows: Vec<Line<'a>>,
            failed: usize,
        }
        let rows = self.rows.iter().map(line).collect();
        serde_json::to_string(&Document { rows, failed: self.failures().count() })
    }
}

fn line(row: &Row) -> Line<'_> {
    let known = |x: f64| x.is_finite().then_some(x);
    let digits = |x: f64| if x >= -1.0 { x } else { -1.0 };
    Line {
        section: row.section,
        id: row.id,
        about: row.about,
        precision: row.precision,
        asked: &row.asked,
        right: known(row.right),
        value: known(row.ours.value),
        std_error: known(row.ours.std_error),
        flags: row.ours.flags.names().collect(),
        digits: digits(row.digits),
        needed: digits(row.needed),
        naive: row.naive.and_then(known),
        naive_digits: row.naive_digits.map(digits),
        runs: row.runs,
        passes: row.passes(),
        flagged_in_place_of_right: row.excused(),
        broken: row.broken.as_deref(),
    }
}

/// A number as short as it may be.
pub(crate) fn short(x: f64) -> String {
    if x.is_nan() {
        return "unknown".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "∞".into() } else { "−∞".into() };
    }
    let (plain, scientific) = (format!("{x}"), format!("{x:e}"));
    let shortest = if plain.len() <= scientific.len() { plain } else { scientific };
    if shortest.len() <= 12 { shortest } else { format!("{x:.6e}") }
}

/// What a row says in each column of [`HEADER`].
pub(crate) fn cells(row: &Row) -> [String; 11] {
    [
        row.id.into(),
        row.precision.name().into(),
        row.about.into(),
        row.asked.clone(),
        short(row.right),
        short(row.ours.value),
        short(row.ours.std_error),
        row.naive.map_or_else(|| "–".into(), |naive| if naive.is_nan() { "NaN".into() } else { short(naive) }),
        format!("{} ({})", shown_digits(row.digits), shown_digits(row.needed)),
        row.ours.flags.to_string(),
        verdict(row).into(),
    ]
}

/// Right, not right but not silent, or wrong.
fn verdict(row: &Row) -> &'static str {
    match (row.passes(), row.excused()) {
        (false, _) => "FAILS",
        (_, true) => "flagged",
        _ => "ok",
    }
}

/// The columns.
pub(crate) const HEADER: [&str; 11] = [
    "case",
    "",
    "what is hard",
    "asked",
    "right",
    "ours",
    "± error",
    "textbook",
    "digits (needed)",
    "flags",
    "verdict",
];

/// A table for the terminal.
impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = comfy_table::Table::new();
        table.load_style(TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─')));
        table.set_content_arrangement(ContentArrangement::Dynamic);
        table.force_no_tty().set_width(WIDTH).set_header(HEADER);
        for row in &self.rows {
            table.add_row(cells(row));
        }
        // Names are looked for, and not broken.
        if let Some(names) = table.column_mut(0) {
            names.set_constraint(ColumnConstraint::ContentWidth);
        }
        for column in table.column_iter_mut().filter(|column| (4..9).contains(&column.index)) {
            column.set_cell_alignment(CellAlignment::Right);
        }
        writeln!(f, "{table}\n")?;
        for row in self.failures() {
            writeln!(f, "{} {}: {}", row.id, row.precision.name(), row.broken.as_deref().unwrap_or_default())?;
        }
        write!(f, "{}", self.summary())
    }
}
