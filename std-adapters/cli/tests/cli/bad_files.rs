//! Files that are not files of draws: each error names the place and the remedy.

use crate::support::{estimate, fails, file, ratiocv};

const NAMING: &str = "columns are named f.CHANNEL, h.CHANNEL (h2.CHANNEL, … for further auxiliaries) and pdf";

#[track_caller]
fn rejects(input: &str, error: &str) {
    fails(&estimate(input, &[]), 1, &format!("error: <stdin>{error}"));
}

#[test]
fn no_file() {
    let run = ratiocv(&["estimate", "no/such/file.csv"], "");
    let error = "error: cannot read no/such/file.csv: No such file or directory (os error 2)\n  help: check the file's \
                 name and rights; - reads standard input";
    fails(&run, 1, error);
}

#[test]
fn a_directory() {
    let run = ratiocv(&["estimate", env!("CARGO_TARGET_TMPDIR")], "");
    assert!(run.code == 1 && run.err.contains(": it is a directory\n  help: "), "{run:?}");
}

#[test]
fn nothing_in_it() {
    for nothing in ["", "\n\n", "\u{feff}", " \r\n"] {
        rejects(nothing, ": the file is empty\n  help: give a header such as f.r,h.r, and one row per draw");
    }
}

#[test]
fn a_header_alone() {
    for header in ["f.r,h.r", "f.r,h.r\r\n\r\n"] {
        rejects(header, ": there is no draw after the header\n  help: add rows, one per draw");
    }
}

#[test]
fn no_header() {
    let help = format!("\n  help: add a header such as f.r,h.r: {NAMING}");
    rejects(
        "1.5,2\n3,4\n",
        &format!(", line 1, column 1: the first line must name the columns, but there is the number 1.5{help}"),
    );
}

#[test]
fn a_channel_without_auxiliary() {
    rejects(
        "f.r,h.r,f.g\n1,2,3\n",
        ", line 1, column 3: channel g has no auxiliary: there is no column h.g\n  help: add h.g, the draws of a \
         function whose integral is known; or ask for --estimator mc alone",
    );
    let plain = estimate("f.r,h.r,f.g\n1,2,3\n", &["--estimator", "mc"]);
    assert!(plain.code == 0 && plain.out.contains(" g         mc"), "{plain:?}");
}

#[test]
fn an_auxiliary_without_integrand() {
    rejects(
        "f.r,h.r,h2.g\n1,2,3\n",
        ", line 1, column 3: auxiliary h2.g has no integrand: there is no column f.g\n  help: add f.g, or remove h2.g",
    );
}

#[test]
fn no_integrand_at_all() {
    rejects("pdf\n1\n", &format!(", line 1: there is no column f.CHANNEL\n  help: {NAMING}"));
}

#[test]
fn a_column_twice() {
    rejects(
        "f.r,h.r, f.r\n1,2,3\n",
        ", line 1, column 3: column f.r stands here and in column 1 too\n  help: rename or remove one of the two",
    );
}

#[test]
fn an_unknown_column() {
    for (name, remedy) in [
        ("F.g", "did you mean f.g? Rename it, or remove it".to_owned()),
        ("h_g", "did you mean h.g? Rename it, or remove it".to_owned()),
        ("PDF", "did you mean pdf? Rename it, or remove it".to_owned()),
        ("weight", format!("rename it, or remove it: {NAMING}")),
        ("h1.r", format!("rename it, or remove it: {NAMING}")),
        ("f.", format!("rename it, or remove it: {NAMING}")),
        ("", format!("rename it, or remove it: {NAMING}")),
    ] {
        let error = format!(", line 1, column 3: column '{name}' is not known\n  help: {remedy}");
        rejects(&format!("f.r,h.r,{name}\n1,2,3\n"), &error);
    }
}

#[test]
fn other_separators() {
    for (header, called) in [("f.r;h.r", "semicolons"), ("f.r\th.r", "tabs"), ("f.r h.r", "spaces")] {
        let help = "help: separate them by commas, with decimal points in numbers";
        rejects(&format!("{header}\n1;2\n"), &format!(", line 1: fields are separated by {called}\n  {help}"));
    }
}

#[test]
fn other_encodings() {
    let utf16: Vec<u8> = "\u{feff}f.r,h.r\n1,2\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let path = file("utf16.csv", &utf16);
    let run = ratiocv(&["estimate", path.to_str().expect("a path")], "");
    let what = "line 1: this is not UTF-8 text (it looks like UTF-16, or is binary)\n  help: save it as UTF-8";
    fails(&run, 1, &format!("error: {}, {what}", path.display()));
    let help = "help: save it with line feeds (\\n or \\r\\n)";
    rejects("f.r,h.r\r1,2\r", &format!(", line 1: lines end in a bare carriage return\n  {help}"));
}

#[test]
fn an_open_quote_in_the_header() {
    rejects("f.r,\"h.r\n1,2\n", ", line 1: a quote is opened in the header and not closed\n  help: close it");
}

#[test]
fn a_line_without_end() {
    let run = estimate(&"1".repeat((16 << 20) + 2), &[]);
    let error = "error: <stdin>, line 1: the line does not end within 16 MiB\n  help: is this a CSV file, one line per \
                 draw?";
    fails(&run, 1, error);
}
