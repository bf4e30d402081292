//! A process that is killed, for real, at any moment.

use core::sync::atomic::AtomicBool;
use core::time::Duration;
use ratiocv_core::{
    Auxiliaries, Defensive, Integrand, Mickey, Problem, Proposal, Reads, Spectrum, Uniform, WithIntegral,
};
use ratiocv_threads::{CHUNK, Run, Stopped, integrate};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

type Values = Spectrum<f64, 2>;

/// So many that no child is done before it is killed: each two chunks are followed by a write to the disk.
const DRAWS: u64 = 4000 * CHUNK + 5;
const THREADS: u64 = 2;
const FILE: &str = "RATIOCV_TESTS_CHECKPOINT";

fn problem() -> Problem<
    impl Integrand<f64, Value = Values> + Sync,
    impl Auxiliaries<f64, Values, 1> + Sync,
    impl Proposal<Point = f64> + Sync,
    f64,
> {
    Problem::new(|x: &f64| Spectrum([x * x, 1.0 / (0.1 + x)]))
        .auxiliary(WithIntegral::new(|x: &f64| Spectrum([*x, 1.0 - x]), Spectrum([0.5, 0.5])))
        .proposal(Uniform)
}

fn mickey() -> Defensive<Mickey> {
    Mickey.defensive(0.01).expect("a weight")
}

fn run(path: &Path, every: Duration) -> Run<'_> {
    Run::new(DRAWS, 11).checkpoint(path, every)
}

/// What the killed process does; without the variable, nothing.
#[test]
fn child() {
    let Some(path) = std::env::var_os(FILE).map(PathBuf::from) else { return };
    let tell = |done, _| {
        println!("done {done}");
        std::io::stdout().flush().expect("a reader");
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(THREADS as usize).build().expect("a pool");
    pool.install(|| run(&path, Duration::ZERO).progress(tell).integrate(&problem(), &mickey())).expect("a run");
}

#[test]
fn a_killed_run_loses_an_interval_at_most_and_no_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run");
    let mut killed = 0;
    for kill in 1..=9 {
        let mut child = Command::new(std::env::current_exe().expect("this test"))
            .args(["--exact", "kill::child", "--nocapture"])
            .env(FILE, &path)
            .stdout(Stdio::piped())
            .spawn()
            .expect("a child");
        let mut lines = BufReader::new(child.stdout.take().expect("a pipe")).lines().map_while(Result::ok);
        let mut last = 0;
        let mut next = || {
            let line = lines.next()?;
            // The harness does not end its own line before a test prints.
            if let Some((_, done)) = line.rsplit_once("done ") {
                last = done.parse().expect("a number");
            }
            Some(last)
        };
        // Until it has got some way on, and then anywhere between two draws or two bytes.
        while next().is_some_and(|done| done < kill * 20 * CHUNK) {}
        std::thread::sleep(Duration::from_micros(370 * kill));
        child.kill().expect("SIGKILL");
        while next().is_some() {}
        killed += u64::from(!child.wait().expect("a status").success());
        // Each interval is a chunk per thread here, and what was told after one was saved before.
        let kept = run(&path, Duration::ZERO)
            .cancel(&AtomicBool::new(true))
            .integrate(&problem(), &mickey())
            .expect("a checkpoint");
        assert!(last - last.min(kept.draws) <= THREADS * CHUNK, "{} of {last} draws were kept", kept.draws);
    }
    assert!(killed >= 3, "only {killed} children were killed before they were done");
    let outcome = run(&path, Duration::from_secs(3600)).integrate(&problem(), &mickey()).expect("a run");
    assert_eq!((outcome.draws, outcome.stopped), (DRAWS, Stopped::Finished));
    let whole = integrate(&problem(), &mickey(), DRAWS, 11).expect("draws");
    for channel in 0..2 {
        let (resumed, whole) = (outcome.estimate.channel(channel), whole.channel(channel));
        assert_eq!(resumed.value.to_bits(), whole.value.to_bits());
        assert_eq!(resumed.std_error.to_bits(), whole.std_error.to_bits());
    }
}
