//! Contenders as criterion's benchmarks. Their answers are compared when the sets are made.

use criterion::{Criterion, Throughput};
use ratiocv_benches::Measured;

/// Measures each, in samples and channels per second.
pub(crate) fn measure(criterion: &mut Criterion, contenders: impl IntoIterator<Item = Measured>) {
    for mut contender in contenders {
        let mut group = criterion.benchmark_group(contender.set);
        group.throughput(Throughput::Elements(contender.samples as u64));
        group.bench_function(contender.id.clone(), |bencher| bencher.iter(|| contender.pass()));
        group.finish();
    }
}
