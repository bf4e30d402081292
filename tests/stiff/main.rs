//! Stiff and extreme cases with known answers: denominators (A), cancellation (C), counts and merges
//! (D), bad draws and zeros (F), and the range rows (B, E) that concern these estimators.
//!
//! The law over all of them: the other channels are bit-identical to a run without the bad one.

mod advice;
mod cancellation;
mod cases;
mod counts;
mod denominators;
mod fitted;
mod range;
mod several;
mod zeros_and_nans;
