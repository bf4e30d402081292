//! The binary, as a user meets it.

mod bad_draws;
mod bad_files;
mod commands;
mod formats;
mod random_bytes;
mod render;
mod sample;
mod scene_report;
mod stability;
mod streams;
mod support;
mod usage;
