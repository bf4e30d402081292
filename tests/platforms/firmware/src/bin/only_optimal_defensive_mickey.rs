//! Mickey's estimator on the best defensive weight alone.
#![no_std]
#![no_main]

ratiocv_firmware::only!(ratiocv_core::OptimalDefensive::of(ratiocv_core::Mickey));
