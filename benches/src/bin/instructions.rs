//! Runs one contender, to be counted by callgrind: `instructions SET/ID PASSES`; `instructions` alone lists
//! those that are counted, with the samples of a pass. See benches/instructions.

use ratiocv_benches::{Measured, sets};

/// Other libraries change with their versions, not with us; and AVX-512 is unknown to valgrind.
fn is_counted(contender: &Measured) -> bool {
    !["average", "statrs", "ndarray-stats"].contains(&contender.id) && !contender.id.starts_with("avx512")
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut contenders = sets::all(sets::IN_L1);
    match &arguments[..] {
        [] => {
            for contender in contenders.iter().filter(|contender| is_counted(contender)) {
                println!("{} {}", contender.name(), contender.samples);
            }
        }
        [name, passes] => {
            let passes: u32 = passes.parse().expect("PASSES is a number");
            let contender = contenders.iter_mut().find(|contender| contender.name() == *name);
            let contender = contender.unwrap_or_else(|| panic!("no contender {name}"));
            for _ in 0..passes {
                contender.pass();
            }
        }
        _ => panic!("instructions [SET/ID PASSES]"),
    }
}
