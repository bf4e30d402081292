//! What is printed, for draws whose estimates can be worked by hand.

use crate::support::{estimate, json};

/// f̄ = h̄ = 10, so R = 1. Var(f) = 4.5: the plain mean errs by √(4.5/2) = 1.5. f − h = ∓½: the
/// ratio errs by √(0.5/2) = ½.
///
/// Its predicted MSE: with C20 = 0.02, F·C11 = 0.3, F²·C02 = 4.5 and no third moments, 0.5/2 + 0.09/4.
const TWO_DRAWS: &str = "f.r,h.r\n8.5,9\n11.5,11\n";
const TWO_ESTIMATORS: [&str; 4] = ["--estimator", "ratio", "--estimator", "mc"];

fn with(options: &[&'static str]) -> Vec<&'static str> {
    [&TWO_ESTIMATORS, options].concat()
}

#[test]
fn json_is_exact() {
    let run = estimate(TWO_DRAWS, &with(&["--format", "json", "--integral", "h.r=10"]));
    let (head, tail) = run.out.split_once("\"favoured\"").expect("favoured");
    assert_eq!(
        head,
        concat!(
            r#"{"draws":2,"skipped":0,"channels":["r"],"integrals":{"h.r":10.0},"estimates":["#,
            r#"{"estimator":"mc","auxiliary":null,"channel":"r","value":10.0,"std_error":1.5,"flags":[]},"#,
            r#"{"estimator":"ratio","auxiliary":"h","channel":"r","value":10.0,"std_error":0.5,"flags":[]}],"#
        )
    );
    let number = tail.split_once("\"predicted_mse\":").and_then(|(_, rest)| rest.split_once('}')).expect("a number").0;
    let error = (number.parse::<f64>().expect("a number") - 0.2725).abs();
    assert!(error <= 1e-15, "{number}");
    assert_eq!(
        tail.replace(number, "0.2725"),
        concat!(
            r#":[{"channel":"r","estimator":"ratio","auxiliary":"h","predicted_mse":0.2725}],"#,
            r#""favoured_unbiased":[{"channel":"r","estimator":"mc","auxiliary":null,"predicted_mse":2.25}]}"#,
            "\n"
        )
    );
    assert_eq!((run.code, run.err.as_str()), (0, ""));
}

#[test]
fn csv_is_exact() {
    let run = estimate(TWO_DRAWS, &["--format", "csv", "--estimator", "mc", "--integral", "h.r=10"]);
    let right = "estimator,auxiliary,channel,value,std_error,flags,predicted_mse,favoured\nmc,,r,10.0,1.5,,2.25,yes\n";
    assert_eq!((run.code, run.out.as_str(), run.err.as_str()), (0, right, ""));
}

#[test]
fn the_table_says_it_in_words() {
    let run = estimate(TWO_DRAWS, &with(&[]));
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    for part in [
        "2 draws from <stdin>\n",
        "known integrals taken to be 1, since no --integral was given: h.r\n",
        "channel   estimator   auxiliary",
        "r         mc          -           10.00000        1.50",
        "r         ratio       h           1.000000       0.500",
        "Least predicted RMSE of a consistent estimator at 2 draws (predicted from these same draws: a guide, not a promise):",
    ] {
        assert!(run.out.contains(part), "no {part:?} in:\n{}", run.out);
    }
    let given = estimate(TWO_DRAWS, &with(&["--integral", "h.r=10"])).out;
    assert!(given.contains("known integrals: h.r = 10\n") && !given.contains("taken to be 1"), "{given}");
    assert!(given.contains("  r: ratio on h, 0.522 (2.87x less than mc); of the unbiased, mc, 1.50\n"), "{given}");
}

#[test]
fn an_assumed_integral_is_told_in_every_format() {
    for format in ["json", "csv"] {
        let run = estimate("f.r,h.r,h2.r\n1,1,1\n2,1,1\n", &["--format", format, "--integral", "h2.r=1"]);
        assert_eq!((run.code, run.err.as_str()), (0, "note: no --integral for h.r: taken to be 1\n"));
    }
}

#[test]
fn unknown_numbers_are_null_or_empty() {
    let one_draw = "f.r,h.r\n3,2\n";
    let estimates = json(one_draw, &["--estimator", "ratio"]);
    assert_eq!(estimates["estimates"][0]["value"], 1.5);
    assert_eq!(estimates["estimates"][0]["std_error"], serde_json::Value::Null);
    assert_eq!(estimates["estimates"][0]["flags"], serde_json::json!(["ONE_SAMPLE"]));
    assert_eq!(estimates["favoured"], serde_json::json!([]));
    let csv = estimate(one_draw, &["--estimator", "ratio", "--format", "csv"]).out;
    assert!(csv.ends_with("\nratio,h,r,1.5,,ONE_SAMPLE,,\n"), "{csv}");
    let table = estimate(one_draw, &["--estimator", "ratio"]).out;
    assert!(table.contains("unknown") && table.contains("r: no prediction holds; draw more"), "{table}");
    assert!(table.contains("Flags:\n  ONE_SAMPLE: one draw"), "{table}");
}

#[test]
fn every_estimator_stands_once_per_channel_and_auxiliary() {
    let estimates = json("f.r,h.r,h2.r,f.g,h.g\n1,1,1,1,1\n2,1,2,1,2\n", &[]);
    let count = |id: &str, auxiliary: serde_json::Value, channel: &str| {
        let all = estimates["estimates"].as_array().expect("an array").iter();
        all.filter(|e| e["estimator"] == id && e["auxiliary"] == auxiliary && e["channel"] == channel).count()
    };
    for method in ratiocv_report::catalogue::Method::all().map(|method| method.id()) {
        if method == "mc" {
            assert_eq!((count("mc", serde_json::Value::Null, "r"), count("mc", serde_json::Value::Null, "g")), (1, 1));
        } else {
            assert_eq!((count(method, "h".into(), "r"), count(method, "h2".into(), "r")), (1, 1), "{method}");
            assert_eq!((count(method, "h".into(), "g"), count(method, "h2".into(), "g")), (1, 0), "{method}");
        }
    }
    assert_eq!(estimates["channels"], serde_json::json!(["r", "g"]));
    assert_eq!(estimates["integrals"].as_object().expect("an object").len(), 3);
}

#[test]
fn auxiliaries_do_not_touch_the_plain_mean_or_each_other() {
    let alone = json("f.r,h.r\n1,1\n2,1.5\n4,3\n", &[]);
    let beside = json("h2.r,f.r,h.r\n1e300,1,1\n-1e300,2,1.5\n0,4,3\n", &[]);
    let of = |all: &serde_json::Value, auxiliary: &serde_json::Value| {
        let all = all["estimates"].as_array().expect("an array").iter();
        all.filter(|e| &e["auxiliary"] == auxiliary).cloned().collect::<Vec<_>>()
    };
    for auxiliary in [serde_json::Value::Null, "h".into()] {
        assert!(!of(&alone, &auxiliary).is_empty());
        assert_eq!(of(&alone, &auxiliary), of(&beside, &auxiliary));
    }
}

#[test]
fn a_contradicted_integral_is_not_favoured() {
    let draws: String = (0..100).map(|i| format!("{},{}\n", 2 * (i % 7) + 20, i % 7 + 10)).collect();
    let favoured = |integral: &str| {
        let all = json(&format!("f.r,h.r\n{draws}"), &["--integral", integral]);
        all["favoured"][0]["estimator"].as_str().map(str::to_owned)
    };
    assert_eq!(favoured("h.r=1").as_deref(), Some("mc"));
    assert_ne!(favoured("h.r=13").as_deref(), Some("mc"));
}

#[test]
fn the_defensive_weight_moves_the_defensive_estimators_alone() {
    let value = |weight: &str, id: &str| {
        let draws = "f.r,h.r\n1,1\n2,1.5\n4,2.5\n5,4\n";
        json(draws, &["--defensive", weight, "--estimator", id])["estimates"][0]["value"].clone()
    };
    assert_eq!(value("0.5", "ratio"), value("0.01", "ratio"));
    assert_ne!(value("0.5", "defensive_ratio"), value("0.01", "defensive_ratio"));
    assert_eq!(value("0", "defensive_ratio"), value("0", "ratio"));
    // H f̄/(½H + ½h̄) with f̄ = 3, h̄ = 2.25, H = 1.
    let half = value("0.5", "defensive_ratio").as_f64().expect("a number");
    assert!((half - 3.0 / 1.625).abs() <= 1e-15, "{half}");
}
