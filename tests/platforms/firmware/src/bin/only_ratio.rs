//! The ratio of means alone.
#![no_std]
#![no_main]

ratiocv_firmware::only!(ratiocv_core::RatioOfMeans);
