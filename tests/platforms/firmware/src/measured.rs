//! Instructions and stack of a piece of code.

use core::arch::asm;

/// SysTick's current value. It counts down at 25 MHz, and with `-icount shift=0` an instruction takes 1 ns.
const CURRENT: *const u32 = 0xE000_E018 as *const u32;
const INSTRUCTIONS_PER_TICK: u32 = 40;
/// What is written below the stack beforehand, and how far down.
const PATTERN: u32 = 0x5ca1_ab1e;
const WORDS: usize = 16 * 1024;

/// What a piece of code took.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// Instructions, to 40 more or less.
    pub instructions: u32,
    /// Bytes of stack.
    pub stack: u32,
}

/// Runs `work`.
#[inline(never)]
pub fn measured(work: impl FnOnce()) -> Measured {
    let top: usize;
    // SAFETY: reads a register.
    unsafe { asm!("mov {}, sp", out(reg) top) };
    let bottom = (top - 4 * WORDS) as *mut u32;
    // 256 bytes for this function's own calls: they count as stack if they are not used.
    let words = WORDS - 64;
    for i in 0..words {
        // SAFETY: RAM below the stack, which nothing else uses.
        unsafe { bottom.add(i).write_volatile(PATTERN) };
    }
    let before = ticks();
    run(work);
    let after = ticks();
    let mut untouched = 0;
    // SAFETY: as above.
    while untouched < words && unsafe { bottom.add(untouched).read_volatile() } == PATTERN {
        untouched += 1;
    }
    Measured {
        instructions: (before.wrapping_sub(after) & 0x00ff_ffff) * INSTRUCTIONS_PER_TICK,
        stack: 4 * (WORDS - untouched) as u32,
    }
}

#[inline(never)]
fn run(work: impl FnOnce()) {
    work();
}

fn ticks() -> u32 {
    // SAFETY: a register of the system control space.
    unsafe { CURRENT.read_volatile() }
}
