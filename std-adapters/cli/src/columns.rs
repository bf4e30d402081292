//! What the header says: which column is f, h or the pdf, and of which channel.

use crate::number::shown;
use crate::rows::Row;

/// The columns of a file of draws.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    /// Every column's name.
    pub names: Vec<String>,
    /// The channels, in the order of their `f` columns.
    pub channels: Vec<Channel>,
    /// The column by which the others are to be divided.
    pub pdf: Option<usize>,
}

/// A channel: its integrand, and any number of auxiliaries.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// The name.
    pub name: String,
    /// The column of f.
    pub f: usize,
    /// The auxiliaries' names (`h`, `h2`, …) and columns.
    pub auxiliaries: Vec<(String, usize)>,
}

/// What is wrong with a header.
#[derive(Clone, Debug, PartialEq)]
pub struct BadHeader {
    /// The column, from 0, if it is one column's fault.
    pub column: Option<usize>,
    /// What is wrong.
    pub what: String,
    /// What to do about it.
    pub remedy: String,
}

/// How columns are named, for messages.
pub const NAMING: &str = "columns are named f.CHANNEL, h.CHANNEL (h2.CHANNEL, … for further auxiliaries) and pdf";

impl BadHeader {
    fn at(column: usize, what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { column: Some(column), what: what.into(), remedy: remedy.into() }
    }

    fn of_all(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { column: None, what: what.into(), remedy: remedy.into() }
    }
}

enum Role<'a> {
    F(&'a str),
    H(&'a str, &'a str),
    Pdf,
}

fn role(name: &str) -> Option<Role<'_>> {
    if name == "pdf" {
        return Some(Role::Pdf);
    }
    let (kind, channel) = name.split_once('.').filter(|(_, channel)| !channel.is_empty())?;
    if kind == "f" { Some(Role::F(channel)) } else { is_auxiliary(kind).then_some(Role::H(kind, channel)) }
}

/// Whether `name` is `h`, `h2`, `h3`, …
fn is_auxiliary(name: &str) -> bool {
    let Some(number) = name.strip_prefix('h') else { return false };
    number.is_empty()
        || (number.parse::<u32>().is_ok_and(|n| n >= 2) && number.starts_with(|c| ('1'..='9').contains(&c)))
}

/// Whether `name` can be an auxiliary's column, such as `h.r`.
pub fn names_an_auxiliary(name: &str) -> bool {
    matches!(role(name), Some(Role::H(..)))
}

impl Columns {
    /// The columns that `header` names. `need_auxiliaries`: every channel must have one.
    ///
    /// # Errors
    /// [`BadHeader`].
    pub fn new(header: &Row<'_>, need_auxiliaries: bool) -> Result<Self, BadHeader> {
        let fields: Vec<&str> = header.fields().collect();
        judge_encoding(&fields)?;
        let names: Vec<String> = fields.iter().map(|field| field.trim().to_owned()).collect();
        judge_separator(&names)?;
        for (column, name) in names.iter().enumerate() {
            if let Some(first) = names[..column].iter().position(|other| other == name) {
                let what = format!("column {name} stands here and in column {} too", first + 1);
                return Err(BadHeader::at(column, what, "rename or remove one of the two"));
            }
        }
        let mut columns = Self { names: names.clone(), channels: Vec::new(), pdf: None };
        for (column, name) in names.iter().enumerate() {
            match role(name) {
                None => return Err(unknown(column, name)),
                Some(Role::Pdf) => columns.pdf = Some(column),
                Some(Role::F(channel)) => {
                    columns.channels.push(Channel { name: channel.into(), f: column, auxiliaries: Vec::new() });
                }
                Some(Role::H(..)) => {}
            }
        }
        for (column, name) in names.iter().enumerate() {
            let Some(Role::H(kind, channel)) = role(name) else { continue };
            match columns.channels.iter_mut().find(|known| known.name == channel) {
                Some(known) => known.auxiliaries.push((kind.into(), column)),
                None => {
                    let what = format!("auxiliary {name} has no integrand: there is no column f.{channel}");
                    return Err(BadHeader::at(column, what, format!("add f.{channel}, or remove {name}")));
                }
            }
        }
        columns.judge(need_auxiliaries)?;
        Ok(columns)
    }

    fn judge(&self, need_auxiliaries: bool) -> Result<(), BadHeader> {
        if self.channels.is_empty() {
            return Err(BadHeader::of_all("there is no column f.CHANNEL", NAMING));
        }
        match self.channels.iter().find(|channel| need_auxiliaries && channel.auxiliaries.is_empty()) {
            None => Ok(()),
            Some(Channel { name, f, .. }) => Err(BadHeader::at(
                *f,
                format!("channel {name} has no auxiliary: there is no column h.{name}"),
                format!(
                    "add h.{name}, the draws of a function whose integral is known; or ask for --estimator mc alone"
                ),
            )),
        }
    }

    /// The names of the columns of auxiliaries, in the order of output.
    pub fn auxiliaries(&self) -> impl Iterator<Item = &str> {
        let columns = self.channels.iter().flat_map(|channel| channel.auxiliaries.iter().map(|(_, column)| *column));
        columns.map(|column| self.names[column].as_str())
    }
}

fn judge_encoding(fields: &[&str]) -> Result<(), BadHeader> {
    let first = fields.first().copied().unwrap_or_default();
    if first.starts_with(char::REPLACEMENT_CHARACTER) || first.contains('\0') {
        return Err(BadHeader::of_all(
            "this is not UTF-8 text (it looks like UTF-16, or is binary)",
            "save it as UTF-8",
        ));
    }
    if fields.iter().any(|field| field.contains('\r')) {
        return Err(BadHeader::of_all(
            "lines end in a bare carriage return",
            "save it with line feeds (\\n or \\r\\n)",
        ));
    }
    Ok(())
}

fn judge_separator(names: &[String]) -> Result<(), BadHeader> {
    let [only] = names else { return Ok(()) };
    for (separator, called) in [(';', "semicolons"), ('\t', "tabs"), (' ', "spaces")] {
        if only.split(separator).count() > 1 && only.split(separator).all(|name| role(name.trim()).is_some()) {
            let what = format!("fields are separated by {called}");
            return Err(BadHeader::of_all(what, "separate them by commas, with decimal points in numbers"));
        }
    }
    Ok(())
}

fn unknown(column: usize, name: &str) -> BadHeader {
    if name.parse::<f64>().is_ok() {
        let what = format!("the first line must name the columns, but there is the number {name}");
        return BadHeader::at(column, what, format!("add a header such as f.r,h.r: {NAMING}"));
    }
    let what = format!("column {} is not known", shown(name));
    // F.r, f_r and H2-g are near enough to guess.
    let dotted = name.replacen(['_', '-', ':', '/', ' '], ".", 1);
    let lower_kind = dotted.split_once('.').map(|(kind, channel)| format!("{}.{channel}", kind.to_lowercase()));
    match [lower_kind, Some(name.to_lowercase())].into_iter().flatten().find(|guess| role(guess).is_some()) {
        Some(guess) => BadHeader::at(column, what, format!("did you mean {guess}? Rename it, or remove it")),
        None => BadHeader::at(column, what, format!("rename it, or remove it: {NAMING}")),
    }
}

#[cfg(test)]
mod tests {
    use super::{BadHeader, Channel, Columns, names_an_auxiliary};
    use crate::rows::Rows;

    fn columns(header: &str) -> Result<Columns, BadHeader> {
        Columns::new(&Rows::new(header.as_bytes()).next_row().expect("memory can be read").expect("a row"), true)
    }

    #[test]
    fn columns_may_come_in_any_order() {
        let columns = columns("h2.g, pdf,f.r ,h.g,h.r,f.g").expect("a good header");
        assert_eq!(columns.pdf, Some(1));
        let red = Channel { name: "r".into(), f: 2, auxiliaries: vec![("h".into(), 4)] };
        let green = Channel { name: "g".into(), f: 5, auxiliaries: vec![("h2".into(), 0), ("h".into(), 3)] };
        assert_eq!(columns.channels, [red, green]);
        assert_eq!(columns.auxiliaries().collect::<Vec<_>>(), ["h.r", "h2.g", "h.g"]);
    }

    #[test]
    fn channels_may_have_dots_and_any_letters() {
        let columns = columns("f.a.b,h.a.b,f.λ 500,h.λ 500").expect("a good header");
        assert_eq!(columns.channels[0].name, "a.b");
        assert_eq!(columns.channels[1].name, "λ 500");
    }

    #[test]
    fn auxiliaries_have_one_name_each() {
        for name in ["h.r", "h2.r", "h10.r"] {
            assert!(names_an_auxiliary(name), "{name}");
        }
        for name in ["h", "h.", "h0.r", "h1.r", "h02.r", "h+2.r", "h-2.r", "hx.r", "f.r", "pdf", "H.r"] {
            assert!(!names_an_auxiliary(name), "{name}");
        }
    }
}
