//! The page *What we promise* names tests that exist.

/// `file`: `test`, `test`.
fn cited(page: &str) -> Vec<(String, String)> {
    let mut cited = Vec::new();
    for line in page.lines() {
        let mut file = "";
        // Between backquotes is every second part.
        for code in line.split('`').skip(1).step_by(2) {
            let is_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
            if code.ends_with(".rs") {
                file = code;
            } else if !file.is_empty() && code.contains('_') && code.chars().all(is_name) {
                cited.push((file.into(), code.into()));
            }
        }
    }
    cited
}

#[test]
fn every_test_that_is_cited_is_there() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let page = std::fs::read_to_string(format!("{root}/core/src/promises.md")).expect("the page");
    let tests = cited(&page);
    assert!(tests.len() >= 25, "{}", tests.len());
    for (file, test) in tests {
        let source =
            std::fs::read_to_string(format!("{root}/{file}")).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(source.contains(&format!("fn {test}(")), "{file} has no {test}");
    }
}

#[test]
fn a_row_is_read() {
    let row = "| `x` holds | `tests/a.rs`: `first_one`, `second_one`; `tests/b.rs`: `third_one` |";
    let pair = |file: &str, test: &str| (file.to_string(), test.to_string());
    assert_eq!(
        cited(row),
        [pair("tests/a.rs", "first_one"), pair("tests/a.rs", "second_one"), pair("tests/b.rs", "third_one")]
    );
}
