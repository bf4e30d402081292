//! What divides f by h, of 16 channels.

use criterion::{Criterion, criterion_group, criterion_main};
use ratiocv_benches::sets;

mod support;

fn ratios(criterion: &mut Criterion) {
    support::measure(criterion, sets::ratios(sets::IN_L1));
}

criterion_group!(benches, ratios);
criterion_main!(benches);
