//! Prints the lines of `ratiocv_platforms`; with the argument `packs`, those that packs make, with `regrouped`,
//! those of another tree of merges.

use ratiocv_platforms::{all, packs};

fn main() {
    let print = &mut |what: &str, name: &str, bits: u64| println!("{what} {name} {bits:016x}");
    match std::env::args().nth(1).as_deref() {
        Some("packs") => packs(print),
        Some("regrouped") => all(true, print),
        _ => all(false, print),
    }
}
