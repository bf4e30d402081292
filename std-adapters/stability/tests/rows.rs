//! Every case is a test: a section at a time, on every lane type of both precisions.

use ratiocv_stability::{Contender, Table, cases};

#[track_caller]
fn section(name: &str) {
    let table = Table::of(cases::named(name), Contender::Ours);
    assert!(!table.rows.is_empty(), "no case in section {name}");
    assert_eq!(table.failures().count(), 0, "\n{table}");
}

#[test]
fn a_denominators() {
    section("A");
}

#[test]
fn b_dynamic_range() {
    section("B");
}

#[test]
fn c_cancellation() {
    section("C");
}

#[test]
fn d_counts() {
    section("D");
}
