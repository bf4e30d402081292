//! Text to rows of fields: one line is one row.
//!
//! A number never contains a line end, so rows are cut at line ends first and quotes are undone
//! within a line. That keeps line numbers exact, and an unclosed quote spoils its own row instead of
//! swallowing all that follow.

use core::mem;
use core::ops::Range;
use csv_core::{ReadRecordResult, Reader, ReaderBuilder, Terminator};
use memchr::{memchr, memchr_iter};
use std::io::{self, BufRead};

/// A line longer than this is not a row of numbers.
const LONGEST_LINE: usize = 16 << 20;

/// The rows of a CSV text, one at a time, in memory that does not grow with their number.
#[derive(Debug)]
pub struct Rows<R> {
    input: R,
    number: u64,
    bytes: u64,
    line: String,
    unquoted: Vec<u8>,
    unquoted_text: String,
    ends: Vec<usize>,
    spans: Vec<Range<usize>>,
    quotes: Reader,
}

/// One row.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// The number of its line in the file, from 1.
    pub line: u64,
    /// Whether a quote is opened in it and not closed; it has no fields then.
    pub open_quote: bool,
    text: &'a str,
    spans: &'a [Range<usize>],
}

impl<'a> Row<'a> {
    /// How many fields it has.
    pub fn len(&self) -> usize {
        self.spans.len()
    }

    /// Whether it has no field.
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// The fields.
    pub fn fields(&self) -> impl Iterator<Item = &'a str> {
        let text = self.text;
        self.spans.iter().map(move |span| &text[span.clone()])
    }
}

/// Why there is no further row, though the text does not end.
#[derive(Debug)]
pub enum Unreadable {
    /// The system says so.
    Io(io::Error),
    /// This line does not end.
    TooLong(u64),
}

impl<R: BufRead> Rows<R> {
    /// The rows of `input`.
    pub fn new(input: R) -> Self {
        Self {
            input,
            number: 0,
            bytes: 0,
            line: String::new(),
            unquoted: Vec::new(),
            unquoted_text: String::new(),
            ends: Vec::new(),
            spans: Vec::new(),
            quotes: ReaderBuilder::new().terminator(Terminator::Any(b'\n')).build(),
        }
    }

    /// How many bytes were read.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The next row that is not blank, or `None` at the end.
    ///
    /// # Errors
    /// [`Unreadable`].
    pub fn next_row(&mut self) -> Result<Option<Row<'_>>, Unreadable> {
        loop {
            if !self.next_line()? {
                return Ok(None);
            }
            if !self.line.bytes().all(|byte| byte.is_ascii_whitespace()) {
                break;
            }
        }
        let quoted = memchr(b'"', self.line.as_bytes()).is_some();
        let open_quote = quoted && !self.cut_quoted();
        if !quoted {
            self.cut();
        }
        let text = if quoted { &self.unquoted_text } else { &self.line };
        Ok(Some(Row { line: self.number, open_quote, text, spans: &self.spans }))
    }

    /// Reads a line without its end; false at the end of the text.
    fn next_line(&mut self) -> Result<bool, Unreadable> {
        let mut line = mem::take(&mut self.line).into_bytes();
        line.clear();
        let read = read_line(&mut self.input, &mut line).map_err(Unreadable::Io)?;
        if read == 0 {
            return Ok(false);
        }
        self.number += 1;
        self.bytes += read as u64;
        if line.last() == Some(&b'\n') {
            line.pop();
        } else if read > LONGEST_LINE {
            return Err(Unreadable::TooLong(self.number));
        }
        if line.last() == Some(&b'\r') {
            line.pop();
        }
        if self.number == 1 && line.starts_with(b"\xef\xbb\xbf") {
            line.drain(..3); // the byte-order mark that some spreadsheets write
        }
        self.line = into_text(line);
        Ok(true)
    }

    fn cut(&mut self) {
        self.spans.clear();
        let mut start = 0;
        for at in memchr_iter(b',', self.line.as_bytes()) {
            self.spans.push(start..at);
            start = at + 1;
        }
        self.spans.push(start..self.line.len());
    }

    /// Undoes the quotes; false if one is left open.
    fn cut_quoted(&mut self) -> bool {
        self.spans.clear();
        self.line.push('\n');
        self.unquoted.resize(self.line.len(), 0);
        self.ends.resize(self.line.len(), 0);
        self.quotes.reset();
        let (result, _, _, fields) = self.quotes.read_record(self.line.as_bytes(), &mut self.unquoted, &mut self.ends);
        if !matches!(result, ReadRecordResult::Record) {
            return false;
        }
        let mut start = 0;
        for end in &self.ends[..fields] {
            self.spans.push(start..*end);
            start = *end;
        }
        let mut text = mem::take(&mut self.unquoted_text).into_bytes();
        text.clear();
        text.extend_from_slice(&self.unquoted[..start]);
        // Quotes and commas are ASCII: what is left between them is still UTF-8.
        self.unquoted_text = into_text(text);
        true
    }
}

/// Reads up to and with the next line feed, but not far beyond [`LONGEST_LINE`].
fn read_line(input: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<usize> {
    loop {
        let buffer = match input.fill_buf() {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            buffer => buffer?,
        };
        let end = memchr(b'\n', buffer).map(|at| at + 1);
        let taken = end.unwrap_or(buffer.len());
        line.extend_from_slice(&buffer[..taken]);
        input.consume(taken);
        if end.is_some() || taken == 0 || line.len() > LONGEST_LINE {
            return Ok(line.len());
        }
    }
}

/// Checked as UTF-8 once per line, not once per field; what is none will not be a number either.
fn into_text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned())
}

#[cfg(test)]
mod tests {
    use super::Rows;

    fn all(text: &[u8]) -> Vec<(u64, Option<Vec<String>>)> {
        let mut rows = Rows::new(text);
        let mut all = Vec::new();
        while let Some(row) = rows.next_row().expect("memory can be read") {
            let fields = row.fields().map(|field| field.to_owned()).collect();
            all.push((row.line, (!row.open_quote).then_some(fields)));
        }
        all
    }

    fn row(line: u64, fields: &[&str]) -> (u64, Option<Vec<String>>) {
        (line, Some(fields.iter().map(ToString::to_string).collect()))
    }

    #[test]
    fn lines_end_in_any_way_and_keep_their_numbers() {
        let text = b"\xef\xbb\xbfa,b\r\n\r\n1,2\n \n3,4";
        assert_eq!(all(text), [row(1, &["a", "b"]), row(3, &["1", "2"]), row(5, &["3", "4"])]);
        assert_eq!(all(b""), []);
        assert_eq!(all(b"\n\n"), []);
    }

    #[test]
    fn quotes_are_undone() {
        let text = b"\"a\",\"b,\"\"c\"\"\"\r\n1,\"2\"\n,\n";
        assert_eq!(all(text), [row(1, &["a", "b,\"c\""]), row(2, &["1", "2"]), row(3, &["", ""])]);
    }

    #[test]
    fn an_open_quote_spoils_its_own_row_alone() {
        assert_eq!(all(b"a\n\"1,2\n3\n\"4"), [row(1, &["a"]), (2, None), row(3, &["3"]), (4, None)]);
    }
}
