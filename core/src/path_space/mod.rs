//! Path space: the ratio over whole paths, where one inside each integral would not be consistent.

mod path_product;
mod scaled_sums;

pub use path_product::PathProduct;
pub use scaled_sums::ScaledSums;
