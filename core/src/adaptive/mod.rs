//! A proposal that learns where the integrand is: grids in the spirit of VEGAS (Lepage 1978), one
//! component per channel or per group of channels.
//!
//! A component is a product of one-dimensional densities, constant on the bins of each dimension;
//! all components share the bins, and draws come from their mixture. So a draw knows every
//! component's density without a search, and their ratios to the mixture's are auxiliaries whose
//! integral is 1.

mod alias;
mod axis;
mod grid;
mod point;
mod train;

pub use grid::Grid;
pub use point::{AtPosition, ComponentDensities, GridPoint};
