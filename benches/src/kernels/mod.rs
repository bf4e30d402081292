//! The contenders.

pub(crate) mod average;
#[cfg(target_arch = "x86_64")]
pub(crate) mod by_hand;
pub(crate) mod naive;
pub(crate) mod ndarray_stats;
pub(crate) mod ours;
pub(crate) mod statrs;
