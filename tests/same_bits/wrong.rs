//! Lanes that are wrong on purpose: the comparisons must see it.

use crate::moments::{self, ComomentsOfOne, RawRatios, SumsOfOne, ThirdMoments};
use crate::operations;
use core::ops::{Add, Div, Mul, Neg, Sub};
use ratiocv_core::{Lanes, Single, Spectrum};

/// Four `f32` that are right but for one bug.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Four<const BUG: usize>([f32; 4]);

const NONE: usize = 0;
const SELECT_SWAPPED: usize = 1;
const SELECT_BY_ARITHMETIC: usize = 2;
const LESS_OR_EQUAL: usize = 3;
const EQUAL_BITS: usize = 4;
const RECIPROCAL: usize = 5;
const FLUSHED: usize = 6;
const LANES_MIXED: usize = 7;
const NEGATED_FROM_ZERO: usize = 8;
const NARROWED_UPWARDS: usize = 9;
const MASKED_BY_ARITHMETIC: usize = 10;

impl<const BUG: usize> Four<BUG> {
    fn zip(self, other: Self, combine: impl Fn(f32, f32) -> f32) -> Self {
        Self(core::array::from_fn(|i| combine(self.0[i], other.0[i])))
    }
}

impl<const BUG: usize> Add for Four<BUG> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let mut sum = self.zip(other, |a, b| a + b);
        if BUG == LANES_MIXED {
            sum.0.swap(2, 3);
        }
        sum
    }
}

impl<const BUG: usize> Sub for Four<BUG> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const BUG: usize> Mul for Four<BUG> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.zip(other, |a, b| a * b);
        if BUG == FLUSHED { Self(product.0.map(|x| if x.is_subnormal() { 0.0 } else { x })) } else { product }
    }
}

impl<const BUG: usize> Div for Four<BUG> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| if BUG == RECIPROCAL { a * (1.0 / b) } else { a / b })
    }
}

impl<const BUG: usize> Neg for Four<BUG> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|x| if BUG == NEGATED_FROM_ZERO { 0.0 - x } else { -x }))
    }
}

impl<const BUG: usize> Lanes for Four<BUG> {
    type Scalar = f32;
    type Wide = Spectrum<f64, 4>;
    type Pack = Self;
    type Mask = [bool; 4];
    type PerLane<T: Copy + core::fmt::Debug> = [Single<T>; 4];
    const LANES: usize = 4;
    const PACKS: usize = 1;
    const ZERO: Self = Self([0.0; 4]);
    const ONE: Self = Self([1.0; 4]);

    fn splat(x: f32) -> Self {
        Self([x; 4])
    }
    fn from_fn(lane: impl FnMut(usize) -> f32) -> Self {
        Self(core::array::from_fn(lane))
    }
    fn get(&self, lane: usize) -> f32 {
        self.0[lane]
    }
    fn pack(&self, _: usize) -> Self {
        *self
    }
    fn set_pack(&mut self, _: usize, lanes: Self) {
        *self = lanes;
    }
    fn widen(self) -> Self::Wide {
        Spectrum(self.0.map(f64::from))
    }
    fn narrow(wide: Self::Wide) -> Self {
        let round = |x: f64| if BUG == NARROWED_UPWARDS { (x * (1.0 + 1e-8)) as f32 } else { x as f32 };
        Self(wide.0.map(round))
    }
    fn lt(self, other: Self) -> [bool; 4] {
        core::array::from_fn(|i| if BUG == LESS_OR_EQUAL { self.0[i] <= other.0[i] } else { self.0[i] < other.0[i] })
    }
    fn equal(self, other: Self) -> [bool; 4] {
        core::array::from_fn(|i| {
            let (a, b) = (self.0[i], other.0[i]);
            if BUG == EQUAL_BITS { a.to_bits() == b.to_bits() } else { a == b }
        })
    }
    fn select(mask: [bool; 4], yes: Self, no: Self) -> Self {
        Self(core::array::from_fn(|i| {
            let (yes, no) = (yes.0[i], no.0[i]);
            match BUG {
                SELECT_SWAPPED if i == 3 => {
                    if mask[i] {
                        no
                    } else {
                        yes
                    }
                }
                SELECT_BY_ARITHMETIC => {
                    let share = if mask[i] { 1.0 } else { 0.0 };
                    share * yes + (1.0 - share) * no
                }
                _ => {
                    if mask[i] {
                        yes
                    } else {
                        no
                    }
                }
            }
        }))
    }
    fn only(self, mask: [bool; 4]) -> Self {
        if BUG == MASKED_BY_ARITHMETIC {
            Self(core::array::from_fn(|i| self.0[i] * if mask[i] { 1.0 } else { 0.0 }))
        } else {
            Self::select(mask, self, Self::ZERO)
        }
    }
}

#[test]
fn right_lanes_pass() {
    assert_eq!(operations::compare::<Four<NONE>>(), Ok(()));
    assert_eq!(moments::compare::<ComomentsOfOne, Four<NONE>>(), Ok(()));
}

#[test]
fn no_wrong_operation_passes() {
    macro_rules! caught {
        ($($bug:ident)*) => {$(
            let found = operations::compare::<Four<$bug>>();
            println!("{}: {found:?}", stringify!($bug));
            assert!(found.is_err(), "{}", stringify!($bug));
        )*};
    }
    caught!(SELECT_SWAPPED SELECT_BY_ARITHMETIC LESS_OR_EQUAL EQUAL_BITS RECIPROCAL FLUSHED LANES_MIXED);
    caught!(NEGATED_FROM_ZERO NARROWED_UPWARDS MASKED_BY_ARITHMETIC);
}

#[test]
fn accumulators_show_wrong_lanes_too() {
    assert!(moments::compare::<SumsOfOne, Four<LANES_MIXED>>().is_err());
    assert!(moments::compare::<RawRatios, Four<SELECT_SWAPPED>>().is_err());
    assert!(moments::compare::<RawRatios, Four<SELECT_BY_ARITHMETIC>>().is_err());
    assert!(moments::compare::<ThirdMoments, Four<FLUSHED>>().is_err());
    assert!(moments::compare::<RawRatios, Four<RECIPROCAL>>().is_err());
    assert!(moments::compare::<RawRatios, Four<EQUAL_BITS>>().is_err());
}
