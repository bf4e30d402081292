//! Draws that break arithmetic which is not quite right.

use ratiocv_core::{Draw, Lanes, Scalar};

/// SplitMix64 (Steele, Lea, Flood 2014) as a hash, in [0, 1).
fn noise(key: u64) -> f64 {
    let mut z = key.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// The number of kinds, and of channels that show them all.
pub(crate) const KINDS: usize = 16;

/// Draw `i` of the channels from `first` on, a kind of number per channel.
#[inline(never)]
pub(crate) fn draw<V: Lanes, const K: usize>(first: usize, i: usize) -> Draw<V, K> {
    let lanes = |number: usize| V::from_fn(|channel| entry(i, first + channel, number));
    Draw { f: lanes(0), h: core::array::from_fn(|k| lanes(k + 1)) }
}

/// Entry `number` of a draw: f, then each h.
#[inline(never)]
fn entry<S: Scalar>(draw: usize, channel: usize, number: usize) -> S {
    let x = noise(((draw as u64) << 20) | ((channel as u64) << 4) | number as u64);
    let ratio = noise(((draw as u64) << 20) | ((channel as u64) << 4) | 1);
    let unit = S::from_f64(0.5 + x);
    let is_f = number == 0;
    match channel % KINDS {
        // Zeros of either sign.
        1 if x < 0.15 => S::ZERO,
        1 if x < 0.3 => -S::ZERO,
        // Squares at the lower end of the range.
        2 => unit * S::from_f64(libm::sqrt(S::min_positive_value().widen())),
        // Very different sizes.
        3 => unit * S::from_f64(libm::exp2(libm::floor(80.0 * x - 40.0))),
        // A constant that is not a binary fraction.
        4 => S::from_f64(0.1),
        // Sums that cancel.
        5 => S::from_f64(x - 0.5),
        // The ends of the range: largest, subnormal.
        6 => unit * S::max_value() * S::from_f64(0.25),
        7 => unit * S::min_positive_value() * S::from_f64(0.001),
        8 if draw == 97 => S::infinity(),
        9 if draw == 130 && is_f => S::nan(),
        // Huge ratios.
        10 if !is_f && draw % 8 == 3 => S::from_f64(1e-30),
        // f = h/3 but for rounding: residuals that cancel to the last bit.
        11 if is_f => S::from_f64(0.5 + ratio) / S::from_f64(3.0),
        // Black.
        12 if is_f => S::ZERO,
        // Small noise on a large number.
        13 => S::from_f64(1e7 + x),
        // No auxiliary at all, or only now and then.
        14 if !is_f && draw % 5 != 4 => S::ZERO,
        // Denominators of either sign.
        15 if !is_f => S::from_f64(x - 0.45),
        _ => unit,
    }
}
