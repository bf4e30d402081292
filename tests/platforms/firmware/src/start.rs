//! The vector table, and what comes before `program`.

core::arch::global_asm!(
    ".section .vectors, \"a\"",
    ".word __stack_top",
    ".word reset",
    ".rept 14",
    ".word fault",
    ".endr",
    ".section .text.reset, \"ax\"",
    ".global reset",
    ".thumb_func",
    "reset:",
    // Access to the floating-point unit: CPACR (ARMv7-M Architecture Reference Manual, B3.2.20).
    "ldr r0, =0xE000ED88",
    "ldr r1, [r0]",
    "orr r1, r1, #0xF00000",
    "str r1, [r0]",
    "dsb",
    "isb",
    // SysTick: all 24 bits, counting at the processor's clock (B3.3).
    "ldr r0, =0xE000E010",
    "ldr r1, =0x00FFFFFF",
    "str r1, [r0, #4]",
    "movs r1, #0",
    "str r1, [r0, #8]",
    "movs r1, #5",
    "str r1, [r0]",
    "bl program",
    ".thumb_func",
    "fault:",
    // SYS_EXIT with a reason that is not an orderly end.
    "movs r0, #0x18",
    "movs r1, #0",
    "bkpt 0xab",
    "b fault",
);
