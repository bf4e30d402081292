//! Weights of several techniques: heuristics (E14–E16), and the optimum for separate draws.

mod constants;
mod heuristics;
mod law;
mod optimum;
mod separate_draws;
