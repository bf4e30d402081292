//! Five co-moments of 16 channels, in L1 and beyond it.

use criterion::{Criterion, criterion_group, criterion_main};
use ratiocv_benches::sets;

mod support;

fn comoments(criterion: &mut Criterion) {
    let both = [sets::comoments("comoments", sets::IN_L1), sets::comoments("comoments-l2", sets::IN_L2)];
    support::measure(criterion, both.into_iter().flatten());
}

criterion_group!(benches, comoments);
criterion_main!(benches);
