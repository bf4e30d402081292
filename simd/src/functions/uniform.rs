//! Random bits as numbers in [0, 1).

/// ⌊bits/2¹¹⌋·2⁻⁵³, whose conversion from an integer AVX2 lacks: the bits go in two parts into the ends of
/// numbers whose last bits are worth just that, 2³¹ and ½, which are then taken off. All of it is exact.
#[inline(always)]
pub(crate) fn binary64(bits: u64) -> f64 {
    const HIGH: f64 = 2_147_483_648.0;
    const LOW: f64 = 0.5;
    let high = f64::from_bits(bits >> 43 | HIGH.to_bits());
    let low = f64::from_bits(bits >> 11 & 0xffff_ffff | LOW.to_bits());
    (high - (HIGH + LOW)) + low
}

/// ⌊bits/2⁸⌋·2⁻²⁴, exactly.
#[inline(always)]
pub(crate) fn binary32(bits: u32) -> f32 {
    // Signed, because that is what vector instructions convert.
    (bits >> 8) as i32 as f32 * (f32::EPSILON / 2.0)
}
