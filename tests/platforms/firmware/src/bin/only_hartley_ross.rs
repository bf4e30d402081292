//! Hartley–Ross alone.
#![no_std]
#![no_main]

ratiocv_firmware::only!(ratiocv_core::HartleyRoss);
