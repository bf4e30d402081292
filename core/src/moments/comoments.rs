//! Second moments of f and of `K` auxiliaries, kept as the residuals of a running regression.
//!
//! Every error bar is the variance of y − Σ_k c_k·x_k for some c: 0 for plain, R̂ for the ratio of means,
//! r̄ for Hartley–Ross, β̂ for regression. Expanded, s_yy − 2c·s_xy + c²·s_xx cancels to noise (below
//! zero in 44 % of 10⁴ blocks with f = fl(h/3) in `f32`: tests/stiff, C7). So we keep the residual e = y − c₀·x about the
//! least-squares slope c₀ known so far, where s_ee, s_eh ≈ 0 and s_hh give, for *every* c,
//!
//! ```text
//! s(c) = s_ee + 2(c₀ − c)·s_eh + (c₀ − c)²·s_hh
//! ```
//!
//! (for one auxiliary) as a sum in which nothing cancels: no c can fall below the least-squares residual. (A residual
//! about R̂ instead would serve the ratio but spoil plain's error bar where h is the noisier one.)
//! A merge moves both parts to their joint slope, exactly; a block of draws is summed about the
//! slope that the state knew when the block was opened.

use crate::draw::Draw;
use crate::filled::filled;
use crate::lanes::Lanes;
use crate::moments::blocked::Blocked;
use crate::moments::kernel::{Kernel, State, Takes, lanes_beside, partials};
use crate::moments::range::{magnitude, smallest_square, unless_underflowed};
use crate::moments::read::{HasComoments, HasMeans, Means, Spread};
use crate::moments::save;
use crate::planted::planted;
use crate::solve::solve;
use crate::spectrum::Spectrum;
use core::array;

/// Means and second co-moments of f and `K` auxiliaries: the error-bar tier of every estimator that
/// works on means, and what regressions read.
///
/// After 1 draw the means are that draw, to the bit, and the second moments are 0 (no estimator
/// makes an error bar of them). NaN or an infinity in a channel makes that channel's moments NaN.
/// Squares beyond the range of the lanes' scalar leave the means right and the second moments
/// unknown, which estimators report as OVERFLOW or UNDERFLOW. Only if the deviations from a block's first
/// draw have squares that vanish, a mean that is 0 and products with the other number that are 0 do they count as 0.
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
pub type Comoments<V, const K: usize = 1> = Blocked<V, ComomentsBlock<V, K>>;

/// The block kernel of [`Comoments`]: sums about the block's first draw and the known slopes.
#[derive(Clone, Copy, Debug)]
pub struct ComomentsBlock<V, const K: usize = 1> {
    shift: Draw<V, K>,
    slope: [V; K],
    f: V,
    h: [V; K],
    squares: Squares<V, K>,
}

/// Sums of products of the residual e and of each h.
#[derive(Clone, Copy, Debug)]
struct Squares<V, const K: usize> {
    ee: V,
    eh: [V; K],
    /// The lower triangle, `hh[i][j]` with j ≤ i; the rest is 0.
    hh: [[V; K]; K],
}

/// The state of [`Comoments`]: anchor, means relative to it, slopes, and sums of squares about the
/// means.
#[derive(Clone, Copy, Debug)]
pub struct ComomentsState<W, const K: usize = 1> {
    anchor: Draw<W, K>,
    f: W,
    h: [W; K],
    slope: [W; K],
    squares: Squares<W, K>,
}

impl<V: Lanes, const K: usize> Squares<V, K> {
    const ZERO: Self = Self { ee: V::ZERO, eh: [V::ZERO; K], hh: [[V::ZERO; K]; K] };

    #[inline(always)]
    fn map<U: Lanes>(&self, change: impl Fn(V) -> U) -> Squares<U, K> {
        let mut mapped =
            Squares { ee: change(self.ee), eh: filled(U::ZERO, |k| change(self.eh[k])), hh: [[U::ZERO; K]; K] };
        for i in 0..K {
            for j in 0..=i {
                mapped.hh[i][j] = change(self.hh[i][j]);
            }
        }
        mapped
    }

    /// Adds the squares and products of `e` and `h`.
    #[inline(always)]
    fn add(&mut self, e: V, h: &[V; K]) {
        self.ee = self.ee + e * e;
        for i in 0..K {
            self.eh[i] = self.eh[i] + e * h[i];
            for j in 0..=i {
                self.hh[i][j] = self.hh[i][j] + h[i] * h[j];
            }
        }
    }

    /// Adds them `weight` times: a way to subtract, too.
    #[inline(always)]
    fn add_times(&mut self, e: V, h: &[V; K], weight: V) {
        self.ee = self.ee + e * e * weight;
        for i in 0..K {
            self.eh[i] = self.eh[i] + e * h[i] * weight;
            for j in 0..=i {
                self.hh[i][j] = self.hh[i][j] + h[i] * h[j] * weight;
            }
        }
    }

    #[inline(always)]
    fn add_all(&mut self, other: &Self) {
        self.ee = self.ee + other.ee;
        for i in 0..K {
            self.eh[i] = self.eh[i] + other.eh[i];
            for j in 0..=i {
                self.hh[i][j] = self.hh[i][j] + other.hh[i][j];
            }
        }
    }

    /// Σh_i·h_j.
    #[inline(always)]
    fn hh(&self, i: usize, j: usize) -> V {
        self.hh[i.max(j)][i.min(j)]
    }

    /// NaN where squares underflowed; `slope` is what e is about, `e` and `h` are any sums of them. Where a sum cancels,
    /// products with what is larger tell all the same.
    #[inline(always)]
    fn unless_underflowed(mut self, slope: &[V; K], e: V, h: &[V; K], smallest: V) -> Self
    where
        V: Lanes<Scalar = f64>,
    {
        let f_scale = (0..K).fold(self.ee, |sum, k| sum + slope[k] * slope[k] * self.hh[k][k]);
        // A product that is NaN, of an infinity and 0, tells nothing.
        let or = |sum: V, product: V| sum + product.only(V::ZERO.lt(magnitude(product))).only(V::equal(sum, V::ZERO));
        self.ee = unless_underflowed(self.ee, f_scale, self.eh.into_iter().fold(e, or), smallest);
        for (k, h) in h.iter().enumerate() {
            self.hh[k][k] = unless_underflowed(self.hh[k][k], self.hh[k][k], or(*h, self.eh[k]), smallest);
        }
        self
    }
}

impl<W: Lanes, const K: usize> Default for ComomentsState<W, K> {
    fn default() -> Self {
        Self { anchor: Draw::ZERO, slope: [W::ZERO; K], f: W::ZERO, h: [W::ZERO; K], squares: Squares::ZERO }
    }
}

/// f − Σ_k slope_k·h_k.
#[inline(always)]
fn residual<V: Lanes, const K: usize>(f: V, slope: &[V; K], h: &[V; K]) -> V {
    (0..K).fold(f, |e, k| e - slope[k] * h[k])
}

impl<V: Lanes, const K: usize> ComomentsBlock<V, K> {
    #[inline(always)]
    fn join(&mut self, other: &Self) {
        self.f = self.f + other.f;
        for (h, other) in self.h.iter_mut().zip(other.h) {
            *h = *h + other;
        }
        self.squares.add_all(&other.squares);
    }
    #[inline(always)]
    fn map<U: Lanes>(&self, change: impl Fn(V) -> U) -> ComomentsBlock<U, K> {
        ComomentsBlock {
            shift: self.shift.map(&change),
            slope: filled(U::ZERO, |k| change(self.slope[k])),
            f: change(self.f),
            h: filled(U::ZERO, |k| change(self.h[k])),
            squares: self.squares.map(&change),
        }
    }
}

impl<V: Lanes, const K: usize> Kernel for ComomentsBlock<V, K> {
    type State = ComomentsState<V::Wide, K>;
    const PARTIALS: usize = partials(V::LANES);
    const LEARNS: bool = true;
    lanes_beside!(ComomentsBlock<Spectrum<V, P>, K>);

    #[inline(always)]
    fn empty(state: &Self::State) -> Self {
        Self {
            shift: Draw::ZERO,
            slope: filled(V::ZERO, |k| V::narrow(state.slope[k])),
            f: V::ZERO,
            h: [V::ZERO; K],
            squares: Squares::ZERO,
        }
    }
    #[inline(always)]
    fn close(&self, _: &Self::State, count: u64) -> Self::State {
        let count = V::Wide::splat(count as f64);
        let slope = filled(V::Wide::ZERO, |k| self.slope[k].widen());
        let (f, h) = (self.f.widen() / count, filled(V::Wide::ZERO, |k| self.h[k].widen() / count));
        let e = residual(f, &slope, &h);
        let mut squares = self.squares.map(V::widen);
        squares.add_times(e, &h, -count);
        squares.ee = magnitude(squares.ee);
        for k in 0..K {
            squares.hh[k][k] = magnitude(squares.hh[k][k]);
        }
        ComomentsState {
            anchor: self.shift.map(V::widen),
            f,
            h,
            slope,
            squares: squares.unless_underflowed(&slope, e, &h, smallest_square::<V>()),
        }
    }
}

impl<V: Lanes, const K: usize> Takes<Draw<V, K>> for ComomentsBlock<V, K> {
    #[inline(always)]
    fn begin(&mut self, index: usize, draw: &Draw<V, K>) {
        if index == 0 {
            self.shift = *draw;
        }
    }
    #[inline(always)]
    fn add(&mut self, _: usize, draw: &Draw<V, K>) {
        let f = draw.f - self.shift.f;
        let mut h = draw.h;
        for (h, shift) in h.iter_mut().zip(self.shift.h) {
            *h = *h - shift;
        }
        let e = residual(f, &self.slope, &h);
        self.f = self.f + f;
        for (sum, h) in self.h.iter_mut().zip(h) {
            *sum = *sum + h;
        }
        self.squares.add(e, &h);
    }
    #[inline(always)]
    fn add_beside<const P: usize>(parts: &mut Self::Beside<P>, index: usize, draws: &[Draw<V, K>; P]) {
        parts.add(index, &Draw::side_by_side(draws));
    }
}

impl<W: Lanes<Scalar = f64>, const K: usize> ComomentsState<W, K> {
    /// Σ(f − f̄)(h_k − h̄_k).
    #[inline(always)]
    fn fh(&self, k: usize) -> W {
        (0..K).fold(self.squares.eh[k], |sum, j| sum + self.slope[j] * self.squares.hh(k, j))
    }

    /// Σ(f − f̄)².
    #[inline(always)]
    fn ff(&self) -> W {
        (0..K).fold(self.squares.ee, |sum, k| sum + self.slope[k] * (self.squares.eh[k] + self.fh(k)))
    }

    /// The least-squares slopes of moments `ff`, `fh`, `hh` of `count` draws whose auxiliaries have the means
    /// `mean_h`; 0 for an auxiliary whose spread is still too small against its mean to tell, and for all
    /// unless the fit is beyond doubt, F > 1000. A slope fitted to noise may be huge, and bury the
    /// residuals of later draws under rounding; without one, the residual of a fit with F = 1000 loses
    /// three digits where there are few draws, and none where there are many.
    #[inline(always)]
    fn fitted_slopes(ff: W, fh: [W; K], hh: &Squares<W, K>, mean_h: [W; K], count: f64) -> [W; K] {
        let spreads: [W; K] = filled(W::ZERO, |k| {
            let enough = (W::splat(1e-4) * mean_h[k] * mean_h[k]).lt(hh.hh[k][k]);
            W::ONE.only(enough)
        });
        let matrix = filled([W::ZERO; K], |i| filled(W::ZERO, |j| hh.hh(i, j)));
        // Any slopes will do; those of nearly dependent auxiliaries would only be large.
        let fit = solve(&matrix, &fh, &spreads, 1e-9).x;
        let explained = (0..K).fold(W::ZERO, |sum, k| sum + fit[k] * fh[k]);
        let freedom = count - (K + 1) as f64;
        let doubt = (ff - explained) * W::splat(planted!("comoments_noise_slope": 1000.0, 0.0) * K as f64);
        let sure = doubt.lt(explained * W::splat(freedom));
        // One slope that is not a number would spoil the residuals of all.
        let finite = W::equal(explained * W::ZERO, W::ZERO);
        filled(W::ZERO, |k| fit[k].only(sure).only(finite))
    }

    /// The same moments with residuals about `slope`.
    #[inline(always)]
    fn with_slopes(mut self, slope: &[W; K]) -> Self {
        let turn: [W; K] =
            filled(W::ZERO, |k| planted!("comoments_turn": slope[k] - self.slope[k], self.slope[k] - slope[k]));
        let before = self.squares.eh;
        for k in 0..K {
            let along = (0..K).fold(W::ZERO, |sum, j| sum + turn[j] * self.squares.hh(k, j));
            self.squares.eh[k] = before[k] - along;
            self.squares.ee = self.squares.ee - turn[k] * (before[k] + self.squares.eh[k]);
        }
        self.squares.ee = magnitude(self.squares.ee);
        self.slope = *slope;
        self
    }

    /// Calls `each` with every number of this state and the one in its place in `other`.
    #[inline(always)]
    fn pair<U>(&mut self, other: &ComomentsState<U, K>, each: impl Fn(&mut W, &U)) {
        each(&mut self.anchor.f, &other.anchor.f);
        each(&mut self.f, &other.f);
        each(&mut self.squares.ee, &other.squares.ee);
        for k in 0..K {
            each(&mut self.anchor.h[k], &other.anchor.h[k]);
            each(&mut self.h[k], &other.h[k]);
            each(&mut self.slope[k], &other.slope[k]);
            each(&mut self.squares.eh[k], &other.squares.eh[k]);
            for j in 0..=k {
                each(&mut self.squares.hh[k][j], &other.squares.hh[k][j]);
            }
        }
    }

    /// Pairwise update of Chan, Golub and LeVeque (1983), on residuals about the joint slopes, of the larger
    /// part by the smaller one.
    #[inline(always)]
    fn append(&mut self, small: &Self, share: Share) {
        if W::PACKS > 1 {
            for pack in 0..W::PACKS {
                let (mut one, mut other) = (ComomentsState::default(), ComomentsState::default());
                one.pair(self, |to, lanes: &W| *to = lanes.pack(pack));
                other.pair(small, |to, lanes: &W| *to = lanes.pack(pack));
                one.append(&other, share);
                self.pair(&one, |to, lanes| to.set_pack(pack, *lanes));
            }
            return;
        }
        let large = *self;
        let (fraction, weight) = (W::splat(share.fraction), W::splat(share.weight));
        let anchors = small.anchor.zip(large.anchor, W::sub);
        let f = anchors.f + (small.f - large.f);
        let h = filled(W::ZERO, |k| anchors.h[k] + (small.h[k] - large.h[k]));
        let mean_h = filled(W::ZERO, |k| large.h[k] + h[k] * fraction);
        let mut joint = large.squares;
        joint.add_all(&small.squares);
        joint.add_times(W::ZERO, &h, weight);
        let fh = filled(W::ZERO, |k| large.fh(k) + small.fh(k) + f * h[k] * weight);
        let absolute = filled(W::ZERO, |k| large.anchor.h[k] + mean_h[k]);
        let ff = large.ff() + small.ff() + f * f * weight;
        let slope = Self::fitted_slopes(ff, fh, &joint, absolute, share.total);
        let (a, b) = (large.with_slopes(&slope), small.with_slopes(&slope));
        let e = residual(f, &slope, &h);
        joint.ee = a.squares.ee + b.squares.ee + e * e * weight;
        joint.eh = filled(W::ZERO, |k| a.squares.eh[k] + b.squares.eh[k] + e * h[k] * weight);
        let smallest = W::splat(f64::MIN_POSITIVE / f64::EPSILON);
        *self = Self {
            anchor: large.anchor,
            f: large.f + f * fraction,
            h: mean_h,
            slope,
            squares: joint.unless_underflowed(&slope, e, &h, smallest),
        };
    }
}

/// What a merge needs of the counts of two parts.
#[derive(Clone, Copy)]
struct Share {
    /// The smaller part's fraction of all draws.
    fraction: f64,
    /// n_a·n_b/n.
    weight: f64,
    /// n.
    total: f64,
}

impl Share {
    fn of(count: u64, later_count: u64) -> Self {
        let total = (count + later_count) as f64;
        let fraction = count.min(later_count) as f64 / total;
        // n_a·(n_b/n), not n_a·n_b/n: the product of two counts overflows u64 from 2^32 on.
        let weight = planted!("comoments_weight": count.max(later_count) as f64, later_count as f64) * fraction;
        Self { fraction, weight, total }
    }
}

impl<W: Lanes<Scalar = f64, Wide = W>, const K: usize> State for ComomentsState<W, K> {
    type Channel = ComomentsState<f64, K>;

    #[inline(always)]
    fn merge(&mut self, count: u64, later: &Self, later_count: u64) {
        let share = Share::of(count, later_count);
        if later_count > count {
            let mut merged = *later;
            merged.append(self, share);
            *self = merged;
        } else {
            self.append(later, share);
        }
    }

    fn channel(&self, channel: usize) -> ComomentsState<f64, K> {
        let mut one = ComomentsState::default();
        one.pair(self, |to: &mut f64, lanes| *to = lanes.get(channel));
        one
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        save::draw(&mut self.anchor, each);
        save::lanes(&mut self.f, each);
        save::all(&mut self.h, each);
        save::all(planted!("save_slope": &mut self.slope, &mut self.squares.eh), each);
        let Squares { ee, eh, hh } = &mut self.squares;
        save::lanes(ee, each);
        save::all(eh, each);
        for (i, row) in hh.iter_mut().enumerate() {
            save::all(&mut row[..=i], each);
        }
    }
}

impl<const K: usize> HasMeans<K> for ComomentsState<f64, K> {
    fn means(&self, _: u64) -> Means<K> {
        Means { f: self.anchor.f + self.f, h: array::from_fn(|k| self.anchor.h[k] + self.h[k]) }
    }
    fn spread(&self) -> Option<Spread<K>> {
        Some(self.comoments())
    }
}

impl<const K: usize> HasComoments<K> for ComomentsState<f64, K> {
    fn comoments(&self) -> Spread<K> {
        let Squares { ee, eh, .. } = self.squares;
        Spread { slope: self.slope, ee, eh, hh: array::from_fn(|i| array::from_fn(|j| self.squares.hh(i, j))) }
    }
}
