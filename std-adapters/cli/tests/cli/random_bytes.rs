//! Whatever the bytes, there is an answer or an error, never a panic.

use clap::Parser;
use ratiocv_cli::arguments::{Arguments, Command, EstimateArguments};
use ratiocv_cli::estimate::estimate;

/// Marsaglia's xorshift: enough for choosing bytes.
struct Bytes(u64);

impl Bytes {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % limit
    }
}

/// What files of draws are made of, and what they should not contain.
const PIECES: [&[u8]; 30] = [
    b",",
    b",",
    b",",
    b"\n",
    b"\n",
    b"\r\n",
    b"\r",
    b"\"",
    b"\"\"",
    b"0",
    b"1",
    b"-2.5",
    b"1e308",
    b"-1e308",
    b"5e-324",
    b"NaN",
    b"inf",
    b"",
    b" ",
    b"f.r",
    b"h.r",
    b"pdf",
    b"h2.r",
    b"x",
    b"\xff",
    b"\0",
    b"\xef\xbb\xbf",
    b"1e-200",
    b"-0",
    b"1e400",
];

const HEADERS: [&[u8]; 5] = [b"", b"f.r,h.r\n", b"f.r,h.r,pdf\n", b"f.r,h.r,h2.r,f.g,h.g\n", b"\"f.r\",h.r\r\n"];

fn arguments(format: &str, on_bad_draw: &str, weight: &str) -> EstimateArguments {
    let line = ["ratiocv", "estimate", "-", "--format", format, "--on-bad-draw", on_bad_draw, "--defensive", weight];
    match Arguments::try_parse_from(line).expect("a good command line").command {
        Some(Command::Estimate(arguments)) => arguments,
        other => panic!("{other:?}"),
    }
}

#[test]
fn any_bytes_are_answered() {
    let mut random = Bytes(0x5eed_0014);
    let (mut answered, mut rejected) = (0, 0);
    for case in 0..6000 {
        let mut text = HEADERS[random.below(HEADERS.len())].to_vec();
        // Half of the cases are rows of fields, so that some are draws.
        let columns = text.split(|byte| *byte == b',').count();
        for _ in 0..random.below(40) {
            if case % 2 == 0 {
                text.extend_from_slice(PIECES[random.below(PIECES.len())]);
            } else {
                for column in 0..columns {
                    text.extend_from_slice(if column > 0 { b"," } else { b"" });
                    text.extend_from_slice(PIECES[9 + random.below(6)]);
                }
                text.push(b'\n');
            }
        }
        let format = ["table", "json", "csv"][random.below(3)];
        let policy = ["error", "skip"][random.below(2)];
        let weight = ["0", "0.01", "0.999"][random.below(3)];
        let (mut out, mut notes) = (Vec::new(), Vec::new());
        match estimate(&*text, "any.csv", None, &arguments(format, policy, weight), &mut out, &mut notes) {
            Ok(()) => {
                answered += 1;
                let out = String::from_utf8(out).expect("output is UTF-8");
                if format == "json" {
                    serde_json::from_str::<serde_json::Value>(&out).expect("output is JSON");
                } else if format == "csv" {
                    assert!(!out.contains("NaN") && !out.contains("inf"), "{out}");
                }
            }
            Err(fault) => {
                rejected += 1;
                let fault = fault.to_string();
                assert!(fault.starts_with("any.csv") && fault.contains("help: "), "{fault}");
            }
        }
    }
    assert!(answered > 1000 && rejected > 1000, "{answered} answered, {rejected} rejected");
}
