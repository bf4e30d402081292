//! Importance sampling of vectors: exact variances by enumeration of every outcome through the public
//! API, with random numbers that are written down.

mod golden;
mod lemmas;
mod midzuno_sen;
mod outcomes;
mod sampling;
mod scripted;
