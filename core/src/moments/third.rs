//! Third central moments of (f, h): what the 1/N² terms of the predictions are made of.

use crate::draw::Draw;
use crate::lanes::Lanes;
use crate::moments::blocked::Blocked;
use crate::moments::kernel::{Kernel, State, Takes, lanes_beside, larger_first, partials};
use crate::moments::read::{HasThirdMoments, ThirdMoments};
use crate::moments::save;
use crate::spectrum::Spectrum;

/// Third central moments of f and one auxiliary. No estimator reads them; `predict` does.
pub type Third<V> = Blocked<V, ThirdBlock<V>>;

/// The block kernel of [`Third`]: sums of powers about the block's first draw.
#[derive(Clone, Copy, Debug)]
pub struct ThirdBlock<V> {
    shift: Draw<V>,
    sums: Powers<V>,
}

/// Sums, or central moments, of each power product up to the third that holds h.
#[derive(Clone, Copy, Debug)]
struct Powers<V> {
    f: V,
    h: V,
    hh: V,
    hf: V,
    ff: V,
    hhh: V,
    hhf: V,
    hff: V,
}

/// The state of [`Third`].
#[derive(Clone, Copy, Debug)]
pub struct ThirdState<W> {
    anchor: Draw<W>,
    /// Means relative to the anchor, and sums of products about the means.
    central: Powers<W>,
}

impl<V: Lanes> Powers<V> {
    const ZERO: Self = Self {
        f: V::ZERO,
        h: V::ZERO,
        hh: V::ZERO,
        hf: V::ZERO,
        ff: V::ZERO,
        hhh: V::ZERO,
        hhf: V::ZERO,
        hff: V::ZERO,
    };

    #[inline(always)]
    fn zip(self, other: Self, combine: impl Fn(V, V) -> V) -> Self {
        Self {
            f: combine(self.f, other.f),
            h: combine(self.h, other.h),
            hh: combine(self.hh, other.hh),
            hf: combine(self.hf, other.hf),
            ff: combine(self.ff, other.ff),
            hhh: combine(self.hhh, other.hhh),
            hhf: combine(self.hhf, other.hhf),
            hff: combine(self.hff, other.hff),
        }
    }

    #[inline(always)]
    fn map<U>(self, change: impl Fn(V) -> U) -> Powers<U> {
        Powers {
            f: change(self.f),
            h: change(self.h),
            hh: change(self.hh),
            hf: change(self.hf),
            ff: change(self.ff),
            hhh: change(self.hhh),
            hhf: change(self.hhf),
            hff: change(self.hff),
        }
    }
}

impl<W: Lanes> Default for ThirdState<W> {
    fn default() -> Self {
        Self { anchor: Draw::ZERO, central: Powers::ZERO }
    }
}

impl<V: Lanes> ThirdBlock<V> {
    #[inline(always)]
    fn join(&mut self, other: &Self) {
        self.sums = self.sums.zip(other.sums, V::add);
    }
    #[inline(always)]
    fn map<U: Lanes>(&self, change: impl Fn(V) -> U) -> ThirdBlock<U> {
        ThirdBlock { shift: self.shift.map(&change), sums: self.sums.map(change) }
    }
}

impl<V: Lanes> Kernel for ThirdBlock<V> {
    type State = ThirdState<V::Wide>;
    const PARTIALS: usize = partials(V::LANES);
    const LEARNS: bool = false;
    lanes_beside!(ThirdBlock<Spectrum<V, P>>);

    #[inline(always)]
    fn empty(_: &Self::State) -> Self {
        Self { shift: Draw::ZERO, sums: Powers::ZERO }
    }
    /// Moves the sums from the shift to the means: Σ(h − h̄)²(f − f̄) and its kin, expanded.
    #[inline(always)]
    fn close(&self, _: &Self::State, count: u64) -> Self::State {
        let (n, two) = (V::Wide::splat(count as f64), V::Wide::splat(2.0));
        let s = self.sums.map(V::widen);
        let (f, h) = (s.f / n, s.h / n);
        let (hh, hf, ff) = (s.hh - h * h * n, s.hf - h * f * n, s.ff - f * f * n);
        ThirdState {
            anchor: self.shift.map(V::widen),
            central: Powers {
                f,
                h,
                hh,
                hf,
                ff,
                hhh: s.hhh - h * (two * hh + hh + h * h * n),
                hhf: s.hhf - f * hh - h * (two * hf + h * f * n),
                hff: s.hff - h * ff - f * (two * hf + h * f * n),
            },
        }
    }
}

impl<V: Lanes> Takes<Draw<V>> for ThirdBlock<V> {
    #[inline(always)]
    fn begin(&mut self, index: usize, draw: &Draw<V>) {
        if index == 0 {
            self.shift = *draw;
        }
    }
    #[inline(always)]
    fn add(&mut self, _: usize, draw: &Draw<V>) {
        let (f, h) = (draw.f - self.shift.f, draw.h[0] - self.shift.h[0]);
        let (hh, hf, ff) = (h * h, h * f, f * f);
        let powers = Powers { f, h, hh, hf, ff, hhh: hh * h, hhf: hh * f, hff: h * ff };
        self.sums = self.sums.zip(powers, V::add);
    }
    #[inline(always)]
    fn add_beside<const P: usize>(parts: &mut Self::Beside<P>, index: usize, draws: &[Draw<V>; P]) {
        parts.add(index, &Draw::side_by_side(draws));
    }
}

impl<W: Lanes<Scalar = f64>> State for ThirdState<W> {
    type Channel = ThirdState<f64>;

    /// Pairwise update of third moments (Pébay 2008, Eq. 2.1 for p = 3, and its mixed forms).
    #[inline(always)]
    fn merge(&mut self, count: u64, later: &Self, later_count: u64) {
        let (large, small, fraction) = larger_first(*self, count, *later, later_count);
        // Weights of the parts' second moments in the third, of products of the distances in the
        // second, and in the third.
        let (mine, theirs) = (W::splat(fraction), W::splat(1.0 - fraction));
        let second = W::splat(count.max(later_count) as f64 * fraction);
        let third = second * (theirs - mine);
        let (a, b) = (large.central, small.central);
        let f = (small.anchor.f - large.anchor.f) + (b.f - a.f);
        let h = (small.anchor.h[0] - large.anchor.h[0]) + (b.h - a.h);
        self.anchor = large.anchor;
        let across = |a: W, b: W| theirs * b - mine * a;
        let two = W::splat(2.0);
        let sum = a.zip(b, W::add);
        self.central = Powers {
            f: a.f + f * mine,
            h: a.h + h * mine,
            hh: sum.hh + h * h * second,
            hf: sum.hf + h * f * second,
            ff: sum.ff + f * f * second,
            hhh: sum.hhh + h * h * h * third + (two + W::ONE) * h * across(a.hh, b.hh),
            hhf: sum.hhf + h * h * f * third + two * h * across(a.hf, b.hf) + f * across(a.hh, b.hh),
            hff: sum.hff + h * f * f * third + two * f * across(a.hf, b.hf) + h * across(a.ff, b.ff),
        };
    }
    fn channel(&self, channel: usize) -> ThirdState<f64> {
        ThirdState { anchor: self.anchor.channel(channel), central: self.central.map(|lanes| lanes.get(channel)) }
    }
    fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        save::draw(&mut self.anchor, each);
        let Powers { f, h, hh, hf, ff, hhh, hhf, hff } = &mut self.central;
        for sum in [f, h, hh, hf, ff, hhh, hhf, hff] {
            save::lanes(sum, each);
        }
    }
}

impl HasThirdMoments for ThirdState<f64> {
    fn third(&self) -> ThirdMoments {
        ThirdMoments { hhh: self.central.hhh, hhf: self.central.hhf, hff: self.central.hff }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::moments::{Accumulate, Merge, Moments};

    #[test]
    fn asymmetric_draws_match_the_definition_however_they_are_split() {
        let draws: [(f64, f64); 9] = [
            (1.0, 2.0),
            (3.0, 1.0),
            (0.5, 4.0),
            (7.0, 0.25),
            (1.5, 9.0),
            (2.0, 2.0),
            (-3.0, 1.0),
            (4.0, 5.5),
            (0.0, 3.0),
        ];
        let n = draws.len() as f64;
        let (f, h) = draws.iter().fold((0.0, 0.0), |m, d| (m.0 + d.0 / n, m.1 + d.1 / n));
        let exact = |p: i32, q: i32| draws.iter().map(|d| (d.1 - h).powi(p) * (d.0 - f).powi(q)).sum::<f64>();
        for split in 0..=draws.len() {
            let mut parts = [Third::<f64>::default(); 2];
            for (i, d) in draws.iter().enumerate() {
                parts[usize::from(i >= split)].add(Draw::new(d.0, d.1));
            }
            let [mut whole, later] = parts;
            whole.merge(&later);
            let third = whole.channel(0).third();
            for (ours, right) in [(third.hhh, exact(3, 0)), (third.hhf, exact(2, 1)), (third.hff, exact(1, 2))] {
                assert!((ours - right).abs() <= 1e-12 * right.abs(), "split {split}: {ours} for {right}");
            }
        }
    }
}
