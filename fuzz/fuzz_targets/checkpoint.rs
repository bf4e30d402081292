#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| ratiocv_hostile_readers::checkpoint(bytes));
