//! Checkpoints of any bytes.

use core::cell::RefCell;
use core::sync::atomic::AtomicBool;
use core::time::Duration;
use ratiocv_core::{Plain, Problem, Uniform};
use ratiocv_threads::{CHUNK, Error, Outcome, Run};
use std::fs;
use std::path::{Path, PathBuf};

const DRAWS: u64 = 7 * CHUNK;

struct Kept {
    _folder: tempfile::TempDir,
    path: PathBuf,
    /// A checkpoint of the run after all its draws.
    good: Vec<u8>,
}

thread_local! {
    static KEPT: RefCell<Option<Kept>> = const { RefCell::new(None) };
}

/// The file of a run, after a first byte that says whether the bytes are the file, a change to a good one, or that with
/// length and checksum put right: the answer of a run that could have written it, or an error; and the file stays
/// as it was.
pub fn checkpoint(bytes: &[u8]) {
    let Some((kind, bytes)) = bytes.split_first() else { return };
    KEPT.with_borrow_mut(|kept| {
        let kept = kept.get_or_insert_with(finished);
        let mut file = match kind % 4 {
            0 => bytes.to_vec(),
            1 => kept.good.iter().chain(bytes).copied().collect(),
            _ => changed(kept.good.clone(), bytes),
        };
        if kind & 8 == 0 {
            repair(&mut file);
        }
        fs::write(&kept.path, &file).expect("a file");
        match resumed(&kept.path) {
            Ok(outcome) => {
                assert!(outcome.draws <= DRAWS, "{outcome:?}");
                let words = words(&file, kept.good.len());
                assert_eq!(outcome.draws, words.0 * CHUNK, "draws of {} chunks", words.0);
                assert_eq!(words.1, outcome.draws, "draws of the subtrees");
            }
            Err(Error::Checkpoint { .. }) => {
                assert_ne!(file, kept.good, "a good checkpoint was refused");
            }
            Err(Error::Estimate(error)) => {
                // A run that was stopped before its first chunk.
                assert_eq!(words(&file, kept.good.len()), (0, 0), "{error}");
            }
            Err(other) => panic!("{other}"),
        }
        assert!(fs::read(&kept.path).expect("a file") == file, "the file was changed");
    });
}

/// Replaces bytes of `file`: two for the place, one for what is there.
fn changed(mut file: Vec<u8>, changes: &[u8]) -> Vec<u8> {
    for change in changes.chunks_exact(3) {
        let at = usize::from(u16::from_le_bytes([change[0], change[1]])) % (file.len() + 64);
        match file.get_mut(at) {
            Some(byte) => *byte = change[2],
            // Beyond the end: cut off that many.
            None => file.truncate(file.len().saturating_sub(usize::from(change[2]))),
        }
        if file.is_empty() {
            break;
        }
    }
    file
}

/// Puts length and checksum right.
fn repair(file: &mut [u8]) {
    let Some(end) = file.len().checked_sub(4).filter(|end| *end >= 20) else { return };
    let length = file.len() as u64;
    file[8..16].copy_from_slice(&length.to_le_bytes());
    let checksum = crc32fast::hash(&file[..end]);
    file[end..].copy_from_slice(&checksum.to_le_bytes());
}

/// The number of chunks, and of draws of all subtrees, where a good file of `good` bytes has them: three subtrees of one
/// count and three numbers each.
fn words(file: &[u8], good: usize) -> (u64, u64) {
    let start = good - 4 - 12 * 8 - 8;
    let word = |i: usize| u64::from_le_bytes(file[start + 8 * i..][..8].try_into().expect("eight bytes"));
    let subtrees = word(0).count_ones() as usize;
    (word(0), (0..subtrees).map(|i| word(1 + 4 * i)).sum())
}

fn finished() -> Kept {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run");
    run(&path, &AtomicBool::new(false)).expect("draws");
    let good = fs::read(&path).expect("a file");
    Kept { _folder: folder, path, good }
}

/// Reads the file and makes no draws.
fn resumed(path: &Path) -> Result<Outcome<f64>, Error> {
    run(path, &AtomicBool::new(true))
}

fn run(path: &Path, cancel: &AtomicBool) -> Result<Outcome<f64>, Error> {
    let problem = Problem::new(|x: &f64| x * x).proposal(Uniform);
    let run = Run::new(DRAWS, 1).checkpoint(path, Duration::from_secs(3600)).cancel(cancel);
    run.integrate::<_, _, _, _, _, 0>(&problem, &Plain)
}
