//! Semihosting: printing and ending, by calls that QEMU answers.

use core::arch::asm;

const SYS_WRITEC: usize = 0x03;
const SYS_EXIT: usize = 0x18;
const APPLICATION_EXIT: usize = 0x20026;

fn call(operation: usize, argument: usize) {
    // SAFETY: the semihosting ABI: r0 and r1 in, r0 out; QEMU reads memory and writes none.
    unsafe { asm!("bkpt 0xab", inout("r0") operation => _, in("r1") argument) }
}

/// Prints `text` on the debugger's console.
pub fn print(text: &[u8]) {
    for byte in text {
        call(SYS_WRITEC, core::ptr::from_ref(byte).addr());
    }
}

/// Prints `number` in decimals.
pub fn print_number(mut number: u32) {
    let mut digits = [b'0'; 10];
    let mut first = 9;
    for (i, digit) in digits.iter_mut().enumerate().rev() {
        *digit = b'0' + (number % 10) as u8;
        number /= 10;
        first = i;
        if number == 0 {
            break;
        }
    }
    print(digits.get(first..).unwrap_or(&[]));
}

/// Ends the emulation; `well`, or with an error.
pub fn exit(well: bool) -> ! {
    call(SYS_EXIT, if well { APPLICATION_EXIT } else { 0 });
    loop {}
}
