//! Files that are not, or no longer, the checkpoint of the run.

use core::sync::atomic::AtomicBool;
use core::time::Duration;
use rand_core::Rng;
use ratiocv_core::{HartleyRoss, Plain, Problem, RatioOfMeans, Reads, Spectrum, Uniform, WithIntegral};
use ratiocv_threads::{CHUNK, Error, Fault, Outcome, Run, stream};
use std::fs;
use std::path::{Path, PathBuf};

const DRAWS: u64 = 7 * CHUNK;

const HOUR: Duration = Duration::from_secs(3600);

fn square(path: &Path, run: Run<'_>) -> Result<Outcome<f64>, Error> {
    let problem = Problem::new(|x: &f64| x * x).proposal(Uniform);
    run.checkpoint(path, HOUR).integrate::<_, _, _, _, _, 0>(&problem, &Plain)
}

/// Reads the file and makes no draws.
fn resumed(path: &Path) -> Result<Outcome<f64>, Error> {
    square(path, Run::new(DRAWS, 1).cancel(&AtomicBool::new(true)))
}

fn fault<T>(result: Result<T, Error>) -> Option<Fault> {
    match result {
        Err(Error::Checkpoint { fault, .. }) => Some(fault),
        _ => None,
    }
}

/// A folder, the path of a finished checkpoint in it, and its bytes.
fn finished() -> (tempfile::TempDir, PathBuf, Vec<u8>) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run");
    square(&path, Run::new(DRAWS, 1)).expect("draws");
    let bytes = fs::read(&path).expect("a file");
    (folder, path, bytes)
}

/// The fault of the file when it has these bytes, which it must keep.
fn fault_of(path: &Path, bytes: &[u8]) -> Option<Fault> {
    fs::write(path, bytes).expect("a file");
    let fault = fault(resumed(path));
    assert!(fault.is_none() || fs::read(path).expect("a file") == bytes, "a refused file was changed");
    fault
}

/// With the length and the checksum that these bytes should have.
fn repaired(mut bytes: Vec<u8>) -> Vec<u8> {
    let (length, end) = (bytes.len() as u64, bytes.len() - 4);
    bytes[8..16].copy_from_slice(&length.to_le_bytes());
    let checksum = crc32fast::hash(&bytes[..end]);
    bytes[end..].copy_from_slice(&checksum.to_le_bytes());
    bytes
}

#[test]
fn a_finished_run_answers_from_its_file() {
    let (_folder, path, bytes) = finished();
    let again = resumed(&path).expect("the answer");
    assert_eq!((again.draws, again.stopped), (DRAWS, ratiocv_threads::Stopped::Finished));
    assert!((again.estimate.value - 1.0 / 3.0).abs() <= 5.0 * again.estimate.std_error);
    assert_eq!(fs::read(&path).expect("a file"), bytes, "nothing was new");
    assert_eq!(repaired(bytes.clone()), bytes);
}

#[test]
fn every_truncation_is_refused() {
    let (_folder, path, bytes) = finished();
    for length in 0..bytes.len() {
        match fault_of(&path, &bytes[..length]) {
            Some(Fault::Truncated { bytes: here, of }) => {
                assert_eq!(here, length as u64);
                assert!(of == bytes.len() as u64 || (length < 16 && of == 24), "{length} of {of}");
            }
            other => panic!("{length} bytes: {other:?}"),
        }
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(matches!(fault_of(&path, &longer), Some(Fault::Damaged(_))));
}

#[test]
fn every_flipped_bit_is_refused() {
    let (_folder, path, bytes) = finished();
    for bit in 0..8 * bytes.len() {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        let fault = fault_of(&path, &flipped);
        let right = match bit / 64 {
            0 => matches!(fault, Some(Fault::Foreign)),
            1 => matches!(fault, Some(Fault::Truncated { .. } | Fault::Damaged(_))),
            _ => matches!(fault, Some(Fault::Damaged("its checksum is not that of its contents"))),
        };
        assert!(right, "bit {bit}: {fault:?}");
    }
}

#[test]
fn foreign_files_and_random_bytes_are_refused() {
    let (_folder, path, bytes) = finished();
    assert!(matches!(fault_of(&path, b"f.red,h.red\n1,2\n"), Some(Fault::Foreign)));
    let mut rng = stream(0xf11e, 0);
    for trial in 0..3000 {
        let length = (rng.next_u64() % 300) as usize;
        let mut noise: Vec<u8> = (0..length).map(|_| rng.next_u64() as u8).collect();
        // A third of them with the right beginning, a third with the right checksum, too.
        if trial % 3 > 0 && length >= 24 {
            noise[..8].copy_from_slice(&bytes[..8]);
        }
        if trial % 3 > 1 && length >= 24 {
            noise[16..20].copy_from_slice(&bytes[16..20]);
            noise = repaired(noise);
        }
        assert!(fault_of(&path, &noise).is_some(), "trial {trial}");
    }
}

/// Not damage, but malice or a bug: nothing may panic, and what contradicts itself is refused.
#[test]
fn wrong_contents_with_a_right_checksum_do_no_harm() {
    let (_folder, path, bytes) = finished();
    // Chunks done; three subtrees of 1 + 3 words each; checksum.
    let (chunks, words) = (bytes.len() - 4 - 12 * 8 - 8, bytes.len() - 4 - 12 * 8);
    for byte in 16..bytes.len() - 4 {
        for change in [0x01, 0x80, 0xff] {
            let mut wrong = bytes.clone();
            wrong[byte] ^= change;
            let fault = fault_of(&path, &repaired(wrong));
            // The words of a mean may be anything; the count of its draws, before it, may not.
            let free = byte >= words && (byte - words) % 32 >= 8;
            assert_eq!(fault.is_none(), free, "byte {byte}: {fault:?}");
        }
    }
    for count in [8, u64::MAX, 1 << 63] {
        let mut wrong = bytes.clone();
        wrong[chunks..words].copy_from_slice(&u64::to_le_bytes(count));
        assert!(matches!(fault_of(&path, &repaired(wrong)), Some(Fault::Damaged("it has more chunks than its run"))));
    }
    let shorter = [&bytes[..words], &bytes[words + 32..]].concat();
    assert!(matches!(fault_of(&path, &repaired(shorter)), Some(Fault::Damaged(_))));
    let longer = [&bytes[..bytes.len() - 4], &bytes[words..words + 32], &[0; 4]].concat();
    assert!(matches!(fault_of(&path, &repaired(longer)), Some(Fault::Damaged("there is something after its end"))));
    let mut newer = bytes;
    newer[16] = 2;
    assert!(matches!(fault_of(&path, &repaired(newer)), Some(Fault::Version { file: 2, here: 1 })));
}

#[test]
fn a_checkpoint_of_another_run_is_refused_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run");
    let stop = AtomicBool::new(true);
    let made = |run: Run<'static>, weight: f64, scale: f64, integral: f64| {
        let h = WithIntegral::new(|x: &f64| *x, integral);
        let problem = Problem::new(move |x: &f64| scale * x * x).auxiliary(h).proposal(Uniform);
        run.checkpoint(&path, HOUR).integrate(&problem, &HartleyRoss.defensive(weight).expect("a weight"))
    };
    let run = || Run::new(DRAWS, 1);
    made(run(), 0.01, 1.0, 0.5).expect("draws");
    made(run(), 0.01, 1.0, 0.5).expect("the same run");
    let other = |result: Result<Outcome<f64>, Error>| match fault(result) {
        Some(Fault::OtherRun { setting, here, file }) => (setting, here, file),
        fault => panic!("{fault:?}"),
    };
    let text = |a: &str, b: &str, c: &str| (a.to_owned(), b.to_owned(), c.to_owned());
    assert_eq!(other(made(Run::new(DRAWS, 2), 0.01, 1.0, 0.5)), text("the seed", "2", "1"));
    assert_eq!(other(made(Run::new(DRAWS + 1, 1), 0.01, 1.0, 0.5)), text("the number of draws", "28673", "28672"));
    assert_eq!(
        other(made(run(), 0.1, 1.0, 0.5)),
        text("the list of parameters of the moments", "[9: 0.1, 10: 0.05]", "[9: 0.01, 10: 0.005]")
    );
    assert_eq!(other(made(run(), 0.01, 1.0, 0.25)).0, "the known integral of auxiliary 0, channel 0,");
    assert_eq!(other(made(run(), 0.01, 1.1, 0.5)).0, "the checksum of the first draws");
    assert_eq!(
        other(made(run().fingerprint("another scene"), 0.01, 1.0, 0.5)),
        text("the fingerprint", "\"another scene\"", "\"\"")
    );
    let h = WithIntegral::new(|x: &f64| *x, 0.5);
    let problem = Problem::new(|x: &f64| x * x).auxiliary(h).proposal(Uniform);
    let result = run().checkpoint(&path, HOUR).cancel(&stop).integrate(&problem, &RatioOfMeans);
    assert_eq!(other(result), text("the estimator", "ratio", "defensive_hartley_ross"));
    let result = run()
        .checkpoint(&path, HOUR)
        .integrate::<_, _, _, _, _, 0>(&Problem::new(|x: &f64| Spectrum([*x, *x])).proposal(Uniform), &Plain);
    assert!(matches!(fault(result), Some(Fault::OtherRun { .. })));
    let h = WithIntegral::new(|x: &f64| *x as f32, 0.5);
    let problem = Problem::new(|x: &f64| (x * x) as f32).auxiliary(h).proposal(Uniform);
    let result = run().checkpoint(&path, HOUR).integrate(&problem, &HartleyRoss.defensive(0.01).expect("a weight"));
    assert!(matches!(fault(result), Some(Fault::OtherRun { setting, .. }) if setting == "bytes per number"));
}

#[test]
fn faults_say_what_to_do() {
    let (_folder, path, bytes) = finished();
    let message = |bytes: &[u8]| {
        fs::write(&path, bytes).expect("a file");
        let text = resumed(&path).expect_err("a fault").to_string();
        text.replace(&path.display().to_string(), "FILE")
    };
    assert_eq!(
        message(&bytes[..100]),
        format!(
            "checkpoint FILE: truncated: 100 of {} bytes: restore a copy of it, or delete it to start anew",
            bytes.len()
        )
    );
    assert_eq!(message(b"PNG"), "checkpoint FILE: this is not a checkpoint of ratiocv: give another file name");
    fs::write(&path, bytes).expect("a file");
    let other = square(&path, Run::new(DRAWS, 2)).expect_err("another seed").to_string();
    assert!(
        other.ends_with(
            "made by another run: the seed is 2 here and 1 in the file: resume with the settings of the file, or give \
             another file name to start anew"
        ),
        "{other}"
    );
}

#[test]
fn a_path_that_cannot_be_written_is_known_before_the_first_chunk() {
    let folder = tempfile::tempdir().expect("a folder");
    let nothing = |run: Run<'static>| run.progress(|_, _| panic!("no draw is made"));
    for path in [folder.path().join("missing/run"), folder.path().to_owned()] {
        let result = square(&path, nothing(Run::new(DRAWS, 1)));
        assert!(matches!(fault(result), Some(Fault::Io { .. })), "{}", path.display());
    }
}

#[test]
fn the_file_is_written_at_the_beginning_every_so_often_and_at_the_end() {
    let folder = tempfile::tempdir().expect("a folder");
    let problem = Problem::new(|x: &f64| x * x).proposal(Uniform);
    for (every, least, most) in [(HOUR, 2, 2), (Duration::ZERO, 8, 8)] {
        let path = folder.path().join(format!("{every:?}"));
        let mut contents = Vec::new();
        let run = Run::new(DRAWS, 1).checkpoint(&path, every);
        let look = |_, _| contents.push(fs::read(&path).expect("a file"));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
        pool.install(|| run.progress(look).integrate::<_, _, _, _, _, 0>(&problem, &Plain)).expect("draws");
        contents.push(fs::read(&path).expect("a file"));
        contents.dedup();
        assert!((least..=most).contains(&contents.len()), "every {every:?}: {} files", contents.len());
    }
    // No temporary file is left.
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2);
}
