//! What a kernel says of one channel, and the scalar reference that it is compared with.

use ratiocv_core::{Draw, Lanes};

/// Means, and mean squares and products about the means (divided by N), of one channel; `None` is what a
/// kernel does not deliver. Passing over the same draws again changes none of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Answer {
    /// Mean of f.
    pub f: Option<f64>,
    /// Mean of h.
    pub h: Option<f64>,
    /// Variance of f.
    pub ff: Option<f64>,
    /// Covariance of f and h.
    pub fh: Option<f64>,
    /// Variance of h.
    pub hh: Option<f64>,
    /// Mean of f/h.
    pub r: Option<f64>,
    /// Variance of f/h.
    pub rr: Option<f64>,
}

impl Answer {
    /// The five co-moments.
    pub(crate) fn comoments([f, h, ff, fh, hh]: [f64; 5]) -> Self {
        Self { f: Some(f), h: Some(h), ff: Some(ff), fh: Some(fh), hh: Some(hh), ..Self::default() }
    }

    /// From the plain sums of f, h, f², fh and h² over `count` draws, each relative to `shift` of f and h.
    pub(crate) fn from_sums(sums: [f64; 5], shift: [f64; 2], count: f64) -> Self {
        let [f, h, ff, fh, hh] = sums.map(|sum| sum / count);
        Self::comoments([shift[0] + f, shift[1] + h, ff - f * f, fh - f * h, hh - h * h])
    }

    /// The reference: two passes in `f64`, channel by channel.
    pub(crate) fn reference<V: Lanes>(draws: &[Draw<V>]) -> Vec<Self> {
        let count = draws.len() as f64;
        let channel = |channel| {
            let draws: Vec<(f64, f64)> =
                draws.iter().map(Draw::widen).map(|draw| (draw.f.get(channel), draw.h[0].get(channel))).collect();
            let mean = |of: &dyn Fn(f64, f64) -> f64| draws.iter().map(|(f, h)| of(*f, *h)).sum::<f64>() / count;
            let (f, h, r) = (mean(&|f, _| f), mean(&|_, h| h), mean(&|f, h| f / h));
            Self {
                ff: Some(mean(&|y, _| (y - f) * (y - f))),
                fh: Some(mean(&|y, x| (y - f) * (x - h))),
                hh: Some(mean(&|_, x| (x - h) * (x - h))),
                rr: Some(mean(&|y, x| (y / x - r) * (y / x - r))),
                f: Some(f),
                h: Some(h),
                r: Some(r),
            }
        };
        (0..V::LANES).map(channel).collect()
    }

    /// Panics unless `self` says something, and nothing that is further than `tolerance` of its scale from
    /// the `right` one.
    pub(crate) fn check(&self, right: &Self, tolerance: f64, what: &str) {
        let root = |x: Option<f64>| x.map(f64::sqrt).unwrap_or_default();
        let product = root(right.ff) * root(right.hh);
        // f/h itself is rounded: a deviation from its mean is off by a fraction of f/h, not of the deviation.
        let rounded = root(right.rr) * (right.r.unwrap_or_default().abs() + root(right.rr));
        let fields = [
            ("mean of f", self.f, right.f, right.f),
            ("mean of h", self.h, right.h, right.h),
            ("variance of f", self.ff, right.ff, right.ff),
            ("covariance", self.fh, right.fh, Some(product)),
            ("variance of h", self.hh, right.hh, right.hh),
            ("mean of f/h", self.r, right.r, right.r),
            ("variance of f/h", self.rr, right.rr, Some(rounded)),
        ];
        assert!(*self != Self::default(), "{what} says nothing");
        for (name, got, want, scale) in fields {
            let (Some(got), Some(want), Some(scale)) = (got, want, scale) else { continue };
            let error = (got - want).abs();
            assert!(
                error <= tolerance * scale.abs(),
                "{what}: {name} is {got}, not {want} (off by {:.1e} of its scale, {tolerance:.1e} allowed)",
                error / scale.abs()
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reference_is_right_on_three_draws() {
        let draws = [(1.0, 2.0), (2.0, 1.0), (6.0, 3.0)].map(|(f, h)| Draw::new(f, h));
        let [answer] = Answer::reference::<f64>(&draws)[..] else { panic!("one channel") };
        let right =
            Answer { r: Some(1.5), rr: Some(0.5), ..Answer::comoments([3.0, 2.0, 14.0 / 3.0, 4.0 / 3.0, 2.0 / 3.0]) };
        answer.check(&right, 1e-15, "reference");
    }

    #[test]
    #[should_panic(expected = "covariance")]
    fn a_wrong_covariance_is_seen() {
        let right = Answer::comoments([3.0, 2.0, 5.0, 1.0, 2.0]);
        Answer { fh: Some(-1.0), ..right }.check(&right, 1e-5, "wrong");
    }

    #[test]
    #[should_panic(expected = "mean of h is NaN")]
    fn nan_is_not_right() {
        let right = Answer::comoments([3.0, 2.0, 5.0, 1.0, 2.0]);
        Answer { h: Some(f64::NAN), ..right }.check(&right, 1e-5, "wrong");
    }

    #[test]
    #[should_panic(expected = "says nothing")]
    fn silence_is_not_right() {
        Answer::default().check(&Answer::comoments([3.0, 2.0, 5.0, 1.0, 2.0]), 1e-5, "wrong");
    }
}
