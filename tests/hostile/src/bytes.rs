//! Bytes as numbers that break arithmetic which is not quite right.

use num_traits::float::FloatCore;
use ratiocv_core::{Draw, Lanes, Scalar};

/// How far numbers may go.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(crate) enum Reach {
    /// 0, and sizes from 2⁻²⁰ to 2²⁴.
    Moderate,
    /// Any number.
    Finite,
    /// Infinities and NaN as well.
    Any,
}

/// Bytes that are still to be read; zeros follow the last one.
#[derive(Debug)]
pub(crate) struct Bytes<'a> {
    rest: &'a [u8],
    before: [f64; 4],
    written: usize,
}

impl<'a> Bytes<'a> {
    pub(crate) const fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, before: [1.0, 0.5, -2.0, 3.0], written: 0 }
    }

    pub(crate) fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.rest.split_first() else { return 0 };
        self.rest = rest;
        *first
    }

    pub(crate) fn below(&mut self, limit: usize) -> usize {
        usize::from(self.byte()) % limit
    }

    /// A number of `S`: by the first byte's upper half a zero, a tie with one of the four before or its neighbour, a
    /// small whole number, a power of two, an edge of the range, or the next bytes as they are.
    pub(crate) fn number<S: Scalar>(&mut self, reach: Reach) -> f64 {
        let byte = self.byte();
        let (kind, low) = (byte >> 4, f64::from(byte & 15));
        let before = self.before[usize::from(byte & 3)];
        let x = match kind {
            0 if byte & 1 == 0 => 0.0,
            0 => -0.0,
            1 => 1.0,
            2 => before,
            3 => before + before * Lanes::widen(<S as FloatCore>::epsilon()) * (low - 7.5),
            4 => low + 1.0,
            5 => -low - 1.0,
            6 => (low + 1.0) / 8.0,
            7 => 0.5 + f64::from(self.byte()) / 256.0,
            8 | 9 => {
                let exponent = i32::from(self.byte() as i8);
                let exponent = if reach == Reach::Moderate { exponent % 20 } else { exponent * 9 };
                libm::ldexp(if kind == 8 { 1.0 + low / 16.0 } else { -1.0 - low / 16.0 }, exponent)
            }
            10 => 1e7 + low,
            11 => [0.1, 1.0 / 3.0, -0.7, 2.0 / 3.0][usize::from(byte & 3)],
            12 => -before,
            13 => before / 3.0,
            14 if reach > Reach::Moderate => edges::<S>()[usize::from(byte & 15)],
            15 if reach == Reach::Any && low < 3.0 => [f64::INFINITY, f64::NEG_INFINITY, f64::NAN][byte as usize & 15],
            15 if reach > Reach::Moderate => f64::from_bits(u64::from_le_bytes(core::array::from_fn(|_| self.byte()))),
            _ => f64::from(i16::from_le_bytes([self.byte(), self.byte()])) / 64.0,
        };
        let (x, most) = (Lanes::widen(S::from_f64(x)), Lanes::widen(<S as FloatCore>::max_value()));
        let x = match reach {
            Reach::Any => x,
            Reach::Finite if x.is_finite() => x,
            Reach::Finite => most,
            Reach::Moderate if x == 0.0 || (1e-6..2e7).contains(&x.abs()) => x,
            Reach::Moderate => 1.0,
        };
        self.before[self.written % 4] = x;
        self.written += 1;
        x
    }

    /// `N` numbers for each of at least one point and at most `most`; the first byte says whether they come once or
    /// again and again, with the last one left out or not.
    pub(crate) fn points<S: Scalar, const N: usize>(&mut self, reach: Reach, most: usize) -> Vec<[f64; N]> {
        let rounds = self.byte();
        let mut points = vec![core::array::from_fn(|_| self.number::<S>(reach))];
        while !self.rest.is_empty() && points.len() < most {
            points.push(core::array::from_fn(|_| self.number::<S>(reach)));
        }
        if rounds >= 128 {
            let count = (usize::from(rounds - 127) * points.len()).min(most);
            points = points.iter().copied().cycle().take(count).collect();
        }
        points
    }
}

/// Draws of points (f, h, …), channel `c` of draw `i` point i + 7c.
pub(crate) fn draws<V: Lanes, const K: usize, const N: usize>(points: &[[f64; N]]) -> Vec<Draw<V, K>> {
    let entry =
        |i: usize, channel: usize, number: usize| V::Scalar::from_f64(points[(i + 7 * channel) % points.len()][number]);
    let lanes = |i: usize, number: usize| V::from_fn(|channel| entry(i, channel, number));
    (0..points.len()).map(|i| Draw { f: lanes(i, 0), h: core::array::from_fn(|k| lanes(i, k + 1)) }).collect()
}

/// The ends of the range of `S`, and where squares and products leave it.
fn edges<S: Scalar>() -> [f64; 16] {
    let tiny = Lanes::widen(<S as FloatCore>::min_positive_value());
    let (huge, epsilon) = (Lanes::widen(<S as FloatCore>::max_value()), Lanes::widen(<S as FloatCore>::epsilon()));
    let (low, high) = (libm::sqrt(tiny), libm::sqrt(huge));
    [
        tiny,
        tiny * epsilon,
        tiny * (1.0 - epsilon),
        tiny / epsilon,
        huge,
        -huge,
        huge / 4.0,
        huge * epsilon,
        low,
        -low,
        low / 3.0,
        high,
        high * 3.0,
        1.0 + epsilon,
        1.0 - epsilon / 2.0,
        -tiny,
    ]
}
