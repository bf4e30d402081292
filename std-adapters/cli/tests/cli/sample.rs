//! The committed file of draws.

use crate::support::ratiocv;

#[allow(dead_code, reason = "its main function is the example's")]
#[path = "../../examples/draws.rs"]
mod recipe;

const SAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/draws.csv");

#[test]
fn it_is_what_the_recipe_makes() {
    assert_eq!(std::fs::read_to_string(SAMPLE).expect("the file is committed"), recipe::csv());
}

#[test]
fn every_unbiased_or_consistent_estimator_finds_the_integrals() {
    let run = ratiocv(&["estimate", SAMPLE, "--format", "json"], "");
    let all: serde_json::Value = serde_json::from_str(&run.out).expect("output is JSON");
    let estimates = all["estimates"].as_array().expect("an array");
    assert_eq!((all["draws"].as_u64(), estimates.len()), (Some(200), 3 * 24));
    for estimate in estimates.iter().filter(|e| !e["estimator"].as_str().expect("an id").contains("mean_of_ratios")) {
        let right = match estimate["channel"].as_str() {
            Some("r") => 7.616,
            Some("g") => 4.74375,
            _ => 1.8955,
        };
        // H0: the estimator is right on average; one fixed sample, so a threshold of 4 errors that no
        // other seed has to meet.
        let off = (estimate["value"].as_f64().expect("a number") - right).abs();
        assert!(off <= 4.0 * estimate["std_error"].as_f64().expect("a number"), "{estimate}");
    }
    // In b the ratio takes away most of the noise.
    let favoured = &all["favoured"][2];
    assert_ne!(favoured["estimator"], "mean_of_ratios");
    assert!(favoured["estimator"] != "mc" && favoured["predicted_mse"].as_f64().is_some_and(|mse| mse < 0.05 * 0.05));
}
