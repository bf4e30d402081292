//! Runs the binary.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// What a run left behind.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

/// `ratiocv arguments…`, with `input` on its standard input.
pub(crate) fn ratiocv(arguments: &[&str], input: &str) -> Run {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ratiocv"));
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the binary starts");
    // A run that fails early does not read its input.
    let _ = child.stdin.take().expect("a pipe").write_all(input.as_bytes());
    let output = child.wait_with_output().expect("the binary ends");
    let text = |bytes| String::from_utf8(bytes).expect("output is UTF-8");
    Run { code: output.status.code().expect("an exit code"), out: text(output.stdout), err: text(output.stderr) }
}

/// `ratiocv estimate - options…` of `input`.
pub(crate) fn estimate(input: &str, options: &[&str]) -> Run {
    ratiocv(&[&["estimate", "-"], options].concat(), input)
}

/// The JSON of a run that must succeed.
pub(crate) fn json(input: &str, options: &[&str]) -> serde_json::Value {
    let run = estimate(input, &[options, &["--format", "json"]].concat());
    assert_eq!(run.code, 0, "{run:?}");
    serde_json::from_str(&run.out).expect("output is JSON")
}

/// That the run fails with `code`, prints nothing and says exactly `error`.
#[track_caller]
pub(crate) fn fails(run: &Run, code: i32, error: &str) {
    assert_eq!((run.code, run.out.as_str(), run.err.trim_end()), (code, "", error));
}

/// That the run fails with `code`, prints nothing, and its error contains each of `parts`.
#[track_caller]
pub(crate) fn fails_with(run: &Run, code: i32, parts: &[&str]) {
    assert_eq!((run.code, run.out.as_str()), (code, ""), "{run:?}");
    for part in parts {
        assert!(run.err.contains(part), "no {part:?} in:\n{}", run.err);
    }
}

/// A file of that name with that content, in a directory of the build.
pub(crate) fn file(name: &str, content: &[u8]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, content).expect("the build directory can be written to");
    path
}
