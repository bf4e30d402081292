//! Stiff cases.

use crate::support::{fails_with, ratiocv};

#[test]
fn a_case_is_run_and_shown_in_each_format() {
    let table = ratiocv(&["stability", "--only", "A10"], "");
    assert_eq!((table.code, table.err.as_str()), (0, ""));
    assert!(table.out.contains("Σh overflows") && table.out.trim_end().ends_with("0 failed"), "{}", table.out);
    let json = ratiocv(&["stability", "--only", "A10", "--only", "C3", "--format", "json"], "");
    let json: serde_json::Value = serde_json::from_str(&json.out).expect("output is JSON");
    let rows = json["rows"].as_array().expect("rows");
    assert!(rows.iter().any(|row| row["id"] == "A10" && row["value"] == 2.0 && row["passes"] == true), "{json}");
    assert!(rows.iter().any(|row| row["id"] == "C3" && row["digits"] == 17.0), "{json}");
    let page = ratiocv(&["stability", "--only", "A10", "--format", "html"], "");
    assert!(page.out.starts_with("<!DOCTYPE html>") && page.out.trim_end().ends_with("</html>"));
    assert_eq!((page.code, page.err.as_str()), (0, ""));
}

#[test]
fn an_unknown_case_is_a_wrong_command_line() {
    let run = ratiocv(&["stability", "--only", "Z9"], "");
    fails_with(&run, 2, &["there is no case 'Z9'", "A to H or StRD"]);
}

/// 1 of a wrong formula, in every format, after the whole table was printed.
#[test]
fn a_row_that_fails_makes_the_exit_code_1() {
    for (format, shown) in [("table", "FAILS"), ("json", "\"passes\":false"), ("html", "class=\"bad\"")] {
        let run = ratiocv(&["stability", "--only", "A1", "--textbook", "--format", format], "");
        assert_eq!(run.code, 1, "{run:?}");
        assert!(run.out.contains(shown) && run.err.contains("2 rows failed"), "{run:?}");
    }
}

/// A bug in the core is seen: NaNs that are saved as they are.
#[cfg(planted_bugs)]
#[test]
fn a_planted_bug_makes_the_exit_code_1() {
    let run = ratiocv(&["stability", "--only", "F10"], "");
    let planted = std::env::var("RATIOCV_PLANTED").is_ok_and(|name| name == "save_nan");
    assert_eq!(run.code, i32::from(planted), "{run:?}");
}
