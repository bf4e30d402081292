//! Time in cycles: a loop whose latency is known.

use core::hint::black_box;

/// Cycles of one [`pass`].
pub const CYCLES: f64 = 3.0 * 256.0;

/// 256 multiplications of integers that wait for each other, 3 cycles each on x86-64 of Intel since 2006
/// (Nehalem) and of AMD since 2017 (Zen) (Fog, *Instruction tables*). `false` on other machines, where
/// nothing runs and cycles are unknown.
#[inline(never)]
pub fn pass() -> bool {
    #[cfg(target_arch = "x86_64")]
    {
        let mut x: u64 = black_box(3);
        // SAFETY: registers only.
        unsafe {
            std::arch::asm!(".rept 256", "imul {x}, {x}", ".endr", x = inout(reg) x, options(pure, nomem, nostack));
        }
        black_box(x);
    }
    cfg!(target_arch = "x86_64")
}
