//! Prints the lines that the host prints.
#![no_std]
#![no_main]

use ratiocv_firmware::{exit, print};
use ratiocv_platforms::{all, hex};

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    print(b"panic\n");
    exit(false)
}

/// Called by the reset handler.
#[unsafe(no_mangle)]
extern "C" fn program() -> ! {
    all(false, &mut |what, name, bits| {
        for text in [what.as_bytes(), b" ", name.as_bytes(), b" ", &hex(bits), b"\n"] {
            print(text);
        }
    });
    exit(true)
}
