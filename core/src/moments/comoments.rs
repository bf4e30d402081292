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
use crate::moments::blocked::{Blocked, Kernel, State, Takes, partials};
use crate::moments::range::{magnitude, smallest_square, unless_underflowed};
use crate::moments::read::{HasComoments, HasMeans, Means, Spread};

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
        let turn = slope - self.slope;
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
        let fraction = later_count as f64 / (count + later_count) as f64;
        // n_a·(n_b/n), not n_a·n_b/n: the product of two counts overflows u64 from 2^32 on.
        let (fraction, weight) = (W::splat(fraction), W::splat(count as f64 * fraction));
        let f = (later.anchor.f - self.anchor.f) + (later.f - self.f);
        let h = (later.anchor.h[0] - self.anchor.h[0]) + (later.h - self.h);
        let mean_h = self.h + h * fraction;
        let hh = self.hh + later.hh + h * h * weight;
        let fh = (self.eh + self.slope * self.hh) + (later.eh + later.slope * later.hh) + f * h * weight;
        let slope = Self::fitted_slope(fh, hh, self.anchor.h[0] + mean_h, self.slope);
        let (a, b) = (self.with_slope(slope), later.with_slope(slope));
        let e = f - slope * h;
        let ee = a.ee + b.ee + e * e * weight;
        let smallest = smallest_square::<W>();
        *self = Self {
            anchor: self.anchor,
            f: self.f + f * fraction,
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
