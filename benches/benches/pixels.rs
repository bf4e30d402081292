//! Five co-moments of one channel and of three, pixels as lanes.

use criterion::{Criterion, criterion_group, criterion_main};
use ratiocv_benches::sets;

mod support;

fn pixels(criterion: &mut Criterion) {
    support::measure(criterion, sets::pixels(sets::IN_L1));
}

criterion_group!(benches, pixels);
criterion_main!(benches);
