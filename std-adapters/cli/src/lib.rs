//! The `ratiocv` command: `report`, `render`, `list`, `estimate` and `stability`.
//!
//! `estimate` is a pipe of small parts: [`rows`] cuts text into fields, [`columns`] gives the fields
//! their meaning, [`number`] reads one, [`intake`] streams draws into accumulators, [`verdict`] turns
//! these into estimates and says which one the predictions favour, and [`output`] prints them.

pub mod arguments;
pub mod columns;
pub mod estimate;
pub mod fault;
pub mod flag_help;
pub mod intake;
pub mod integrals;
pub mod list;
pub mod number;
pub mod output;
pub mod progress;
pub mod render;
pub mod report;
pub mod rows;
pub mod scene;
pub mod stability;
pub mod style;
pub mod verdict;
pub mod words;
