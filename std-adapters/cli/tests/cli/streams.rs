//! Long, piped and oddly written input.

use crate::support::{estimate, file, json, ratiocv};
use core::fmt::Write;
use std::io::Read;
use std::process::{Command, Stdio};

#[test]
fn a_hundred_thousand_draws() {
    let mut draws = "f.r,h.r\n".to_owned();
    for i in 0..100_000_u32 {
        let h = f64::from(i % 1000) / 1000.0 + 0.5;
        let _ = writeln!(draws, "{},{h}", 3.0 * h + f64::from(i % 7) - 3.0);
    }
    let from_pipe = json(&draws, &["--integral", "h.r=0.9995"]);
    assert_eq!(from_pipe["draws"], 100_000);
    let biased = |id: &serde_json::Value| id.as_str().is_some_and(|id| id.ends_with("mean_of_ratios"));
    for estimate in from_pipe["estimates"].as_array().expect("an array").iter().filter(|e| !biased(&e["estimator"])) {
        let (value, id) = (estimate["value"].as_f64().expect("a number"), &estimate["estimator"]);
        // The mean of i % 7 − 3 over 100 000 = 7·14285 + 5 draws is −5/100 000.
        assert!((value - 2.9985 + 5e-5).abs() <= 5e-4, "{id}: {value}");
    }
    let path = file("many.csv", draws.as_bytes());
    let from_file =
        ratiocv(&["estimate", path.to_str().expect("a path"), "--format", "json", "--integral", "h.r=0.9995"], "");
    assert_eq!(serde_json::from_str::<serde_json::Value>(&from_file.out).expect("JSON"), from_pipe);
}

#[test]
fn ways_to_write_the_same() {
    let right = json("f.r,h.r\n1,2\n3,5\n", &[]);
    for same in [
        "\u{feff}f.r,h.r\n1,2\n3,5\n",
        "f.r,h.r\r\n1,2\r\n3,5\r\n",
        "f.r,h.r\n1,2\n3,5",
        "f.r,h.r\n1,2\n3,5\n\n\n",
        "\nf.r,h.r\n\n1,2\n  \n3,5\n",
        "\"f.r\",\"h.r\"\n\"1\",\"2\"\n\"3\",5\n",
        " f.r , h.r\n 1, 2 \n+3.0,\t5e0\n",
        "f.r,h.r,pdf\n2,4,2\n1.5,2.5,0.5\n",
        "h.r,f.r\n2,1\n5,3\n",
    ] {
        assert_eq!(json(same, &[]), right, "{same:?}");
    }
}

/// `ratiocv … | head -1`.
#[test]
fn a_reader_that_leaves_is_no_failure() {
    let header: String = (0..300).map(|i| format!("f.{i},h.{i},")).collect();
    let row = "1,2,".repeat(300);
    let path =
        file("wide.csv", format!("{}\n{}\n", header.trim_end_matches(','), row.trim_end_matches(',')).as_bytes());
    for format in ["table", "json", "csv"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ratiocv"));
        command.arg("estimate").arg(&path).args(["--format", format]).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the binary starts");
        let mut first = [0; 1];
        let mut out = child.stdout.take().expect("a pipe");
        out.read_exact(&mut first).expect("some output");
        drop(out);
        let output = child.wait_with_output().expect("the binary ends");
        let err = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.code() == Some(0) && !err.contains("panic") && !err.contains("error:"),
            "{format}: {err}"
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
    let mut command = Command::new(env!("CARGO_BIN_EXE_ratiocv"));
    let output = command.arg("list").stdout(full).stderr(Stdio::piped()).output().expect("the binary starts");
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(err.starts_with("error: cannot write the output: No space left on device"), "{err}");
}

#[test]
fn the_same_draws_give_the_same_bits() {
    let draws = "f.r,h.r\n0.1,0.2\n0.7,0.3\n0.4,0.9\n";
    assert_eq!(estimate(draws, &["--format", "json"]).out, estimate(draws, &["--format", "json"]).out);
}
