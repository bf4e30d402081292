//! The lines of `ratiocv_platforms`, handed to the page that hosts this module.
#![no_std]

use ratiocv_platforms::{all, hex, packs};

#[link(wasm_import_module = "host")]
unsafe extern "C" {
    /// Takes `length` bytes of text.
    fn print(text: *const u8, length: usize);
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

fn line(what: &str, name: &str, bits: u64) {
    for text in [what.as_bytes(), b" ", name.as_bytes(), b" ", &hex(bits), b"\n"] {
        // SAFETY: the host reads `text` and keeps nothing.
        unsafe { print(text.as_ptr(), text.len()) };
    }
}

/// Prints the lines of arrays.
#[unsafe(no_mangle)]
extern "C" fn arrays() {
    all(false, &mut line);
}

/// Prints the lines of packs.
#[unsafe(no_mangle)]
extern "C" fn with_packs() {
    packs(&mut line);
}
