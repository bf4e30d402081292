//! The diagnostic tier: what the flags that look at tails and zeros need beside the moments.

use crate::draw::Draw;
use crate::lanes::Lanes;
use crate::moments::blocked::Blocked;
use crate::moments::kernel::{Kernel, State, Takes, lanes_beside, partials};
use crate::moments::read::Tails;
use crate::moments::save;
use crate::spectrum::Spectrum;

/// Σ|f|, Σ|h|, the largest |f|, and how many draws had h = 0. Joined to an estimator's moments (see
/// [`Joined`](crate::moments::Joined)) it makes the diagnostic tier: HEAVY_TAIL, and DENOM_ILL by
/// the condition number Σ|h|/|Σh|.
pub type Extremes<V> = Blocked<V, ExtremesBlock<V>>;

/// The block kernel of [`Extremes`], and, in `f64` lanes, its state.
#[derive(Clone, Copy, Debug)]
pub struct ExtremesBlock<V> {
    abs_f: V,
    abs_h: V,
    max_f: V,
    nothing: V,
    unbounded: V,
}

/// The state of [`Extremes`].
#[derive(Clone, Copy, Debug)]
pub struct ExtremesState<W>(ExtremesBlock<W>);

impl<V: Lanes> Default for ExtremesBlock<V> {
    fn default() -> Self {
        Self { abs_f: V::ZERO, abs_h: V::ZERO, max_f: V::ZERO, nothing: V::ZERO, unbounded: V::ZERO }
    }
}

impl<W: Lanes> Default for ExtremesState<W> {
    fn default() -> Self {
        Self(ExtremesBlock::default())
    }
}

impl<V: Lanes> ExtremesBlock<V> {
    #[inline(always)]
    fn join(&mut self, other: &Self) {
        self.abs_f = self.abs_f + other.abs_f;
        self.abs_h = self.abs_h + other.abs_h;
        self.max_f = V::select(self.max_f.lt(other.max_f), other.max_f, self.max_f);
        self.nothing = self.nothing + other.nothing;
        self.unbounded = self.unbounded + other.unbounded;
    }

    #[inline(always)]
    fn map<U>(&self, mut change: impl FnMut(V) -> U) -> ExtremesBlock<U> {
        ExtremesBlock {
            abs_f: change(self.abs_f),
            abs_h: change(self.abs_h),
            max_f: change(self.max_f),
            nothing: change(self.nothing),
            unbounded: change(self.unbounded),
        }
    }
}

impl<V: Lanes> Kernel for ExtremesBlock<V> {
    type State = ExtremesState<V::Wide>;
    const PARTIALS: usize = partials(V::LANES);
    const LEARNS: bool = false;
    lanes_beside!(ExtremesBlock<Spectrum<V, P>>);

    #[inline(always)]
    fn empty(_: &Self::State) -> Self {
        Self::default()
    }
    #[inline(always)]
    fn close(&self, _: &Self::State, _: u64) -> Self::State {
        ExtremesState(self.map(V::widen))
    }
}

impl<V: Lanes> Takes<Draw<V>> for ExtremesBlock<V> {
    #[inline(always)]
    fn begin(&mut self, _: usize, _: &Draw<V>) {}
    #[inline(always)]
    fn add(&mut self, _: usize, draw: &Draw<V>) {
        let abs = |x: V| V::select(x.lt(V::ZERO), -x, x);
        let h = draw.h[0];
        let no_h = V::ONE.only(V::equal(h, V::ZERO));
        let no_f = V::equal(draw.f, V::ZERO);
        self.join(&Self {
            abs_f: abs(draw.f),
            abs_h: abs(h),
            max_f: abs(draw.f),
            nothing: no_h.only(no_f),
            unbounded: no_h.except(no_f),
        });
    }
    #[inline(always)]
    fn add_beside<const P: usize>(parts: &mut Self::Beside<P>, index: usize, draws: &[Draw<V>; P]) {
        parts.add(index, &Draw::side_by_side(draws));
    }
}

impl<W: Lanes<Scalar = f64>> State for ExtremesState<W> {
    type Channel = ExtremesState<f64>;
    #[inline(always)]
    fn merge(&mut self, _: u64, later: &Self, _: u64) {
        self.0.join(&later.0);
    }
    fn channel(&self, channel: usize) -> ExtremesState<f64> {
        ExtremesState(self.0.map(|lanes| lanes.get(channel)))
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        let ExtremesBlock { abs_f, abs_h, max_f, nothing, unbounded } = &mut self.0;
        for number in [abs_f, abs_h, max_f, nothing, unbounded] {
            save::lanes(number, each);
        }
    }
}

/// May know the tails.
pub trait MayHaveTails {
    /// The tails, if kept.
    fn tails(&self) -> Option<Tails>;
}

impl MayHaveTails for ExtremesState<f64> {
    fn tails(&self) -> Option<Tails> {
        let Self(all) = self;
        Some(Tails {
            abs_f: all.abs_f,
            abs_h: all.abs_h,
            max_f: all.max_f,
            nothing: all.nothing as u64,
            unbounded: all.unbounded as u64,
        })
    }
}

impl MayHaveTails for () {
    fn tails(&self) -> Option<Tails> {
        None
    }
}
