//! Means of 16 channels.

use criterion::{Criterion, criterion_group, criterion_main};
use ratiocv_benches::sets;

mod support;

fn sums(criterion: &mut Criterion) {
    support::measure(criterion, sets::sums(sets::IN_L1));
}

criterion_group!(benches, sums);
criterion_main!(benches);
