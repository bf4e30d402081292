//! Numbers that break arithmetic which is not quite right.

use num_traits::float::FloatCore;
use ratiocv_core::{Draw, Lanes, Scalar};

/// A scalar as its bits, in the low end.
pub(crate) trait Bits: Scalar {
    /// A NaN that is not the usual one: quiet, negative, with a payload.
    const NAN_WITH_PAYLOAD: Self;
    fn bits(self) -> u64;
}

impl Bits for f32 {
    const NAN_WITH_PAYLOAD: Self = Self::from_bits(0xffc1_2345);
    fn bits(self) -> u64 {
        u64::from(self.to_bits())
    }
}

impl Bits for f64 {
    const NAN_WITH_PAYLOAD: Self = Self::from_bits(0xfff8_1234_5678_9abc);
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// The edges of the range, numbers beside each other, zeros of either sign, and what is no number.
pub(crate) fn numbers<S: Bits>() -> Vec<S> {
    let (tiny, huge, epsilon): (S, S, S) = (S::min_positive_value(), S::max_value(), FloatCore::epsilon());
    let one = S::ONE;
    let positive = [
        S::ZERO,
        one,
        one + epsilon,
        one - epsilon / S::from_f64(2.0),
        S::from_f64(1.0 / 3.0),
        S::from_f64(0.1),
        S::from_f64(1e7),
        S::from_f64(16_777_217.0),
        tiny,
        tiny * (one - epsilon),
        tiny * epsilon,
        tiny / epsilon,
        huge,
        huge * epsilon,
        S::infinity(),
        S::NAN_WITH_PAYLOAD,
    ];
    positive.into_iter().chain(positive.map(|x| -x)).chain([S::nan()]).collect()
}

/// SplitMix64 (Steele, Lea, Flood 2014) as a hash, in [0, 1).
fn noise(key: u64) -> f64 {
    let mut z = key.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// Entry `number` of draw `draw` in channel `channel`: f, then each h. Channels differ in kind: ordinary, with
/// zeros of either sign, at the lower edge of what can be squared, of very different sizes, constant, of both
/// signs, at the upper and at the lower end of the range, with an infinity, with a NaN.
fn entry<S: Bits>(draw: usize, channel: usize, number: usize) -> S {
    let noise = |number: usize| noise(((draw as u64) << 20) | ((channel as u64) << 4) | number as u64);
    let x = noise(number);
    let unit = S::from_f64(0.5 + x);
    // No h is 0 unless f is: their ratio would be infinite.
    let is_zero = noise(0) < if number == 0 { 0.4 } else { 0.2 };
    match channel % 11 {
        1 if is_zero => {
            if x.to_bits() & 4096 == 0 {
                S::ZERO
            } else {
                -S::ZERO
            }
        }
        2 => unit * root_of_tiny(),
        3 => unit * S::from_f64(libm::exp2(libm::floor(80.0 * x - 40.0))),
        4 => S::from_f64(0.1),
        5 => S::from_f64(x - 0.5),
        6 => unit * S::max_value() * S::from_f64(0.25),
        7 => unit * S::min_positive_value() * S::from_f64(0.001),
        8 if draw == 97 => S::infinity(),
        9 if draw == 130 => S::NAN_WITH_PAYLOAD,
        _ => unit,
    }
}

/// About the root of the smallest number: its squares are the first to underflow.
fn root_of_tiny<S: Bits>() -> S {
    S::from_f64(libm::sqrt(Lanes::widen(S::min_positive_value())))
}

/// `count` draws of the channels from `first` on.
pub(crate) fn draws<V: Lanes<Scalar: Bits>, const K: usize>(first: usize, count: usize) -> Vec<Draw<V, K>> {
    let lanes = |draw, number| V::from_fn(|i| entry(draw, first + i, number));
    (0..count).map(|i| Draw { f: lanes(i, 0), h: core::array::from_fn(|k| lanes(i, k + 1)) }).collect()
}
