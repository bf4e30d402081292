//! The adaptive grid: its density is the one it draws from, what it learns, what it does not.

mod density;
mod integrals;
mod learning;
mod support;
