//! Inputs that were kept, and some that nobody chose.

use ratiocv_tests::samples::Noise;
use std::fs;
use std::path::Path;

/// Pseudo-random inputs of each law.
const RANDOM: usize = 2000;

/// Calls `law` with every file of `fuzz/corpus/NAME` and `fuzz/crashes/NAME`, and with pseudo-random bytes.
///
/// Panics if the law is broken, or there is no corpus.
pub fn replay(name: &str, law: fn(&[u8])) {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz");
    let mut kept = 0;
    for folder in ["corpus", "crashes"] {
        let Ok(files) = fs::read_dir(fuzz.join(folder).join(name)) else { continue };
        for file in files {
            let path = file.expect("a file").path();
            println!("{}", path.display()); // what a failure was about
            law(&fs::read(path).expect("its bytes"));
            kept += 1;
        }
    }
    assert!(kept > 0, "there is no corpus of {name}");
    let mut noise = Noise(0x5eed);
    for _ in 0..RANDOM {
        let length = (noise.next_unit() * 96.0) as usize;
        let bytes: Vec<u8> = (0..length).map(|_| (noise.next_unit() * 256.0) as u8).collect();
        if std::panic::catch_unwind(|| law(&bytes)).is_err() {
            panic!("{name} is broken by {bytes:?}");
        }
    }
}
