//! Error against run time, for problems whose integrals are known exactly.

pub mod catalogue;
