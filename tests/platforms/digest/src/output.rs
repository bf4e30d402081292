//! Lines without `core::fmt`.

/// Sixteen digits.
pub fn hex(bits: u64) -> [u8; 16] {
    let mut digits = [0; 16];
    for (i, digit) in digits.iter_mut().rev().enumerate() {
        let four = (bits >> (4 * i)) as u8 & 15;
        *digit = if four < 10 { b'0' + four } else { b'a' + four - 10 };
    }
    digits
}
