//! An interrupted run, resumed from its checkpoint, has the bits of one that was not.

use core::sync::atomic::{AtomicBool, Ordering::Relaxed};
use core::time::Duration;
use ratiocv_core::moments::{Accumulate, Comoments, Merge, Moments, Save};
use ratiocv_core::{
    CrossFitted, Difference, Draw, Estimate, Estimator, HartleyRoss, Lanes, Mickey, Plain, Problem, RatioOfMeans,
    Reads, Spectrum, Uniform, WithIntegral,
};
use ratiocv_threads::{CHUNK, MergeTree, Run, Stopped, integrate, stream};

const DRAWS: u64 = 300 * CHUNK + 1003;

fn bits<V: Lanes>(estimate: &Estimate<V>) -> Vec<[u64; 2]> {
    (0..V::LANES).map(|i| estimate.channel(i)).map(|c| [c.value.to_bits(), c.std_error.to_bits()]).collect()
}

fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool").install(work)
}

/// Three sittings on different numbers of threads, the first two cancelled at `cuts`.
fn interrupted<E>(estimator: &E, draws: u64, cuts: [u64; 2])
where
    E: Reads + Sync,
    E: Estimator<<E::ErrorBar<Spectrum<f64, 2>> as Moments>::Channel>,
    E: Estimator<<E::ErrorBar<Spectrum<f32, 3>> as Moments>::Channel>,
    E::ErrorBar<Spectrum<f64, 2>>: Send,
    E::ErrorBar<Spectrum<f32, 3>>: Send,
{
    let in_f64 = Problem::new(|x: &f64| Spectrum([x * x, 1.0 / (0.1 + x)]))
        .auxiliary(WithIntegral::new(|x: &f64| Spectrum([*x, 1.0 - x]), Spectrum([0.5, 0.5])))
        .proposal(Uniform);
    let in_f32 = Problem::new(|x: &f64| Spectrum([x * x, 1.0 / (0.1 + x), 0.5].map(|f| f as f32)))
        .auxiliary(WithIntegral::new(|x: &f64| Spectrum([*x, 1.0 - x, x * x].map(|h| h as f32)), {
            Spectrum([0.5, 0.5, 1.0 / 3.0])
        }))
        .proposal(Uniform);
    let folder = tempfile::tempdir().expect("a folder");
    macro_rules! sittings {
        ($problem:ident) => {{
            let whole = integrate(&$problem, estimator, draws, 7).expect("draws");
            for (i, threads) in [[1, 2, 3], [2, 5, 1], [3, 1, 8], [5, 8, 2], [8, 3, 5]].iter().enumerate() {
                let path = folder.path().join(format!("{}-{i}", stringify!($problem)));
                for (sitting, threads) in threads.iter().enumerate() {
                    let stop = AtomicBool::new(false);
                    let cut = cuts.get(sitting).copied().unwrap_or(u64::MAX);
                    let run = Run::new(draws, 7)
                        .cancel(&stop)
                        .checkpoint(&path, Duration::from_millis(5))
                        .progress(|done, _| stop.store(done >= cut, Relaxed));
                    let outcome = on(*threads, || run.integrate(&$problem, estimator)).expect("draws");
                    let same = integrate(&$problem, estimator, outcome.draws, 7).expect("draws");
                    assert_eq!(bits(&outcome.estimate), bits(&same), "{}: {} draws", E::ID, outcome.draws);
                    if sitting == 2 {
                        assert_eq!((outcome.draws, outcome.stopped), (draws, Stopped::Finished));
                        assert_eq!(bits(&outcome.estimate), bits(&whole), "{}", E::ID);
                    }
                }
            }
        }};
    }
    sittings!(in_f64);
    sittings!(in_f32);
}

#[test]
fn resumed_runs_of_several_estimators_have_the_bits_of_whole_ones() {
    let cuts = [40 * CHUNK, 151 * CHUNK];
    interrupted(&Plain, DRAWS, cuts);
    interrupted(&RatioOfMeans, DRAWS, cuts);
    interrupted(&Mickey.defensive(0.01).expect("a weight"), DRAWS, cuts);
    interrupted(&HartleyRoss.defensive(0.1).expect("a weight"), DRAWS, cuts);
    interrupted(&CrossFitted(Difference::default()), DRAWS, cuts);
}

#[test]
fn runs_of_few_chunks_have_them_too() {
    for (chunks, rest) in [(0, 5), (1, 0), (2, 1), (5, 0), (16, 4095)] {
        let draws = chunks * CHUNK + rest;
        // Cut after the first chunk, if there is one, and after another one.
        interrupted(&RatioOfMeans, draws, [CHUNK, 2 * CHUNK]);
    }
}

/// Saved after every number of chunks and loaded into empty moments, an open block in each chunk: one
/// thread, no chance.
#[test]
fn every_prefix_of_a_tree_survives_saving() {
    let problem = Problem::new(|x: &f64| Spectrum([x * x, 1.0 / (0.1 + x)].map(|f| f as f32)))
        .auxiliary(WithIntegral::new(|x: &f64| Spectrum([*x, 1.0 - x].map(|h| h as f32)), Spectrum([0.5, 0.5])))
        .proposal(Uniform);
    fn check<E, P>(estimator: &E, problem: P)
    where
        E: Reads + Estimator<<E::ErrorBar<Spectrum<f32, 2>> as Moments>::Channel>,
        P: Fn(&mut E::ErrorBar<Spectrum<f32, 2>>, u64),
    {
        let integrals = &ratiocv_core::Integrals::new([Spectrum([0.5, 0.5])]);
        let empty = || estimator.error_bar::<Spectrum<f32, 2>>(integrals);
        let saved = |moments: &E::ErrorBar<Spectrum<f32, 2>>| {
            let (mut words, mut loaded) = (Vec::new(), empty());
            { *moments }.words(&mut |word| words.push(*word));
            let mut words = words.into_iter();
            loaded.words(&mut |word| *word = words.next().expect("a word"));
            loaded
        };
        let part = |chunk: u64| {
            let mut moments = empty();
            problem(&mut moments, chunk);
            moments
        };
        let read = |moments: Option<_>| bits(&estimator.estimate(&moments.expect("draws"), integrals).expect("draws"));
        let mut whole = MergeTree::default();
        let mut resumed = MergeTree::default();
        for chunk in 0..20 {
            whole.push(part(chunk));
            resumed.push(part(chunk));
            assert_eq!(read(whole.clone().merged()), read(resumed.clone().merged()), "{} chunks", chunk + 1);
            let mut all: Vec<_> = resumed.subtrees().iter().map(saved).collect();
            // The subtrees again, by the merges that they came from: saved parts merge as unsaved ones do.
            let later = all.pop().expect("a subtree");
            let merged = all.into_iter().rev().fold(later, |later, mut earlier| {
                earlier.merge(&later);
                earlier
            });
            assert_eq!(read(whole.clone().merged()), read(Some(merged)), "{} chunks, saved", chunk + 1);
        }
    }
    let draws = |chunk: u64| 70 + 13 * chunk;
    macro_rules! checked {
        ($($estimator:expr),*) => {$(
            check(&$estimator, |moments, chunk| problem.accumulate(moments, draws(chunk), &mut stream(7, chunk)));
        )*};
    }
    checked!(
        Plain,
        RatioOfMeans,
        Mickey,
        HartleyRoss.defensive(0.1).expect("a weight"),
        CrossFitted(Difference::default())
    );
}

/// The sign and the payload of a NaN are the processor's choice, those in a checkpoint are not.
#[test]
fn checkpoints_have_one_nan() {
    let mut moments = Comoments::<f64>::default();
    for f in [0xfff8_0000_0000_0000, 0x7ff8_beef_0000_0000].map(f64::from_bits) {
        moments.add(Draw::new(f, 1.0));
    }
    let mut nans = Vec::new();
    moments.words(&mut |word| nans.extend(f64::from_bits(*word).is_nan().then_some(*word)));
    assert!(!nans.is_empty() && nans.iter().all(|nan| *nan == f64::NAN.to_bits()), "{nans:x?}");
}
