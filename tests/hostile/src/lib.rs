//! Laws that hold whatever the bytes, one file each: a law reads bytes as hostile draws, and panics where it is broken.
//!
//! `fuzz/` calls them on what libFuzzer thinks of, `tests/corpus.rs` on the inputs that were kept.

mod bytes;
mod defensive;
mod denominators;
mod exact;
mod heuristics;
mod lanes;
mod merges;
mod moments;
mod paths;
mod replay;
mod solve;
mod truth;

pub use defensive::defensive;
pub use denominators::denominators;
pub use heuristics::heuristics;
pub use lanes::lanes;
pub use merges::merges;
pub use moments::moments;
pub use paths::paths;
pub use replay::replay;
pub use solve::solve;
