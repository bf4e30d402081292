//! The fitted difference alone.
#![no_std]
#![no_main]

ratiocv_firmware::only!(ratiocv_core::Difference::default());
