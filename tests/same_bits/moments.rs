//! Every accumulator, however it is called.

use crate::hostile::{Bits, draws};
use core::fmt::Debug;
use ratiocv_core::moments::{
    Accumulate, BLOCK, Blocked, Comoments, ComomentsBlock, Extremes, ExtremesBlock, Folds, FoldsBlock, GroupedPairs,
    Groups, GroupsBlock, Joined, Mean, Merge, Moments, Pairs, RatioMean, RatioOf, RatioVariance, Sums, Third,
    ThirdBlock, UnivariateBlock, Variance, Widened,
};
use ratiocv_core::{Draw, Integrals, Lanes, Spectrum};
use ratiocv_simd::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};
use ratiocv_tests::alone::Alone;

/// Draws of a test: more runs than make a block, and some draws more.
const DRAWS: usize = 18 * BLOCK + 37;

/// An accumulator for lanes of any type.
pub(crate) trait Recipe {
    type Draw<V: Lanes>: Copy;
    type Moments<V: Lanes>: Accumulate<Self::Draw<V>> + Merge + Moments<Channel: Debug> + Clone;
    fn draws<V: Lanes<Scalar: Bits>>(first: usize, count: usize) -> Vec<Self::Draw<V>>;
    fn empty<V: Lanes>(integrals: &Integrals<V>) -> Self::Moments<V>;
}

macro_rules! recipes {
    ($($name:ident<$k:literal>: $moments:ty $(= $make:expr)?;)*) => {$(
        pub(crate) struct $name;
        impl Recipe for $name {
            type Draw<V: Lanes> = Draw<V, $k>;
            type Moments<V: Lanes> = $moments;
            fn draws<V: Lanes<Scalar: Bits>>(first: usize, count: usize) -> Vec<Draw<V, $k>> {
                draws(first, count)
            }
            fn empty<V: Lanes>(integrals: &Integrals<V>) -> $moments {
                recipes!(integrals $(, $make)?)
            }
        }
    )*};
    ($integrals:ident) => {{ let _ = $integrals; Default::default() }};
    ($integrals:ident, $make:expr) => { $make($integrals).unwrap() };
}

recipes! {
    SumsOfNone<0>: Sums<V, 0>;
    SumsOfOne<1>: Sums<V, 1>;
    SumsOfTwo<2>: Sums<V, 2>;
    ComomentsOfNone<0>: Comoments<V, 0>;
    ComomentsOfOne<1>: Comoments<V, 1>;
    ComomentsOfTwo<2>: Comoments<V, 2>;
    MeanOnly<1>: Mean<V>;
    VarianceOnly<1>: Variance<V>;
    RawRatioMean<1>: RatioMean<V>;
    RawRatios<1>: RatioVariance<V>;
    DefensiveRatios<1>: RatioVariance<V> = |integrals| RatioVariance::defensive(0.01, integrals);
    TwoGroups<1>: Groups<V, 2>;
    EightGroups<2>: Groups<V, 8, 2>;
    TwoFolds<2>: Folds<V, ComomentsBlock<V, 2>>;
    ThirdMoments<1>: Third<V>;
    Tails<1>: Extremes<V>;
    InDouble<1>: Widened<V, Comoments<V::Wide>>;
}

/// Two pairs for each draw.
pub(crate) struct TwoPairs;

impl Recipe for TwoPairs {
    type Draw<V: Lanes> = Pairs<V, 2>;
    type Moments<V: Lanes> = GroupedPairs<V, 2, 8>;
    fn draws<V: Lanes<Scalar: Bits>>(first: usize, count: usize) -> Vec<Pairs<V, 2>> {
        let weighted = |draw: &Draw<V, 2>| Pairs::weighted(*draw, [draw.h[1], V::ONE - draw.h[1]]);
        draws(first, count).iter().map(weighted).collect()
    }
    fn empty<V: Lanes>(_: &Integrals<V>) -> Self::Moments<V> {
        GroupedPairs::default()
    }
}

/// All that estimators read, in one pass.
pub(crate) struct Everything;

type EverythingBlock<V> = Joined<
    ComomentsBlock<V>,
    [UnivariateBlock<RatioOf<V>, 1>; 2],
    GroupsBlock<V, 8>,
    ExtremesBlock<V>,
    ThirdBlock<V>,
    FoldsBlock<ComomentsBlock<V>>,
>;

impl Recipe for Everything {
    type Draw<V: Lanes> = Draw<V>;
    type Moments<V: Lanes> = Blocked<V, EverythingBlock<V>>;
    fn draws<V: Lanes<Scalar: Bits>>(first: usize, count: usize) -> Vec<Draw<V>> {
        draws(first, count)
    }
    fn empty<V: Lanes>(integrals: &Integrals<V>) -> Self::Moments<V> {
        let defended = RatioVariance::defensive(0.01, integrals).unwrap();
        Blocked::with_ratios(Blocked::both(RatioVariance::default(), defended))
    }
}

#[inline(never)]
fn one_by_one<D: Copy, M: Accumulate<D>>(mut moments: M, draws: &[D]) -> M {
    for draw in draws {
        moments.add(*draw);
    }
    moments
}

#[inline(never)]
fn at_once<D: Copy, M: Accumulate<D>>(mut moments: M, draws: &[D]) -> M {
    moments.add_batch(draws);
    moments
}

/// The draws in other and other calls.
fn called<D: Copy, M: Accumulate<D> + Merge + Clone>(empty: &M, draws: &[D]) -> Vec<M> {
    let mut pieces = empty.clone();
    let mut rest = draws;
    for size in [1, 3, BLOCK, 2, BLOCK + 1, 0, 2 * BLOCK + 5].into_iter().cycle() {
        let (piece, after) = rest.split_at(size.min(rest.len()));
        pieces = at_once(pieces, piece);
        rest = after;
        if rest.is_empty() {
            break;
        }
    }
    let (first, middle, last) = (&draws[..5], &draws[5..draws.len() - 70], &draws[draws.len() - 70..]);
    let mixed = one_by_one(at_once(one_by_one(empty.clone(), first), middle), last);
    let merged = |sizes: &[usize]| {
        let (mut whole, mut rest) = (empty.clone(), draws);
        for (i, size) in sizes.iter().enumerate() {
            let (part, after) = rest.split_at(*size);
            let part = if i % 2 == 0 { at_once(empty.clone(), part) } else { one_by_one(empty.clone(), part) };
            whole.merge(&part);
            rest = after;
        }
        whole
    };
    vec![
        one_by_one(empty.clone(), draws),
        at_once(empty.clone(), draws),
        pieces,
        mixed,
        merged(&[0, 1, 2, BLOCK + 7, 0, draws.len() - BLOCK - 10]),
        merged(&[2 * BLOCK, BLOCK, 3]),
    ]
}

/// The moments of `channels` channels from `first` on after all those calls,
/// in words, in which numbers are the shortest that read back as the same bits (of NaNs, only that they are NaN).
fn in_words<R: Recipe, V: Lanes<Scalar: Bits>>(first: usize, channels: usize) -> Vec<String> {
    let integrals = Integrals::new([V::Wide::from_fn(|i| 0.75 + 0.01 * (first + i) as f64)]);
    let draws = R::draws::<V>(first, DRAWS);
    let mut words = vec![String::new(); channels];
    for moments in called(&R::empty::<V>(&integrals), &draws) {
        let closed = moments.closed();
        for (channel, words) in words.iter_mut().enumerate() {
            *words += &format!("{} draws: {:?}\n", moments.count(), closed.channel(channel));
        }
    }
    words
}

/// Holds each channel of an accumulator of `V` against that channel alone.
///
/// # Errors
/// The first channel that differs.
pub(crate) fn compare<R: Recipe, V: Lanes<Scalar: Bits>>() -> Result<(), String> {
    let together = in_words::<R, V>(0, V::LANES);
    for (channel, ours) in together.iter().enumerate() {
        // The order of summation is that of P = 8/gcd(M, 8) partial sums, for M channels.
        let alone = if const { V::LANES % 8 == 0 } {
            in_words::<R, Alone<V::Scalar, 8>>(channel, 1)
        } else if const { V::LANES % 4 == 0 } {
            in_words::<R, Alone<V::Scalar, 4>>(channel, 1)
        } else if const { V::LANES % 2 == 0 } {
            in_words::<R, Alone<V::Scalar, 2>>(channel, 1)
        } else {
            in_words::<R, Alone<V::Scalar, 1>>(channel, 1)
        };
        if *ours != alone[0] {
            return Err(format!("channel {channel} of {}:\n{ours}\nand alone:\n{}", V::LANES, alone[0]));
        }
    }
    Ok(())
}

/// Every accumulator of a list on every lane type of another.
macro_rules! same_bits {
    ($($name:ident: $recipes:tt on $($lanes:ty),*;)*) => {$(
        #[test]
        fn $name() {
            $(same_bits!(@ $recipes $lanes);)*
        }
    )*};
    (@ [$($recipe:ident)*] $lanes:ty) => {$(
        assert_eq!(compare::<$recipe, $lanes>(), Ok(()), "{} of {}", stringify!($recipe), stringify!($lanes));
    )*};
}

same_bits! {
    every_accumulator_of_single_packs: [
        SumsOfNone SumsOfTwo ComomentsOfNone ComomentsOfOne ComomentsOfTwo MeanOnly VarianceOnly RawRatioMean RawRatios
        DefensiveRatios TwoGroups EightGroups TwoFolds ThirdMoments Tails InDouble TwoPairs
    ] on F32x8;
    // Everything holds the kernels of the others.
    everything_on_packs: [Everything] on F32x4, F32x8, F32x16, F64x2, F64x4, F64x8;
    everything_on_arrays: [Everything] on Spectrum<f32, 3>;
    two_auxiliaries: [ComomentsOfTwo] on F64x4, Spectrum<f32, 3>;
    packs_side_by_side: [ComomentsOfOne] on Spectrum<F32x4, 2>, Spectrum<F32x8, 3>, Spectrum<Spectrum<f32, 8>, 3>;
    some_widths: [ComomentsOfOne] on f32, f64, Spectrum<f32, 2>, Spectrum<f32, 12>, Spectrum<f32, 16>;
    no_channel_at_all: [ComomentsOfOne] on Spectrum<f32, 0>, Spectrum<F32x8, 0>, Spectrum<Spectrum<f64, 0>, 2>;
}

/// Means on every number of packs of a list.
macro_rules! every_width {
    ($($name:ident: $lanes:ty, $($k:literal)*;)*) => {$(
        #[test]
        fn $name() {
            $(assert_eq!(compare::<MeanOnly, Spectrum<$lanes, $k>>(), Ok(()), "{}", $k);)*
        }
    )*};
}

every_width! {
    every_number_of_f32:
        f32, 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32 33 34 35 36 37 38
        39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63 64 65 66 67 68 69 70;
    every_number_of_f64:
        f64, 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32 33 34 35 36 37 38
        39 40 41 42 43 44 45 46 47 48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63 64 65 66 67 68 69 70;
    numbers_of_f32x4: F32x4, 1 2 3 4 5 7 8 12 17;
    numbers_of_f32x8: F32x8, 1 2 3 5 8;
    numbers_of_f32x16: F32x16, 1 2 3 4;
    numbers_of_f64x2: F64x2, 1 2 3 8 35;
    numbers_of_f64x4: F64x4, 1 2 3 17;
    numbers_of_f64x8: F64x8, 1 3 8;
}
