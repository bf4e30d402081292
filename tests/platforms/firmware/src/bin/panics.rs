//! Does not link, and must not: an index that may be out of range.
#![no_std]
#![no_main]

ratiocv_firmware::only!({
    let at: usize = core::hint::black_box(3);
    core::hint::black_box([0_u8; 4][at]);
    ratiocv_core::Plain
});
