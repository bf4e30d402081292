//! Quenouille's estimator alone.
#![no_std]
#![no_main]

ratiocv_firmware::only!(ratiocv_core::Quenouille);
