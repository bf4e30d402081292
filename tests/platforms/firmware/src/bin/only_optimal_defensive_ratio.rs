//! The optimal defensive ratio alone.
#![no_std]
#![no_main]

ratiocv_firmware::only!(<ratiocv_core::OptimalDefensive>::default());
