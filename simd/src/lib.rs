//! Channels, pixels or samples side by side: SIMD lanes for `ratiocv-core`.
#![no_std]
