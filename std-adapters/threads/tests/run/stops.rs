//! Progress, cancellation, time budgets, panics.

use core::panic::AssertUnwindSafe;
use core::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use core::time::Duration;
use ratiocv_core::{ChannelEstimate, Estimate, Plain, Problem, RatioOfMeans, Uniform, WithIntegral};
use ratiocv_threads::{CHUNK, Error, Outcome, Run, Stopped, integrate};
use std::panic::catch_unwind;

const DRAWS: u64 = 30 * CHUNK + 77;

fn bits(estimate: &Estimate<f64>) -> [u64; 2] {
    let ChannelEstimate { value, std_error, .. } = estimate.channel(0);
    [value.to_bits(), std_error.to_bits()]
}

fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool").install(work)
}

macro_rules! problem {
    ($f:expr) => {
        Problem::new($f).auxiliary(WithIntegral::new(|x: &f64| *x, 0.5)).proposal(Uniform)
    };
}

#[test]
fn a_run_without_anything_is_integrate() {
    let problem = problem!(|x: &f64| x.exp());
    for draws in [1, CHUNK - 1, CHUNK, DRAWS, 200 * CHUNK + 1] {
        let outcome = Run::new(draws, 3).integrate(&problem, &Plain).expect("draws");
        assert_eq!((outcome.draws, outcome.stopped), (draws, Stopped::Finished));
        assert_eq!(bits(&outcome.estimate), bits(&integrate(&problem, &Plain, draws, 3).expect("draws")));
    }
    let nothing = Run::new(0, 3).integrate(&problem, &Plain);
    assert!(matches!(nothing, Err(Error::Estimate(ratiocv_core::Error::TooFewDraws { got: 0, .. }))), "{nothing:?}");
}

#[test]
fn progress_begins_at_nothing_never_falls_and_ends_at_the_total() {
    let problem = problem!(|x: &f64| x * x);
    for threads in [1, 2, 8] {
        let mut told = Vec::new();
        let run = Run::new(DRAWS, 1).progress(|done, total| told.push((done, total)));
        on(threads, || run.integrate(&problem, &Plain)).expect("draws");
        assert_eq!((told[0], told[told.len() - 1]), ((0, DRAWS), (DRAWS, DRAWS)));
        assert!(told.is_sorted_by(|a, b| a < b), "{told:?}");
        assert!(threads > 1 || told.len() == 32, "one thread tells of each chunk: {told:?}");
    }
}

#[test]
fn a_cancelled_run_is_a_shorter_run() {
    let problem = problem!(|x: &f64| x.exp());
    // Long enough for a thread that was stopped in the callback to wake up before the others are done.
    let total = 2000 * CHUNK;
    for threads in [1, 2, 3, 5, 8] {
        for after in [1, 4, 17] {
            let stop = AtomicBool::new(false);
            let run = Run::new(total, 5).cancel(&stop).progress(|done, _| stop.store(done >= after * CHUNK, Relaxed));
            let Outcome { estimate, draws, stopped } =
                on(threads, || run.integrate(&problem, &RatioOfMeans)).expect("a chunk");
            assert_eq!(stopped, Stopped::Cancelled);
            // Each other thread may be at a chunk, and may take one more before the flag is set.
            assert!(draws % CHUNK == 0 && draws >= after * CHUNK, "{draws} draws");
            assert_eq!(bits(&estimate), bits(&integrate(&problem, &RatioOfMeans, draws, 5).expect("draws")));
            assert!(threads > 1 || draws == after * CHUNK, "one thread stops at once: {draws} draws");
        }
    }
}

#[test]
fn what_was_worked_off_is_in_the_estimate() {
    let (calls, stop) = (AtomicU64::new(0), AtomicBool::new(false));
    let problem = Problem::new(|x: &f64| {
        stop.store(calls.fetch_add(1, Relaxed) > 5 * CHUNK, Relaxed);
        *x
    })
    .proposal(Uniform);
    let run = Run::new(DRAWS, 5).cancel(&stop);
    let outcome = on(3, || run.integrate::<_, _, _, _, _, 0>(&problem, &Plain)).expect("draws");
    assert_eq!(outcome.draws, calls.load(Relaxed));
}

#[test]
fn a_run_that_is_stopped_before_its_first_chunk_has_too_few_draws() {
    let problem = problem!(|_: &f64| -> f64 { panic!("no draw is made") });
    let too_few = |result| matches!(result, Err(Error::Estimate(ratiocv_core::Error::TooFewDraws { got: 0, .. })));
    assert!(too_few(Run::new(DRAWS, 5).cancel(&AtomicBool::new(true)).integrate(&problem, &Plain)));
    assert!(too_few(Run::new(DRAWS, 5).time_budget(Duration::ZERO).integrate(&problem, &Plain)));
}

#[test]
fn a_time_budget_is_kept_to_a_chunk() {
    // 4096 draws of 5 μs at least: a chunk of 20 ms or more, 150 of them.
    let problem = problem!(|x: &f64| {
        let begun = std::time::Instant::now();
        while begun.elapsed() < Duration::from_micros(5) {}
        x * x
    });
    let run = Run::new(150 * CHUNK, 5).time_budget(Duration::from_millis(200));
    let outcome = on(2, || run.integrate(&problem, &Plain)).expect("a chunk");
    assert_eq!(outcome.stopped, Stopped::OutOfTime);
    // Within 200 ms no thread begins more than ten chunks.
    assert!(outcome.draws <= 2 * 10 * CHUNK, "{} draws", outcome.draws);
    assert_eq!(bits(&outcome.estimate), bits(&integrate(&problem, &Plain, outcome.draws, 5).expect("draws")));
}

#[test]
fn a_panic_is_passed_on_soon_and_leaves_the_checkpoint() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run");
    let (calls, healthy) = (AtomicU64::new(0), AtomicBool::new(false));
    let problem = problem!(|x: &f64| {
        let sick = calls.fetch_add(1, Relaxed) > 9 * CHUNK && !healthy.load(Relaxed);
        assert!(!sick, "an integrand that panics");
        x * x
    });
    let run = || Run::new(DRAWS, 5).checkpoint(&path, Duration::ZERO);
    let panicked = catch_unwind(AssertUnwindSafe(|| on(2, || run().integrate(&problem, &Plain))));
    let message = panicked.expect_err("the panic is passed on");
    assert_eq!(message.downcast_ref(), Some(&"an integrand that panics"));
    // Every thread stopped at its panic, none went on through the wave.
    assert!(calls.load(Relaxed) <= 10 * CHUNK, "{} calls", calls.load(Relaxed));

    healthy.store(true, Relaxed);
    let kept = run().cancel(&AtomicBool::new(true)).integrate(&problem, &Plain).expect("a checkpoint");
    // Of 9 chunks at least, no more than the last round of two is lost, and the first 8 draws were made twice.
    assert!((6 * CHUNK..=9 * CHUNK).contains(&kept.draws), "{} draws", kept.draws);
    let all = run().integrate(&problem, &Plain).expect("draws");
    assert_eq!(bits(&all.estimate), bits(&integrate(&problem, &Plain, DRAWS, 5).expect("draws")));
    // And a callback that panics.
    let run = run().checkpoint(folder.path().join("other"), Duration::ZERO).progress(|done, _| assert!(done < CHUNK));
    assert!(catch_unwind(AssertUnwindSafe(|| on(2, || run.integrate(&problem, &Plain)))).is_err());
}
