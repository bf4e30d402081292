//! Second moments of (f, h), kept as the residuals of a running regression.
//!
//! Every error bar is the variance of y − c·x for some c: 0 for plain, R̂ for the ratio of means, r̄
//! for Hartley–Ross, β̂ for regression. Expanded, s_yy − 2c·s_xy + c²·s_xx cancels to noise (below
//! zero in 38 % of trials with f = fl(h/3) in `f32`). So we keep the residual e = y − c₀·x about the
//! least-squares slope c₀ known so far, where s_ee, s_eh ≈ 0 and s_hh give, for *every* c,
//!
//! ```text
//! s(c) = s_ee + 2(c₀ − c)·s_eh + (c₀ − c)²·s_hh
//! ```
//!
//! as a sum in which nothing cancels: no c can fall below the least-squares residual. (A residual
//! about R̂ instead would serve the ratio but spoil plain's error bar where h is the noisier one.)
//! A merge moves both parts to their joint slope, exactly; a block of draws is summed about the
//! slope that the state knew when the block was opened.

use crate::draw::Draw;
use crate::lanes::Lanes;
use crate::moments::blocked::{Blocked, Kernel, State, Takes, larger_first, partials};
use crate::moments::range::{magnitude, smallest_square, unless_underflowed};
use crate::moments::read::{HasComoments, HasMeans, Means, Spread};
use crate::planted::planted;

/// Means and second co-moments of f and one auxiliary: the error-bar tier of every estimator that
/// works on means.
///
/// After 1 draw the means are that draw, to the bit, and the second moments are 0 (no estimator
/// makes an error bar of them). NaN or an infinity in a channel makes that channel's moments NaN.
/// Squares beyond the range of the lanes' scalar leave the means right and the second moments
/// unknown, which estimators report as OVERFLOW or UNDERFLOW.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, Estimator, Integrals, Tin};
/// let mut pixel = Comoments::<f64>::default();
/// for (f, h) in [(1.0, 0.9), (0.2, 0.3), (2.0, 1.8)] {
///     pixel.add(Draw::new(f, h));
/// }
/// let tin = Tin.estimate(&pixel, &Integrals::ONE)?;
/// println!("{} ± {} {}", tin.value, tin.std_error, tin.flags(0));
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
pub type Comoments<V> = Blocked<V, ComomentsBlock<V>>;

/// The block kernel of [`Comoments`]: five sums about the block's first draw and the known slope.
#[derive(Clone, Copy, Debug)]
pub struct ComomentsBlock<V> {
    shift: Draw<V>,
    slope: V,
    f: V,
    h: V,
    ee: V,
    eh: V,
    hh: V,
}

/// The state of [`Comoments`]: anchor, means relative to it, slope, and sums of squares about the
/// means.
#[derive(Clone, Copy, Debug)]
pub struct ComomentsState<W> {
    anchor: Draw<W>,
    f: W,
    h: W,
    slope: W,
    ee: W,
    eh: W,
    hh: W,
}

impl<W: Lanes> Default for ComomentsState<W> {
    fn default() -> Self {
        Self { anchor: Draw::ZERO, slope: W::ZERO, f: W::ZERO, h: W::ZERO, ee: W::ZERO, eh: W::ZERO, hh: W::ZERO }
    }
}

impl<V: Lanes> Kernel for ComomentsBlock<V> {
    type State = ComomentsState<V::Wide>;
    const PARTIALS: usize = partials(V::LANES);

    #[inline(always)]
    fn empty(state: &Self::State) -> Self {
        Self {
            shift: Draw::ZERO,
            slope: V::narrow(state.slope),
            f: V::ZERO,
            h: V::ZERO,
            ee: V::ZERO,
            eh: V::ZERO,
            hh: V::ZERO,
        }
    }
    #[inline(always)]
    fn fold(&mut self, other: &Self) {
        self.f = self.f + other.f;
        self.h = self.h + other.h;
        self.ee = self.ee + other.ee;
        self.eh = self.eh + other.eh;
        self.hh = self.hh + other.hh;
    }
    #[inline(always)]
    fn close(&self, _: &Self::State, count: u64) -> Self::State {
        let count = V::Wide::splat(count as f64);
        let slope = self.slope.widen();
        let (f, h) = (self.f.widen() / count, self.h.widen() / count);
        let e = f - slope * h;
        let ee = magnitude(self.ee.widen() - e * e * count);
        let hh = magnitude(self.hh.widen() - h * h * count);
        let smallest = smallest_square::<V>();
        ComomentsState {
            anchor: self.shift.map(V::widen),
            f,
            h,
            slope,
            ee: unless_underflowed(ee, ee + slope * slope * hh, e, smallest),
            eh: self.eh.widen() - e * h * count,
            hh: unless_underflowed(hh, hh, h, smallest),
        }
    }
}

impl<V: Lanes> Takes<Draw<V>> for ComomentsBlock<V> {
    #[inline(always)]
    fn open(state: &Self::State, first: &Draw<V>) -> Self {
        Self { shift: *first, ..Self::empty(state) }
    }
    #[inline(always)]
    fn add(&mut self, _: usize, draw: &Draw<V>) {
        let f = draw.f - self.shift.f;
        let h = draw.h[0] - self.shift.h[0];
        let e = f - self.slope * h;
        self.f = self.f + f;
        self.h = self.h + h;
        self.ee = self.ee + e * e;
        self.eh = self.eh + e * h;
        self.hh = self.hh + h * h;
    }
}

impl<W: Lanes<Scalar = f64, Wide = W>> ComomentsState<W> {
    /// The least-squares slope of moments `fh`, `hh` of draws whose auxiliary has the mean `mean_h`,
    /// or `known` where the spread of h is still too small against its mean to tell: a slope fitted
    /// to noise would be huge, and bury the residuals of later draws under rounding.
    #[inline(always)]
    fn fitted_slope(fh: W, hh: W, mean_h: W, known: W) -> W {
        let fitted = fh / hh;
        let fitted = W::select(W::equal(fitted * W::ZERO, W::ZERO), fitted, known);
        W::select((W::splat(1e-4) * mean_h * mean_h).lt(hh), fitted, known)
    }

    /// The same moments with residuals about `slope`.
    #[inline(always)]
    fn with_slope(self, slope: W) -> Self {
        let turn = planted!("comoments_turn": slope - self.slope, self.slope - slope);
        Self {
            slope,
            ee: magnitude(self.ee - turn * (self.eh + self.eh - turn * self.hh)),
            eh: self.eh - turn * self.hh,
            ..self
        }
    }
}

impl<W: Lanes<Scalar = f64, Wide = W>> State for ComomentsState<W> {
    type Channel = ComomentsState<f64>;

    /// Pairwise update of Chan, Golub and LeVeque (1983), on residuals about the joint slope.
    #[inline(always)]
    fn merge(&mut self, count: u64, later: &Self, later_count: u64) {
        let (large, small, fraction) = larger_first(*self, count, *later, later_count);
        // n_a·(n_b/n), not n_a·n_b/n: the product of two counts overflows u64 from 2^32 on.
        let weight = planted!("comoments_weight": count.max(later_count) as f64, later_count as f64) * fraction;
        let (fraction, weight) = (W::splat(fraction), W::splat(weight));
        let f = (small.anchor.f - large.anchor.f) + (small.f - large.f);
        let h = (small.anchor.h[0] - large.anchor.h[0]) + (small.h - large.h);
        let mean_h = large.h + h * fraction;
        let hh = large.hh + small.hh + h * h * weight;
        let fh = (large.eh + large.slope * large.hh) + (small.eh + small.slope * small.hh) + f * h * weight;
        let slope = Self::fitted_slope(fh, hh, large.anchor.h[0] + mean_h, large.slope);
        let (a, b) = (large.with_slope(slope), small.with_slope(slope));
        let e = f - slope * h;
        let ee = a.ee + b.ee + e * e * weight;
        let smallest = smallest_square::<W>();
        *self = Self {
            anchor: large.anchor,
            f: large.f + f * fraction,
            h: mean_h,
            slope,
            ee: unless_underflowed(ee, ee + slope * slope * hh, e, smallest),
            eh: a.eh + b.eh + e * h * weight,
            hh: unless_underflowed(hh, hh, h, smallest),
        };
    }

    fn channel(&self, channel: usize) -> ComomentsState<f64> {
        ComomentsState {
            anchor: self.anchor.map(|lanes| lanes.get(channel)),
            f: self.f.get(channel),
            h: self.h.get(channel),
            slope: self.slope.get(channel),
            ee: self.ee.get(channel),
            eh: self.eh.get(channel),
            hh: self.hh.get(channel),
        }
    }
}

impl HasMeans<1> for ComomentsState<f64> {
    fn means(&self, _: u64) -> Means {
        Means { f: self.anchor.f + self.f, h: [self.anchor.h[0] + self.h] }
    }
    fn spread(&self) -> Option<Spread> {
        Some(self.comoments())
    }
}

impl HasComoments for ComomentsState<f64> {
    fn comoments(&self) -> Spread {
        Spread { slope: self.slope, ee: self.ee, eh: self.eh, hh: self.hh }
    }
}
