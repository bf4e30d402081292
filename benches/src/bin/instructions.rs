//! Runs our contenders and those by hand one after another, each inside a call of `counted` for callgrind to
//! count, and prints their names and the samples that each call goes through. See benches/instructions.

use ratiocv_benches::{Measured, sets};

const PASSES: usize = 8;

/// Other libraries change with their versions, not with us; and AVX-512 is unknown to valgrind.
fn is_counted(contender: &Measured) -> bool {
    !["average", "statrs", "ndarray-stats"].contains(&&*contender.id) && !contender.id.starts_with("avx512")
}

#[inline(never)]
fn counted(contender: &mut Measured) {
    for _ in 0..PASSES {
        contender.pass();
    }
}

fn main() {
    for contender in &mut sets::all(sets::IN_L1).into_iter().filter(is_counted).collect::<Vec<_>>() {
        counted(contender);
        println!("{} {}", contender.name(), PASSES * contender.samples);
    }
}
