//! Stiff and extreme cases whose right answers are known, run on every lane type beside the textbook formulas.
//!
//! A [`Case`] is draws, what is asked of them and the [`Right`] answer: a value, its digits, an error bar, flags.
//! [`Row::of`] runs it on scalars, arrays and packs of its precision, draw by draw, in one batch and merged in a
//! tree, in the middle of innocent channels whose bits must not change. [`Table`] is the rows as text, JSON or a
//! page.
//!
//! ```
//! use ratiocv_stability::{cases, Contender, Table};
//! let table = Table::of(cases::named("A10"), Contender::Ours);
//! assert_eq!(table.failures().count(), 0);
//! assert!(table.to_string().contains("A10"));
//! ```

mod answer;
mod case;
pub mod cases;
mod draws;
pub mod exact;
mod lane_types;
mod method;
mod naive;
mod noise;
mod page;
mod probe;
mod row;
mod table;

pub use answer::{ErrorBar, Right, digits_of};
pub use case::{Ask, Case, Naive, Precision};
pub use draws::Draws;
pub use method::{Method, Several};
pub use probe::Probes;
pub use row::{Contender, Row};
pub use table::Table;
