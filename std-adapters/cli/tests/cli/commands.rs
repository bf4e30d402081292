//! Help, list and report.

use crate::support::{fails_with, file, ratiocv};
use ratiocv_report::catalogue::Method;
use ratiocv_scene::BuiltIn;
use std::path::PathBuf;

#[test]
fn help_has_examples_and_exit_codes() {
    for arguments in [
        &["--help"][..],
        &["report", "--help"],
        &["list", "--help"],
        &["render", "--help"],
        &["estimate", "--help"],
        &["estimate", "-h"],
        &["stability", "--help"],
    ] {
        let run = ratiocv(arguments, "");
        assert_eq!((run.code, run.err.as_str()), (0, ""));
        assert!(
            run.out.contains("Exit codes:\n  0  done\n  1  the data or a file is bad\n  2  the command line is wrong")
        );
    }
    for (arguments, example) in [
        (&["--help"][..], "ratiocv estimate draws.csv"),
        (&["estimate", "--help"], "ratiocv estimate draws.csv --integral h.r=1.25"),
        (&["estimate", "--help"], "f.CHANNEL    the integrand"),
    ] {
        let out = ratiocv(arguments, "").out;
        assert!(out.contains(example), "{out}");
    }
    assert!(ratiocv(&["--version"], "").out.starts_with("ratiocv "));
}

#[test]
fn list_has_a_line_for_everything() {
    let run = ratiocv(&["list"], "");
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    let (problems, rest) = run.out.split_once("\nEstimators:\n").expect("two lists");
    let (estimators, rest) = rest.split_once("\nScenes:\n").expect("three lists");
    let (scenes, pixels) = rest.split_once("\nEstimators of pixels:\n").expect("four lists");
    assert!(scenes.contains("\n  S1k ") && scenes.lines().count() == BuiltIn::ALL.len(), "{scenes}");
    assert!(pixels.lines().zip(ratiocv_scene::Method::all()).all(|(line, method)| line.contains(method.name())));
    let problems: Vec<_> = problems.lines().skip(1).collect();
    for id in ["three-lights", "spectrum-32", "peaks-4d"] {
        assert!(problems.iter().any(|line| line.starts_with(&format!("  {id} "))), "{id} in {problems:?}");
    }
    for (line, method) in estimators.lines().zip(Method::all()) {
        assert_eq!(line.split_whitespace().next(), Some(method.id()));
        assert!(line.ends_with(method.about()));
    }
    assert_eq!(estimators.lines().count(), Method::all().count());
}

#[test]
fn a_report_is_written_and_shown() {
    let dir = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("a report");
    let _ = std::fs::remove_dir_all(&dir);
    let out = dir.to_str().expect("a path");
    let quick = ["--quick", "--problem", "three-lights", "--estimator", "ratio", "--budget", "0.2", "--out", out];
    for arguments in [[&["report"][..], &quick].concat(), quick.to_vec()] {
        let run = ratiocv(&arguments, "");
        assert_eq!((run.code, run.err.as_str()), (0, ""), "quiet when piped");
        for name in ["index.html", "report.json", "report.csv"] {
            let path = dir.join(name);
            assert!(run.out.contains(&format!("wrote {}\n", path.display())), "{}", run.out);
            assert!(std::fs::metadata(path).expect("a file").len() > 100);
        }
        assert!(run.out.contains("three-lights") && run.out.contains("ratio"), "{}", run.out);
        std::fs::remove_dir_all(&dir).expect("the directory was made");
    }
}

#[test]
fn a_report_that_cannot_be_written_is_not_measured() {
    let not_a_directory = file("occupied", b"");
    let out = not_a_directory.join("report");
    let start = std::time::Instant::now();
    let run = ratiocv(&["report", "--out", out.to_str().expect("a path")], "");
    fails_with(&run, 1, &["error: cannot write to", "occupied", "--out DIR"]);
    assert!(start.elapsed().as_secs() < 5);
}

#[test]
fn a_report_lists_the_best_unless_all_or_some_are_asked_for() {
    let dir = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("listed");
    let out = dir.to_str().expect("a path");
    let listed = |options: &[&str]| {
        let common = ["report", "--quick", "--problem", "well-correlated", "--budget", "0.05", "--out", out];
        let run = ratiocv(&[&common[..], options].concat(), "");
        assert_eq!((run.code, run.err.as_str()), (0, ""));
        assert!(!run.out.contains('\u{1b}'), "no styles in a pipe");
        // Lines with few words are wrapped cells.
        let id = |line: &str| {
            let id = line.split_whitespace().next().and_then(Method::from_id);
            id.filter(|_| line.split_whitespace().count() > 8)
        };
        let (tables, _) = run.out.split_once("\nerror, time: ").expect("an explanation");
        tables.lines().filter_map(id).collect::<Vec<_>>()
    };
    let short = listed(&[]);
    assert!(short[0] == Method::PLAIN && short.len() < 8, "{short:?}");
    let mut all = listed(&["--all"]);
    all.sort();
    let mut expected: Vec<_> = Method::all().collect();
    expected.sort();
    assert_eq!(all, expected);
    let asked = listed(&["--estimator", "mean_of_ratios", "--estimator", "tin", "--estimator", "beale"]);
    assert_eq!(asked.iter().map(|method| method.id()).collect::<Vec<_>>(), ["mc", "beale", "tin", "mean_of_ratios"]);
    assert!(ratiocv(&["report", "--help"], "").out.contains("--all"));
    std::fs::remove_dir_all(&dir).expect("the directory was made");
}
