//! Rows that are not draws: an error that names the place, or skipped as a whole and counted.

use crate::support::{estimate, fails, json};

const REMEDY: &str = "help: correct the line, or leave such rows out with --on-bad-draw skip";

/// That `row`, third of a file with columns f.r,h.r,pdf, is rejected with `error` — and that the file
/// without it is what `skip` makes of it.
#[track_caller]
fn rejects(row: &str, error: &str) {
    let with = format!("f.r,h.r,pdf\n1,1,1\n\n{row}\n4,6,2\n");
    let so_far = "1 draw before it was read without fault; no estimate was made of it";
    fails(&estimate(&with, &[]), 1, &format!("error: <stdin>, line 4{error}\n  {so_far}\n  {REMEDY}"));

    let mut skipped = json(&with, &["--on-bad-draw", "skip"]);
    assert_eq!((&skipped["draws"], &skipped["skipped"]), (&2.into(), &1.into()));
    skipped["skipped"] = 0.into();
    assert_eq!(skipped, json("f.r,h.r,pdf\n1,1,1\n4,6,2\n", &[]));
    let notes = estimate(&with, &["--on-bad-draw", "skip"]).err;
    assert_eq!(notes, format!("note: skipped 1 row; the first is <stdin>, line 4{error}\n"));
}

#[test]
fn not_a_number() {
    rejects("abc,2,1", ", column 1 (f.r): 'abc' is not a number");
    rejects("1,2 3,1", ", column 2 (h.r): '2 3' is not a number");
    rejects("1,2,0x1", ", column 3 (pdf): '0x1' is not a number");
    rejects("1,,1", ", column 2 (h.r): the field is empty");
    rejects("1,\u{1F600},1", ", column 2 (h.r): '\u{1F600}' is not a number");
}

#[test]
fn not_finite() {
    rejects("NaN,2,1", ", column 1 (f.r): 'NaN' is not a finite number");
    rejects("1,-inf,1", ", column 2 (h.r): '-inf' is not a finite number");
    rejects("1,2,infinity", ", column 3 (pdf): 'infinity' is not a finite number");
    rejects("1,1e999,1", ", column 2 (h.r): '1e999' is not a finite number");
}

#[test]
fn ragged() {
    rejects("1,2", ": 2 fields, but the header has 3");
    rejects("1", ": 1 field, but the header has 3");
    rejects("1,2,3,4", ": 4 fields, but the header has 3");
    rejects("1,5,2,5,1", ": 5 fields, but the header has 3");
    rejects("\"1,2,3", ": a quote is opened and not closed");
}

#[test]
fn impossible_densities() {
    rejects("2,0,0", ", column 1 (f.r): f.r is 2 where the pdf is 0: it cannot have been drawn");
    rejects("0,2,0", ", column 2 (h.r): h.r is 2 where the pdf is 0: it cannot have been drawn");
    rejects("1,1,-1", ", column 3 (pdf): the pdf is negative (-1)");
    rejects(
        "1e300,1,1e-300",
        &format!(
            ", column 1 (f.r): f.r is 1{} where the pdf is 0.{}1: the quotient overflows",
            "0".repeat(300),
            "0".repeat(299)
        ),
    );
}

#[test]
fn nothing_over_nothing_is_nothing() {
    let all = json("f.r,h.r,pdf\n0,-0,0\n4,4,2\n", &["--estimator", "mc"]);
    assert_eq!((&all["draws"], &all["estimates"][0]["value"]), (&2.into(), &1.0.into()));
}

#[test]
fn division_is_exact_for_denormal_densities() {
    let all = json("f.r,h.r,pdf\n5e-324,5e-324,5e-324\n1,1,1\n", &["--estimator", "mc"]);
    assert_eq!(all["estimates"][0]["value"], 1.0);
}

#[test]
fn how_far_it_got() {
    let good = "1,2\n".repeat(300);
    let error = format!(
        "error: <stdin>, line 302, column 1 (f.r): 'x' is not a number\n  300 draws before it were read without fault; \
         no estimate was made of them\n  {REMEDY}"
    );
    fails(&estimate(&format!("f.r,h.r\n{good}x,1\n{good}"), &[]), 1, &error);
    let error =
        format!("error: <stdin>, line 2: 1 field, but the header has 2\n  no draw had been read before it\n  {REMEDY}");
    fails(&estimate("f.r,h.r\n1\n", &[]), 1, &error);
}

#[test]
fn nothing_left() {
    let error = "error: <stdin>: no draw is left: all 2 rows were skipped; the first is <stdin>, line 2, column 1 (f.r): \
                 'x' is not a number\n  help: correct the file";
    fails(&estimate("f.r,h.r\nx,1\n1\n", &["--on-bad-draw", "skip"]), 1, error);
}

#[test]
fn a_bad_row_is_skipped_in_all_channels() {
    let draws = "f.r,h.r,f.g,h.g\n1,1,1,1\n100,100,NaN,1\n3,3,3,3\n";
    let all = json(draws, &["--on-bad-draw", "skip", "--estimator", "mc"]);
    assert_eq!((&all["estimates"][0]["value"], &all["estimates"][1]["value"]), (&2.0.into(), &2.0.into()));
}
