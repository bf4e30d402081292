//! The cross-fitted choice alone.
#![no_std]
#![no_main]

ratiocv_firmware::only!(ratiocv_core::CrossFitted(ratiocv_core::Choose::default()));
