//! Many independent estimates by every estimator.

use crate::catalogue::{Everything, Method, everything};
use crate::measure::plan::Size;
use crate::measure::tally::Tally;
use crate::problems::{Solved, Source};
use rand_core::Rng;
use ratiocv_core::moments::ExtremesBlock;
use ratiocv_core::{Error, Lanes};
use ratiocv_threads::{map_chunks, stream};

/// The seed of the draws of problem `id` at `draws` draws: the same whatever else is measured.
pub(crate) fn cell_seed(seed: u64, id: &str, draws: u64) -> u64 {
    // FNV-1a; the stream spreads its bits.
    let name = id
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    stream(seed, name ^ draws).next_u64()
}

/// The errors of `methods` on `problem`, from `size.replicates` estimates on the same draws each.
///
/// The same bits for any number of threads.
///
/// # Errors
/// [`Error::Weight`] unless 0 ≤ `weight` < 1.
pub(super) fn replicates<S: Solved>(
    problem: &S,
    methods: &[Method],
    weight: f64,
    size: Size,
    seed: u64,
) -> Result<Vec<Tally>, Error> {
    let (source, exact) = (problem.source(), problem.exact());
    let integrals = source.integrals();
    let empty: Everything<S::Value, ExtremesBlock<S::Value>> = everything::<_, _, ()>(weight, &integrals)?;
    let seed = cell_seed(seed, S::DESCRIPTION.id, size.draws);
    let none = || vec![Tally::new(S::Value::LANES); methods.len()];
    let parts = map_chunks(size.replicates, size.chunk, |chunk| {
        let mut tallies = none();
        for replicate in chunk.start..chunk.start + chunk.count {
            let mut moments = empty;
            source.accumulate(&mut moments, size.draws, &mut stream(seed, replicate));
            for (tally, method) in tallies.iter_mut().zip(methods) {
                let estimate = method.estimate(weight, &moments, &integrals);
                tally.add(&estimate.value, &exact);
                if size.judged {
                    tally.judge(|channel| (estimate.channel(channel), exact.get(channel)));
                }
            }
        }
        tallies
    });
    let mut sum = none();
    for part in &parts {
        for (sum, part) in sum.iter_mut().zip(part) {
            sum.append(part);
        }
    }
    Ok(sum)
}
