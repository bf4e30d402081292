//! Runs: watched, stopped, killed, resumed.

mod checkpoint;
mod kill;
mod stops;
mod tree;
