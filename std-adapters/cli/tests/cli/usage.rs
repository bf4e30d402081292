//! Command lines that cannot be meant: exit code 2, and what would be right.

use crate::support::{estimate, fails, fails_with, ratiocv};

const DRAWS: &str = "f.r,h.r,f.g,h.g\n1,2,3,4\n";

#[test]
fn integrals_that_are_none() {
    for (given, why) in [
        ("h.r", "it must read COLUMN=VALUE, such as h.r=1.25"),
        ("h.r=", "'' is not a number"),
        ("h.r=one", "'one' is not a number"),
        ("h.r=0", "the known integral must be finite and not 0, and is 0"),
        ("h.r=NaN", "the known integral must be finite and not 0, and is NaN"),
        ("h.r=-inf", "the known integral must be finite and not 0, and is -inf"),
        ("f.r=1", "'f.r' is not the column of an auxiliary, such as h.r or h2.r"),
    ] {
        fails_with(&estimate(DRAWS, &["--integral", given]), 2, &["--integral", why]);
    }
}

#[test]
fn integrals_of_no_column() {
    let error = "error: --integral h.b: <stdin> has no such column\n  help: name the column of an auxiliary: there are h.r, h.g";
    fails(&estimate(DRAWS, &["--integral", "h.b=1"]), 2, error);
    let error =
        "error: --integral h.r: <stdin> has no such column\n  help: name the column of an auxiliary: there is none";
    fails(&estimate("f.r\n1\n", &["--integral", "h.r=1", "--estimator", "mc"]), 2, error);
}

#[test]
fn an_integral_twice() {
    let error = "error: --integral h.r is given twice\n  help: give each integral once";
    fails(&estimate(DRAWS, &["--integral", "h.r=1", "--integral", "h.r=2"]), 2, error);
}

#[test]
fn weights_out_of_range() {
    for weight in ["1", "-0.1", "NaN", "2", "inf"] {
        fails_with(&estimate(DRAWS, &["--defensive", weight]), 2, &["--defensive", "at least 0 and below 1"]);
    }
    fails_with(&estimate(DRAWS, &["--defensive", "little"]), 2, &["it must be a number, such as 0.01"]);
}

#[test]
fn unknown_names_are_answered_with_the_nearest_and_the_list() {
    let run = estimate(DRAWS, &["--estimator", "hartley-ros"]);
    fails_with(&run, 2, &["'hartley-ros'", "'hartley_ross'", "mc, ratio, quenouille", "defensive_mickey"]);
    fails_with(
        &ratiocv(&["report", "--problem", "three-light"], ""),
        2,
        &["'three-lights'", "peaks-4d", "spectrum-32"],
    );
    fails_with(&ratiocv(&["report", "--estimator", "micky"], ""), 2, &["'mickey'", "mean_of_ratios"]);
    fails_with(&estimate(DRAWS, &["--format", "jsn"]), 2, &["'json'", "table, json, csv"]);
    fails_with(&ratiocv(&["lst"], ""), 2, &["'list'"]);
}

#[test]
fn numbers_out_of_range() {
    for [option, value] in [["--threads", "0"], ["--budget", "0"], ["--budget", "NaN"], ["--seed", "x"]] {
        fails_with(&ratiocv(&["report", option, value], ""), 2, &[option]);
    }
}

#[test]
fn no_file() {
    fails_with(&ratiocv(&["estimate"], ""), 2, &["<FILE>"]);
}
