//! The known integrals: `--integral h.r=1.25`.

use crate::columns::{Columns, names_an_auxiliary};
use crate::fault::Fault;
use crate::words::listed;
use core::str::FromStr;

/// A known integral, as given on the command line.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// The auxiliary's column.
    pub column: String,
    /// Its integral, finite and not 0.
    pub value: f64,
}

impl FromStr for Given {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // The last '=': a channel's name may contain one.
        let (column, number) =
            text.rsplit_once('=').ok_or_else(|| "it must read COLUMN=VALUE, such as h.r=1.25".to_owned())?;
        let column = column.trim();
        if !names_an_auxiliary(column) {
            return Err(format!("'{column}' is not the column of an auxiliary, such as h.r or h2.r"));
        }
        let value: f64 = number.trim().parse().map_err(|_| format!("'{number}' is not a number"))?;
        if value == 0.0 || !value.is_finite() {
            return Err(format!("the known integral must be finite and not 0, and is {value}"));
        }
        Ok(Self { column: column.into(), value })
    }
}

/// The known integral of an auxiliary of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// The auxiliary's column.
    pub column: String,
    /// Its integral.
    pub value: f64,
    /// Whether it was not given, so that it is taken to be 1.
    pub assumed: bool,
}

/// The integrals of all auxiliaries of `columns`, in their order; 1 where none is given.
///
/// # Errors
/// An integral that is given twice, or for a column that the file called `file` does not have.
pub fn of_columns(columns: &Columns, given: &[Given], file: &str) -> Result<Vec<Known>, Fault> {
    for (i, one) in given.iter().enumerate() {
        if given[..i].iter().any(|earlier| earlier.column == one.column) {
            return Err(Fault::usage(format!("--integral {} is given twice", one.column), "give each integral once"));
        }
        if !columns.auxiliaries().any(|column| column == one.column) {
            let all = listed(&columns.auxiliaries().collect::<Vec<_>>());
            let all = if all.is_empty() { "there is none".to_owned() } else { format!("there are {all}") };
            let what = format!("--integral {}: {file} has no such column", one.column);
            return Err(Fault::usage(what, format!("name the column of an auxiliary: {all}")));
        }
    }
    let known = columns.auxiliaries().map(|column| {
        let given = given.iter().find(|given| given.column == column);
        Known { column: column.into(), value: given.map_or(1.0, |given| given.value), assumed: given.is_none() }
    });
    Ok(known.collect())
}

#[cfg(test)]
mod tests {
    use super::Given;

    #[test]
    fn an_integral_is_a_column_and_a_usable_number() {
        let given = |column: &str, value| Ok(Given { column: column.into(), value });
        assert_eq!("h.r=1.25".parse(), given("h.r", 1.25));
        assert_eq!("h2.a=b=-2e3".parse(), given("h2.a=b", -2e3));
        for bad in
            ["h.r", "h.r=", "h.r=x", "f.r=1", "pdf=1", "=1", "h.r=0", "h.r=-0", "h.r=nan", "h.r=inf", "h.r=1e999"]
        {
            assert!(bad.parse::<Given>().is_err(), "{bad}");
        }
    }
}
