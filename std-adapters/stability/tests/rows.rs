//! Every case is a test: a section at a time, on every lane type of both precisions.

use ratiocv_stability::{Contender, Table, cases};

macro_rules! sections {
    ($($test:ident: $section:literal;)*) => {$(
        #[test]
        fn $test() {
            let table = Table::of(cases::named($section), Contender::Ours);
            assert!(!table.rows.is_empty(), "no case in section {}", $section);
            println!("{table}");
            assert_eq!(table.failures().count(), 0, "\n{table}");
        }
    )*};
}

sections! {
    denominators: "A";
    dynamic_range: "B";
    cancellation: "C";
    counts_and_merges: "D";
    formulas_of_the_estimators: "E";
    bad_draws_and_lanes: "F";
    nested_and_heavy_tailed: "G";
    platform: "H";
    reference_datasets: "StRD";
}

const TEXTBOOK_FAILS: [&str; 17] =
    ["A1", "A3", "A5", "B1", "B2", "B6", "C3", "C4", "C6", "C8", "C11", "D1", "E4", "E9", "G11", "H2", "StRD-NumAcc4"];

/// A table that cannot fail shows nothing: the textbook formulas, in our place, fail these rows.
#[test]
fn the_textbook_fails() {
    let table = Table::of(TEXTBOOK_FAILS.into_iter().flat_map(cases::named), Contender::Naive);
    for id in TEXTBOOK_FAILS {
        assert!(table.failures().any(|row| row.id == id), "{id} does not fail\n{table}");
    }
    assert!(table.summary().ends_with("failed") && !table.summary().contains(" 0 failed"));
}

/// Every id of the list has a case; C1 and C2 are in StRD.
#[test]
fn the_list_is_whole() {
    let not_rows = ["C1", "C2"];
    for (section, last) in [("A", 16), ("B", 10), ("C", 11), ("D", 14), ("E", 17), ("F", 10), ("G", 11), ("H", 5)] {
        for number in 1..=last {
            let id = format!("{section}{number}");
            assert_eq!(cases::named(&id).is_empty(), not_rows.contains(&id.as_str()), "{id}");
        }
    }
}

#[test]
fn tables_and_pages() {
    let table = Table::of(cases::named("A1"), Contender::Ours);
    let json = table.json().expect("numbers and strings");
    assert!(
        json.starts_with("{\"rows\":[{\"section\":\"A\",\"id\":\"A1\"") && json.ends_with("\"failed\":0}"),
        "{json}"
    );
    let page = table.page();
    assert!(page.contains("<h2>A. Denominators</h2>") && !page.contains("<h2>B.") && !page.contains("http"), "{page}");
    let a8 = Table::of(cases::named("A8"), Contender::Ours);
    assert!(a8.summary().ends_with("1 flagged in place of right, 0 failed"), "{}", a8.summary());
    let broken = Table::of(cases::named("A1"), Contender::Naive);
    assert!(broken.page().contains("class=\"bad\">FAILS: textbook") && broken.to_string().contains("2 failed"));
}

#[test]
fn the_condition_of_wamplers_powers_is_as_documented() {
    let condition = cases::condition_of_wampler();
    assert!((condition / 2.664e6 - 1.0).abs() <= 1e-3, "{condition:e}");
}
