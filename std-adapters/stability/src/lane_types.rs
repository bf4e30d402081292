//! Every lane type, and the moments of a case in one of its channels.

use crate::case::Precision;
use crate::draws::Draws;
use crate::method::{Everything, One};
use core::fmt::Debug;
use ratiocv_core::moments::{Accumulate, Comoments, ComomentsState, Merge, Moments, Save};
use ratiocv_core::{Draw, Lanes, Scalar, Spectrum};
use ratiocv_simd::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8};

/// How draws are accumulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Call {
    /// One by one.
    Singly,
    /// All at once.
    Batch,
    /// Split in halves, down to single draws where they are few, and merged.
    Tree,
    /// Half of them; the rest are added to what was loaded from the numbers that were saved.
    Saved,
}

impl Call {
    pub(crate) const ALL: [Self; 4] = [Self::Singly, Self::Batch, Self::Tree, Self::Saved];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Singly => "draw by draw",
            Self::Batch => "in a batch",
            Self::Tree => "merged in a tree",
            Self::Saved => "saved and loaded",
        }
    }
}

/// The moments of the channels of one lane type.
pub(crate) struct Channels<S> {
    pub(crate) count: u64,
    pub(crate) channels: Vec<S>,
}

/// A lane type, as a function that makes moments of `K` auxiliaries.
pub(crate) struct LaneType<S, const K: usize> {
    pub(crate) name: &'static str,
    pub(crate) lanes: usize,
    pub(crate) moments: fn(&Parts<'_, K>, Call) -> Channels<S>,
}

/// What is accumulated: a first part and perhaps a second, in the middle channel of innocent ones.
pub(crate) struct Parts<'a, const K: usize> {
    pub(crate) parts: Vec<&'a Draws<K>>,
    /// Whether the case itself is left out, so that its channel is innocent too.
    pub(crate) innocent: bool,
}

/// The lane types of each precision, for one kind of moments.
pub(crate) trait Kept<const K: usize>: Sized + 'static {
    /// Those of `precision`.
    fn lane_types(precision: Precision) -> &'static [LaneType<Self, K>];
}

macro_rules! kept {
    ($channel:ty, $k:literal, $moments:ident: [$($single:ty),*], [$($double:ty),*]) => {
        impl Kept<$k> for $channel {
            fn lane_types(precision: Precision) -> &'static [LaneType<Self, $k>] {
                const SINGLE: &[LaneType<$channel, $k>] = &[$(kept!(@ $single, $k, $moments)),*];
                const DOUBLE: &[LaneType<$channel, $k>] = &[$(kept!(@ $double, $k, $moments)),*];
                precision.of(SINGLE, DOUBLE)
            }
        }
    };
    (@ $lanes:ty, $k:literal, $moments:ident) => {
        LaneType {
            name: stringify!($lanes),
            lanes: <$lanes as Lanes>::LANES,
            moments: channels::<$lanes, $moments<$lanes>, $k>,
        }
    };
}

type Two<V> = Comoments<V, 2>;
type Five<V> = Comoments<V, 5>;

kept!(One, 1, Everything:
    [f32, Spectrum<f32, 3>, Spectrum<f32, 16>, F32x4, F32x8, F32x16],
    [f64, Spectrum<f64, 3>, Spectrum<f64, 16>, F64x2, F64x4, F64x8]);
// Large, and slow to compile: one scalar, one array, one pack.
kept!(ComomentsState<f64, 2>, 2, Two: [f32, Spectrum<f32, 3>, F32x4], [f64, Spectrum<f64, 3>, F64x2]);
kept!(ComomentsState<f64, 5>, 5, Five: [f32, Spectrum<f32, 3>, F32x4], [f64, Spectrum<f64, 3>, F64x2]);

/// The channel of the case, of `lanes`.
pub(crate) fn middle(lanes: usize) -> usize {
    lanes / 2
}

/// What innocent channels draw.
fn beside<const K: usize>(i: usize, lane: usize) -> Draw<f64, K> {
    let x = |j: usize| 0.5 + ((i * 7 + lane * 3 + j) % 5) as f64 / 8.0;
    Draw { f: x(0), h: core::array::from_fn(|k| x(i / 5 + 1 + k)) }
}

/// Draw `i` in all lanes.
fn in_lanes<V: Lanes, const K: usize>(draws: &Draws<K>, innocent: bool, i: usize) -> Draw<V, K> {
    let case = if innocent { beside(i, middle(V::LANES)) } else { draws.get(i) };
    let lane = |lane: usize| if lane == middle(V::LANES) { case } else { beside(i, lane) };
    Draw {
        f: V::from_fn(|i| V::Scalar::from_f64(lane(i).f)),
        h: core::array::from_fn(|k| V::from_fn(|i| V::Scalar::from_f64(lane(i).h[k]))),
    }
}

/// The moments of every channel.
pub(crate) fn channels<V, M, const K: usize>(parts: &Parts<'_, K>, call: Call) -> Channels<M::Channel>
where
    V: Lanes,
    M: Accumulate<Draw<V, K>> + Merge + Save + Moments<Lanes = V> + Clone + Default + Debug,
{
    let moments = merged::<V, M, K>(parts, call).closed();
    Channels { count: moments.count(), channels: (0..V::LANES).map(|i| moments.channel(i)).collect() }
}

fn merged<V, M, const K: usize>(parts: &Parts<'_, K>, call: Call) -> M
where
    V: Lanes,
    M: Accumulate<Draw<V, K>> + Merge + Save + Clone + Default,
{
    let mut whole = M::default();
    for draws in &parts.parts {
        let draw = |i| in_lanes::<V, K>(draws, parts.innocent, i);
        let mut part = M::default();
        match call {
            Call::Tree => part = tree::<V, M, K>(0, draws.count, if draws.count <= 1024 { 1 } else { 999 }, &draw),
            Call::Singly => add(&mut part, 0, draws.count, 1, &draw),
            Call::Batch => add(&mut part, 0, draws.count, AT_ONCE, &draw),
            Call::Saved => {
                add(&mut part, 0, draws.count / 2, 1, &draw);
                let words = saved(&mut part);
                part = loaded(&words);
                add(&mut part, draws.count / 2, draws.count, 1, &draw);
            }
        }
        for _ in 0..draws.doublings {
            let half = part.clone();
            append(&mut part, &half);
        }
        append(&mut whole, &part);
    }
    whole
}

/// Draws of a batch.
const AT_ONCE: usize = 1 << 15;

/// Adds draws `start`..`end` in batches of `at_once`; a batch of one is a draw added by itself. This and `append` are
/// out of line, and the only callers of the accumulators, whose code is large and is compiled for each caller.
#[inline(never)]
pub(crate) fn add<V, M, const K: usize>(
    moments: &mut M,
    start: usize,
    end: usize,
    at_once: usize,
    draw: &dyn Fn(usize) -> Draw<V, K>,
) where
    V: Lanes,
    M: Accumulate<Draw<V, K>>,
{
    let mut batch = Vec::with_capacity(at_once.min(end - start));
    for from in (start..end).step_by(at_once) {
        batch.clear();
        batch.extend((from..end.min(from + at_once)).map(draw));
        moments.add_batch(&batch);
    }
}

#[inline(never)]
fn append<M: Merge>(moments: &mut M, later: &M) {
    moments.merge(later);
}

/// All numbers of `moments`.
pub(crate) fn saved<M: Save>(moments: &mut M) -> Vec<u64> {
    let mut words = Vec::new();
    moments.words(&mut |word| words.push(*word));
    words
}

/// Moments of these numbers.
pub(crate) fn loaded<M: Save + Default>(words: &[u64]) -> M {
    let (mut moments, mut next) = (M::default(), words.iter());
    moments.words(&mut |word| *word = next.next().copied().unwrap_or_default());
    moments
}

fn tree<V, M, const K: usize>(start: usize, end: usize, leaf: usize, draw: &dyn Fn(usize) -> Draw<V, K>) -> M
where
    V: Lanes,
    M: Accumulate<Draw<V, K>> + Merge + Default,
{
    let mut whole = M::default();
    if end - start <= leaf {
        add(&mut whole, start, end, 1, draw);
    } else {
        let at = start + (end - start) / 2;
        append(&mut whole, &tree::<V, M, K>(start, at, leaf, draw));
        append(&mut whole, &tree::<V, M, K>(at, end, leaf, draw));
    }
    whole
}
