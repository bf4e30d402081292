//! The same bits for every lane type: each channel of every pack, array and array of packs is held against
//! that channel *alone*, in plain `f32` or `f64`.
//!
//! One source, [`operations::compare`] and [`moments::compare`], for every lane type. That the comparison
//! can fail is shown by lanes that are wrong on purpose (`wrong`).

mod hostile;
mod laws;
mod moments;
mod operations;
mod order;
mod threads;
mod wrong;
