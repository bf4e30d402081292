//! Mean and variance of one number per draw: the integrand itself, or the ratio f/h.

use crate::draw::Draw;
use crate::error::{Error, weight_in_range};
use crate::filled::filled;
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::blocked::Blocked;
use crate::moments::kernel::{Kernel, State, Takes, lanes_beside, larger_first, partials};
use crate::moments::range::{magnitude, smallest_square, unless_underflowed};
use crate::moments::read::{HasMeans, HasRatioMean, Means, RatioMoments, Spread};
use crate::moments::save;
use crate::planted::planted;
use crate::spectrum::Spectrum;

/// A number that each draw yields, per channel.
///
/// *Implemented by* [`IntegrandOf`] and [`RatioOf`]; *called by* [`UnivariateBlock`].
pub trait Quantity: Copy + core::fmt::Debug {
    /// The channels.
    type Lanes: Lanes;
    /// What it is computed from.
    type Draw: Copy;
    /// Its parameters in one channel.
    type Channel: Copy;
    /// The number.
    fn of(&self, draw: &Self::Draw) -> Self::Lanes;
    /// The parameters of channel `channel`.
    fn channel(&self, channel: usize) -> Self::Channel;
    /// Calls `each` with every parameter: see [`Save`](crate::moments::Save).
    fn words(&mut self, each: &mut dyn FnMut(&mut u64));
}

/// f, of draws with `K` auxiliaries.
#[derive(Clone, Copy, Debug)]
pub struct IntegrandOf<V, const K: usize>(core::marker::PhantomData<V>);

impl<V, const K: usize> Default for IntegrandOf<V, K> {
    fn default() -> Self {
        Self(core::marker::PhantomData)
    }
}

impl<V: Lanes, const K: usize> Quantity for IntegrandOf<V, K> {
    type Lanes = V;
    type Draw = Draw<V, K>;
    type Channel = IntegrandOf<f64, K>;
    #[inline(always)]
    fn of(&self, draw: &Draw<V, K>) -> V {
        draw.f
    }
    fn channel(&self, _: usize) -> IntegrandOf<f64, K> {
        IntegrandOf::default()
    }
    fn words(&mut self, _: &mut dyn FnMut(&mut u64)) {}
}

/// r = f/h′ with h′ = εH + (1−ε)h. Where f = 0 and h′ = 0, r is 0: then r·h′ = f holds, which is all
/// that Hartley–Ross asks of r. Where only h′ = 0, r is infinite, and estimators say so.
#[derive(Clone, Copy, Debug)]
pub struct RatioOf<V> {
    /// ε, the defensive weight.
    weight: f64,
    /// εH.
    floor: V,
}

impl<V: Lanes> Default for RatioOf<V> {
    fn default() -> Self {
        Self { weight: 0.0, floor: V::ZERO }
    }
}

impl<V: Lanes> Quantity for RatioOf<V> {
    type Lanes = V;
    type Draw = Draw<V>;
    type Channel = RatioOf<f64>;
    #[inline(always)]
    fn of(&self, draw: &Draw<V>) -> V {
        let h = self.floor + V::narrow(V::Wide::splat(1.0 - self.weight)) * draw.h[0];
        // h·0 is 0 unless h is infinite: then r is NaN, not a silent 0.
        let ratio = draw.f / h + h * V::ZERO;
        let nothing = planted!("ratio_of_nothing": ratio.except(V::equal(draw.f, V::ZERO)), ratio);
        V::select(V::equal(h, V::ZERO), nothing, ratio)
    }
    fn channel(&self, channel: usize) -> RatioOf<f64> {
        RatioOf { weight: self.weight, floor: self.floor.widen().get(channel) }
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        save::lanes(&mut self.weight, each);
        save::narrow(&mut self.floor, each);
    }
}

/// Mean and, with `S` = 1, sum of squares about it, of a [`Quantity`]: the block kernel.
#[derive(Clone, Copy, Debug)]
pub struct UnivariateBlock<Q: Quantity, const S: usize, L = <Q as Quantity>::Lanes> {
    quantity: Q,
    shift: L,
    sum: L,
    squares: [L; S],
}

/// The state of a [`UnivariateBlock`] stream: parameters, anchor, mean relative to it, squares.
#[derive(Clone, Copy, Debug)]
pub struct UnivariateState<Q, W, const S: usize> {
    quantity: Q,
    anchor: W,
    relative: W,
    squares: [W; S],
}

/// Mean of f alone: plain Monte Carlo without an error bar.
pub type Mean<V, const K: usize = 1> = Blocked<V, UnivariateBlock<IntegrandOf<V, K>, 0>>;

/// Mean and variance of f alone: plain Monte Carlo with an error bar.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Variance}, Draw, Estimator, Integrals, Plain};
/// let mut moments = Variance::<f64, 0>::default();
/// for f in [1.0, 2.0, 4.0, 5.0] {
///     moments.add(Draw { f, h: [] });
/// }
/// let plain = Plain.estimate(&moments, &Integrals::NONE)?;
/// assert_eq!(plain.value, 3.0);
/// assert!((plain.std_error - (10.0_f64 / 3.0 / 4.0).sqrt()).abs() < 1e-15);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
pub type Variance<V, const K: usize = 1> = Blocked<V, UnivariateBlock<IntegrandOf<V, K>, 1>>;

/// Mean of r = f/h, the value tier of the mean of ratios and a part of Hartley–Ross; raw by
/// `Default`, on a defensive auxiliary by [`Blocked::defensive`].
pub type RatioMean<V> = Blocked<V, UnivariateBlock<RatioOf<V>, 0>>;

/// Mean and variance of r = f/h: the mean of ratios with an error bar.
pub type RatioVariance<V> = Blocked<V, UnivariateBlock<RatioOf<V>, 1>>;

impl<V: Lanes, const S: usize> Blocked<V, UnivariateBlock<RatioOf<V>, S>> {
    /// Ratios f/h′ with the defensive auxiliary h′ = εH + (1−ε)h, ε = `weight`.
    ///
    /// # Errors
    /// [`Error::Weight`] unless 0 ≤ `weight` < 1.
    pub fn defensive(weight: f64, integrals: &Integrals<V>) -> Result<Self, Error> {
        Ok(Self::on(weight_in_range(weight)?, integrals))
    }

    /// The same for a weight that is known to be one.
    pub(crate) fn on(weight: f64, integrals: &Integrals<V>) -> Self {
        let floor = V::narrow(V::Wide::splat(weight) * integrals.0[0]);
        Self::with_parameters(UnivariateState { quantity: RatioOf { weight, floor }, ..Default::default() })
    }
}

impl<Q: Default, W: Lanes, const S: usize> Default for UnivariateState<Q, W, S> {
    fn default() -> Self {
        Self { quantity: Q::default(), anchor: W::ZERO, relative: W::ZERO, squares: [W::ZERO; S] }
    }
}

impl<Q: Quantity, const S: usize, L: Lanes> UnivariateBlock<Q, S, L> {
    #[inline(always)]
    fn take(&mut self, x: L) {
        let x = x - self.shift;
        self.sum = self.sum + x;
        for squares in &mut self.squares {
            *squares = *squares + x * x;
        }
    }
    #[inline(always)]
    fn join(&mut self, other: &Self) {
        self.sum = self.sum + other.sum;
        for (squares, other) in self.squares.iter_mut().zip(other.squares) {
            *squares = *squares + other;
        }
    }
    #[inline(always)]
    fn map<U: Lanes>(&self, change: impl Fn(L) -> U) -> UnivariateBlock<Q, S, U> {
        UnivariateBlock {
            quantity: self.quantity,
            shift: change(self.shift),
            sum: change(self.sum),
            squares: filled(U::ZERO, |i| change(self.squares[i])),
        }
    }
}

impl<Q: Quantity, const S: usize> Kernel for UnivariateBlock<Q, S> {
    type State = UnivariateState<Q, <Q::Lanes as Lanes>::Wide, S>;
    const PARTIALS: usize = partials(<Q::Lanes as Lanes>::LANES);
    const LEARNS: bool = false;
    lanes_beside!(UnivariateBlock<Q, S, Spectrum<Q::Lanes, P>>);

    #[inline(always)]
    fn empty(state: &Self::State) -> Self {
        Self { quantity: state.quantity, shift: Q::Lanes::ZERO, sum: Q::Lanes::ZERO, squares: [Q::Lanes::ZERO; S] }
    }
    #[inline(always)]
    fn close(&self, _: &Self::State, count: u64) -> Self::State {
        let count = <Q::Lanes as Lanes>::Wide::splat(count as f64);
        let relative = self.sum.widen() / count;
        let squares = filled(<Q::Lanes as Lanes>::Wide::ZERO, |i| {
            let squares = magnitude(self.squares[i].widen() - relative * relative * count);
            unless_underflowed(squares, squares, relative, smallest_square::<Q::Lanes>())
        });
        UnivariateState { quantity: self.quantity, anchor: self.shift.widen(), relative, squares }
    }
}

impl<Q: Quantity, const S: usize> Takes<Q::Draw> for UnivariateBlock<Q, S> {
    #[inline(always)]
    fn begin(&mut self, index: usize, draw: &Q::Draw) {
        if index == 0 {
            self.shift = self.quantity.of(draw);
        }
    }
    #[inline(always)]
    fn add(&mut self, _: usize, draw: &Q::Draw) {
        self.take(self.quantity.of(draw));
    }
    #[inline(always)]
    fn add_beside<const P: usize>(parts: &mut Self::Beside<P>, _: usize, draws: &[Q::Draw; P]) {
        let mut x = Spectrum([Q::Lanes::ZERO; P]);
        for (x, draw) in x.0.iter_mut().zip(draws) {
            *x = parts.quantity.of(draw);
        }
        parts.take(x);
    }
}

impl<Q: Quantity, W: Lanes<Scalar = f64, Wide = W>, const S: usize> State for UnivariateState<Q, W, S> {
    type Channel = UnivariateState<Q::Channel, f64, S>;

    #[inline(always)]
    fn merge(&mut self, count: u64, later: &Self, later_count: u64) {
        let (large, small, fraction) = larger_first(*self, count, *later, later_count);
        let weight = W::splat(count.max(later_count) as f64 * fraction);
        let apart = (small.anchor - large.anchor) + (small.relative - large.relative);
        let squares = filled(W::ZERO, |i| {
            let joint = large.squares[i] + small.squares[i] + apart * apart * weight;
            unless_underflowed(joint, joint, apart, smallest_square::<W>())
        });
        *self = Self { relative: large.relative + apart * W::splat(fraction), squares, ..large };
    }
    fn channel(&self, channel: usize) -> Self::Channel {
        UnivariateState {
            quantity: self.quantity.channel(channel),
            anchor: self.anchor.get(channel),
            relative: self.relative.get(channel),
            squares: self.squares.map(|squares| squares.get(channel)),
        }
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        self.quantity.words(each);
        save::lanes(&mut self.anchor, each);
        save::lanes(&mut self.relative, each);
        save::all(&mut self.squares, each);
    }
}

impl<const S: usize, const K: usize> HasMeans<K> for UnivariateState<IntegrandOf<f64, K>, f64, S> {
    /// The mean of f; the means of the auxiliaries are unknown (NaN).
    fn means(&self, _: u64) -> Means<K> {
        Means { f: self.anchor + self.relative, h: [f64::NAN; K] }
    }
    fn spread(&self) -> Option<Spread<K>> {
        self.squares.first().map(|ff| Spread::of_integrand(*ff))
    }
}

impl<const S: usize> HasRatioMean for UnivariateState<RatioOf<f64>, f64, S> {
    fn ratio(&self, weight: f64, integral: f64) -> Option<RatioMoments> {
        // The floor was rounded to the draws' precision; f32's is the coarsest.
        let floor = weight * integral;
        let same = self.quantity.weight == weight && (self.quantity.floor - floor).abs() <= 1e-6 * floor.abs();
        // A bad integral is the estimator's to report, not a mismatch.
        (same || !floor.is_finite())
            .then(|| RatioMoments { mean: self.anchor + self.relative, squares: self.squares.first().copied() })
    }
}
