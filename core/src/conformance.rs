//! The laws of [`Accumulate`], [`Merge`] and [`Moments`] as public functions, to be run on every
//! implementor: here, by the fuzz targets, and by users on accumulators and lanes of their own.
//!
//! Each law reads an accumulator through an estimator, and returns which part of it is broken.
//!
//! ```
//! use ratiocv_core::{conformance, moments::Comoments, Draw, Integrals, Tin};
//! let draws: Vec<_> = (0..100).map(|i| Draw::new(f64::from(i % 7), 1.0 + f64::from(i % 5))).collect();
//! conformance::all(&Tin, |_| Comoments::<f64>::default(), &draws, &Integrals::new([3.0]), 1e-12)?;
//! # Ok::<(), &'static str>(())
//! ```

use crate::draw::Draw;
use crate::estimate::Estimate;
use crate::estimator::Estimator;
use crate::flags::Flags;
use crate::integrals::Integrals;
use crate::lanes::{Lanes, Scalar};
use crate::moments::{Accumulate, Merge, Moments, Pairs, Save};

/// A broken law.
pub type Law = Result<(), &'static str>;

/// What is drawn, as the laws spoil and scale it.
///
/// *Implemented by* [`Draw`] and [`Pairs`]; *called by* the laws.
pub trait Sampled: Copy {
    /// The lanes of its entries.
    type Lanes: Lanes;
    /// The same with `f` of each integrand and `h` of each auxiliary.
    #[must_use]
    fn changed(self, f: impl FnMut(Self::Lanes) -> Self::Lanes, h: impl FnMut(Self::Lanes) -> Self::Lanes) -> Self;
}

impl<V: Lanes, const K: usize> Sampled for Draw<V, K> {
    type Lanes = V;
    fn changed(self, mut f: impl FnMut(V) -> V, h: impl FnMut(V) -> V) -> Self {
        Self { f: f(self.f), h: self.h.map(h) }
    }
}

impl<V: Lanes, const K: usize> Sampled for Pairs<V, K> {
    type Lanes = V;
    fn changed(self, mut f: impl FnMut(V) -> V, mut h: impl FnMut(V) -> V) -> Self {
        Self(self.0.map(|pair| pair.changed(&mut f, &mut h)))
    }
}

/// An accumulator of draws that estimators can read.
pub trait Accumulator<D: Sampled>: Accumulate<D> + Merge + Moments<Lanes = D::Lanes> + Save + Clone {}

impl<D: Sampled, M: Accumulate<D> + Merge + Moments<Lanes = D::Lanes> + Save + Clone> Accumulator<D> for M {}

/// Every law on `draws`, whose estimates may move by `tolerance` (relative) with the way that they
/// are split.
///
/// # Errors
/// The first law that does not hold.
pub fn all<D: Sampled, M: Accumulator<D>, E: Estimator<M::Channel, K>, const K: usize>(
    estimator: &E,
    empty: impl Fn(&Integrals<D::Lanes, K>) -> M,
    draws: &[D],
    integrals: &Integrals<D::Lanes, K>,
    tolerance: f64,
) -> Law {
    same_calls_same_bits(estimator, &empty, draws, integrals)?;
    empty_is_identity(estimator, &empty, draws, integrals)?;
    let at = draws.len() / 3;
    whole_is_split(estimator, &empty, draws, at, integrals, tolerance)?;
    bad_channel_is_alone(estimator, &empty, draws, D::Lanes::LANES / 2, integrals)?;
    saved_goes_on_the_same(estimator, &empty, draws, at, integrals)?;
    scales_exactly(estimator, &empty, draws, integrals)
}

/// `draws`, added one by one. Not inlined: the laws call it in many places, and accumulators are large
/// when inlined.
#[inline(never)]
fn one_by_one<D: Sampled, M: Accumulator<D>>(mut moments: M, draws: &[D]) -> M {
    for draw in draws {
        moments.add(*draw);
    }
    moments
}

/// `draws`, added at once.
#[inline(never)]
fn at_once<D: Sampled, M: Accumulator<D>>(mut moments: M, draws: &[D]) -> M {
    moments.add_batch(draws);
    moments
}

#[inline(never)]
fn merged<M: Merge>(mut earlier: M, later: &M) -> M {
    earlier.merge(later);
    earlier
}

#[inline(never)]
fn read<D: Sampled, M: Accumulator<D>, E: Estimator<M::Channel, K>, const K: usize>(
    estimator: &E,
    moments: &M,
    integrals: &Integrals<D::Lanes, K>,
) -> Estimate<D::Lanes> {
    estimator.estimate_anyway(moments, integrals)
}

/// Whether two estimates of a channel are the same bits (any NaN is the same as any other).
fn same_bits<V: Lanes>(a: &Estimate<V>, b: &Estimate<V>, channel: usize) -> bool {
    let (a, b) = (a.channel(channel), b.channel(channel));
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
    same(a.value, b.value) && same(a.std_error, b.std_error) && a.flags == b.flags
}

fn same_everywhere<V: Lanes>(a: &Estimate<V>, b: &Estimate<V>, broken: &'static str) -> Law {
    if (0..V::LANES).all(|channel| same_bits(a, b, channel)) { Ok(()) } else { Err(broken) }
}

/// Whether two estimates of a channel agree to `tolerance`, relative to the value.
fn close<V: Lanes>(a: &Estimate<V>, b: &Estimate<V>, channel: usize, tolerance: f64) -> bool {
    let (a, b) = (a.channel(channel), b.channel(channel));
    let near = |a: f64, b: f64, allowed: f64| (a.is_nan() && b.is_nan()) || a == b || (a - b).abs() <= allowed;
    let rounding = tolerance * a.value.abs().max(b.value.abs());
    near(a.value, b.value, rounding)
        // An error bar at the level of rounding may move by more than its own size.
        && near(a.std_error, b.std_error, libm::sqrt(tolerance) * a.std_error.max(b.std_error) + rounding)
}

/// The same calls give the same bits.
///
/// # Errors
/// If they do not.
pub fn same_calls_same_bits<D: Sampled, M: Accumulator<D>, E: Estimator<M::Channel, K>, const K: usize>(
    estimator: &E,
    empty: &impl Fn(&Integrals<D::Lanes, K>) -> M,
    draws: &[D],
    integrals: &Integrals<D::Lanes, K>,
) -> Law {
    let run = |add: fn(M, &[D]) -> M| read(estimator, &add(empty(integrals), draws), integrals);
    same_everywhere(&run(one_by_one), &run(one_by_one), "add: the same calls gave other bits")?;
    same_everywhere(&run(at_once), &run(at_once), "add_batch: the same calls gave other bits")
}

/// Merging an empty accumulator, on either side, changes no bit, and two empty ones stay empty.
///
/// # Errors
/// If it does, or they do not.
pub fn empty_is_identity<D: Sampled, M: Accumulator<D>, E: Estimator<M::Channel, K>, const K: usize>(
    estimator: &E,
    empty: &impl Fn(&Integrals<D::Lanes, K>) -> M,
    draws: &[D],
    integrals: &Integrals<D::Lanes, K>,
) -> Law {
    let full = one_by_one(empty(integrals), draws);
    let alone = read(estimator, &full, integrals);
    let (mut left, mut right) = (empty(integrals), full.clone());
    left.merge(&full);
    right.merge(&empty(integrals));
    same_everywhere(&alone, &read(estimator, &left, integrals), "an empty accumulator to the left changed bits")?;
    same_everywhere(&alone, &read(estimator, &right, integrals), "an empty accumulator to the right changed bits")?;
    // And an accumulator that goes on goes on the same.
    let (left, right) = (one_by_one(left, draws), one_by_one(right, draws));
    same_everywhere(
        &read(estimator, &left, integrals),
        &read(estimator, &right, integrals),
        "an empty merge changed what came after",
    )?;
    let mut nothing = empty(integrals);
    nothing.merge(&empty(integrals));
    if nothing.count() == 0 { Ok(()) } else { Err("two empty accumulators merged into something") }
}

/// The whole is its parts, split at `at` and merged, or added in other calls, up to `tolerance`.
///
/// # Errors
/// If it is not.
pub fn whole_is_split<D: Sampled, M: Accumulator<D>, E: Estimator<M::Channel, K>, const K: usize>(
    estimator: &E,
    empty: &impl Fn(&Integrals<D::Lanes, K>) -> M,
    draws: &[D],
    at: usize,
    integrals: &Integrals<D::Lanes, K>,
    tolerance: f64,
) -> Law {
    let (earlier, later) = draws.split_at(at.min(draws.len()));
    let mut merged = one_by_one(empty(integrals), earlier);
    merged.merge(&at_once(empty(integrals), later));
    let batches = at_once(at_once(empty(integrals), earlier), later);
    let whole = one_by_one(empty(integrals), draws);
    for parts in [&merged, &batches] {
        if parts.count() != whole.count() {
            return Err("a split changed the count");
        }
        let (whole, parts) = (read(estimator, &whole, integrals), read(estimator, parts, integrals));
        if !(0..D::Lanes::LANES).all(|channel| close(&whole, &parts, channel, tolerance)) {
            return Err("a split changed the estimate by more than the tolerance");
        }
    }
    Ok(())
}

/// A channel that receives NaN leaves every other channel's bits alone, and says so itself.
///
/// # Errors
/// If it does not.
pub fn bad_channel_is_alone<D: Sampled, M: Accumulator<D>, E: Estimator<M::Channel, K>, const K: usize>(
    estimator: &E,
    empty: &impl Fn(&Integrals<D::Lanes, K>) -> M,
    draws: &[D],
    bad: usize,
    integrals: &Integrals<D::Lanes, K>,
) -> Law {
    let nan = <D::Lanes as Lanes>::Scalar::from_f64(f64::NAN);
    let poison = |x: D::Lanes| D::Lanes::from_fn(|i| if i == bad { nan } else { x.get(i) });
    for add in [one_by_one::<D, M>, at_once::<D, M>] {
        let clean = read(estimator, &add(empty(integrals), draws), integrals);
        for position in [0, draws.len() / 2, draws.len().saturating_sub(1)] {
            let (before, rest) = draws.split_at(position.min(draws.len()));
            let Some((draw, after)) = rest.split_first() else { return Ok(()) };
            let poisoned = draw.changed(poison, poison);
            // Not through one slice, since there is no place to build it; the clean run, likewise.
            let run = |middle| read(estimator, &add(add(add(empty(integrals), before), &[middle]), after), integrals);
            let (clean_here, dirty) = (run(*draw), run(poisoned));
            for channel in (0..D::Lanes::LANES).filter(|channel| *channel != bad) {
                if !same_bits(&clean_here, &dirty, channel) {
                    return Err("a bad channel changed another one");
                }
            }
            if bad < D::Lanes::LANES && !dirty.flags(bad).contains(Flags::NONFINITE) {
                return Err("a NaN raised no flag");
            }
        }
        if draws.is_empty() && D::Lanes::LANES > 0 && !clean.flags(0).contains(Flags::EMPTY) {
            return Err("no draws, but no EMPTY flag");
        }
    }
    Ok(())
}

/// Scaling f by a power of two scales value and error exactly; scaling h and H changes no bit.
///
/// # Errors
/// If it does not.
pub fn scales_exactly<D: Sampled, M: Accumulator<D>, E: Estimator<M::Channel, K>, const K: usize>(
    estimator: &E,
    empty: &impl Fn(&Integrals<D::Lanes, K>) -> M,
    draws: &[D],
    integrals: &Integrals<D::Lanes, K>,
) -> Law {
    let factor = D::Lanes::splat(<D::Lanes as Lanes>::Scalar::from_f64(0.125));
    let run = |f: D::Lanes, h: D::Lanes| {
        let integrals = &Integrals::new(integrals.0.map(|integral| integral * h.widen()));
        let mut moments = empty(integrals);
        for draw in draws {
            moments = one_by_one(moments, &[draw.changed(|x| x * f, |x| x * h)]);
        }
        read(estimator, &moments, integrals)
    };
    let alone = run(D::Lanes::ONE, D::Lanes::ONE);
    let (f, h) = (run(factor, D::Lanes::ONE), run(D::Lanes::ONE, factor));
    for channel in 0..D::Lanes::LANES {
        let (alone, f, h) = (alone.channel(channel), f.channel(channel), h.channel(channel));
        let eighth = |x: f64, y: f64| x * 0.125 == y || (x.is_nan() && y.is_nan());
        if !(eighth(alone.value, f.value) && eighth(alone.std_error, f.std_error)) {
            return Err("scaling f did not scale the estimate exactly");
        }
        let same = |x: f64, y: f64| x == y || (x.is_nan() && y.is_nan());
        if !(same(alone.value, h.value) && same(alone.std_error, h.std_error)) {
            return Err("scaling h and H changed the estimate");
        }
    }
    Ok(())
}

/// An accumulator that is given the words of another one becomes it, whatever it was before: the same
/// estimate, and the same bits after further draws and merges.
///
/// # Errors
/// If it does not, or if the number of words depends on the draws.
pub fn saved_goes_on_the_same<D: Sampled, M: Accumulator<D>, E: Estimator<M::Channel, K>, const K: usize>(
    estimator: &E,
    empty: &impl Fn(&Integrals<D::Lanes, K>) -> M,
    draws: &[D],
    at: usize,
    integrals: &Integrals<D::Lanes, K>,
) -> Law {
    let (earlier, later) = draws.split_at(at.min(draws.len()));
    for add in [one_by_one::<D, M>, at_once::<D, M>] {
        let saved = add(empty(integrals), earlier);
        let closed = saved.closed();
        if closed.count() != saved.count() {
            return Err("closing changed the count");
        }
        // Into an empty one, and over one with an open block and moments of other draws.
        for target in [empty(integrals), one_by_one(empty(integrals), later)] {
            let loaded = copied(&saved, target)?;
            if loaded.count() != saved.count() || !same_words(&loaded, &closed) {
                return Err("saved and loaded words differ");
            }
            let read = |moments: &M| read(estimator, moments, integrals);
            same_everywhere(&read(&loaded), &read(&closed), "saving and loading changed the estimate")?;
            let merged = [merged(loaded.clone(), &saved), merged(closed.clone(), &saved)];
            same_everywhere(&read(&merged[0]), &read(&merged[1]), "a merge after loading gave other bits")?;
            let (loaded, closed) = (add(loaded, later), add(closed.clone(), later));
            same_everywhere(&read(&loaded), &read(&closed), "draws after loading gave other bits")?;
        }
    }
    Ok(())
}

/// Words that the laws copy at a time: there is no place for all of them.
const WORDS: usize = 64;

/// `target` with the words of `source`.
#[inline(never)]
fn copied<M: Save + Clone>(source: &M, mut target: M) -> Result<M, &'static str> {
    let (mut source, mut start, mut count) = (source.clone(), 0, [usize::MAX, 0]);
    while start < count[0] {
        let mut words = [0; WORDS];
        count = [0, 0];
        source.words(&mut |word| {
            if let Some(copy) = count[0].checked_sub(start).and_then(|i| words.get_mut(i)) {
                *copy = *word;
            }
            count[0] += 1;
        });
        target.words(&mut |word| {
            if let Some(copy) = count[1].checked_sub(start).and_then(|i| words.get(i)) {
                *word = *copy;
            }
            count[1] += 1;
        });
        if count[0] != count[1] {
            return Err("the number of words depends on the draws");
        }
        start += WORDS;
    }
    Ok(target)
}

/// Whether two accumulators have the same words; both are closed.
#[inline(never)]
fn same_words<M: Save + Clone>(a: &M, b: &M) -> bool {
    // By a hash (FxHash's step): there is no place for all the words.
    let digest = |moments: &M| {
        let mut digest = 0_u64;
        moments.clone().words(&mut |word| digest = (digest.rotate_left(5) ^ *word).wrapping_mul(0x517c_c1b7_2722_0a95));
        digest
    };
    digest(a) == digest(b)
}
