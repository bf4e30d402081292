//! Planted bugs (CONTRIBUTING.md).

pub(crate) use ratiocv_core::planted;
