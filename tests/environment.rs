//! Settings of the processor that spoil results are noticed.

use ratiocv_core::{FpEnvironment, fp_environment};

#[test]
fn this_thread_is_sound() {
    assert!(fp_environment().is_sound(), "{:?}", fp_environment());
}

/// The control word of SSE, on a thread of its own, set back before anything else is calculated.
#[cfg(target_arch = "x86_64")]
#[test]
fn flushing_and_rounding_are_noticed() {
    fn with(bits: u32) -> FpEnvironment {
        std::thread::spawn(move || {
            let (mut before, mut changed) = (0_u32, 0_u32);
            // SAFETY: the control word is read, changed in documented bits, and set back.
            unsafe {
                core::arch::asm!("stmxcsr [{}]", in(reg) &raw mut before);
                changed |= before | bits;
                core::arch::asm!("ldmxcsr [{}]", in(reg) &raw const changed);
            }
            let environment = fp_environment();
            // SAFETY: as above.
            unsafe { core::arch::asm!("ldmxcsr [{}]", in(reg) &raw const before) };
            environment
        })
        .join()
        .expect("an environment")
    }
    const DENORMALS_ARE_ZERO: u32 = 1 << 6;
    const FLUSH_TO_ZERO: u32 = 1 << 15;
    assert!(with(0).is_sound());
    for bits in [FLUSH_TO_ZERO, DENORMALS_ARE_ZERO, FLUSH_TO_ZERO | DENORMALS_ARE_ZERO] {
        assert_eq!(with(bits), FpEnvironment { keeps_denormals: false, rounds_to_nearest: true }, "{bits:x}");
    }
    for mode in 1..4 {
        assert_eq!(with(mode << 13), FpEnvironment { keeps_denormals: true, rounds_to_nearest: false }, "{mode}");
    }
}
