//! Sums of paths whose products are out of range.

use crate::estimate::{ChannelEstimate, Estimate};
use crate::flags::Flags;
use crate::lanes::{Lanes, PerLane};
use crate::moments::{Accumulate, Merge};
use crate::path_space::PathProduct;
use crate::planted::planted;
use crate::scaled::Scaled;

/// Σf, Σh and Σh² of paths, with an exponent per channel: the ratio of means where the products
/// themselves leave the range of `f64`, f = 3h with h near 10⁻⁴⁰⁰ for example.
///
/// A value without an error bar, for deep paths. The sums are plain ones, in order: N draws of one
/// sign cost N·2⁻⁵³ at worst, relatively; merging an empty accumulator, on either side, changes no bit.
///
/// ```
/// use ratiocv_core::{moments::Accumulate, Draw, Integrals, PathProduct, ScaledSums};
/// let mut sums = ScaledSums::<f32>::default();
/// for x in [0.1_f32, 0.2, 0.4] {
///     let mut path = PathProduct::default();
///     for _ in 0..1000 {
///         path.extend(Draw::new(x, x), &Integrals::ONE);
///     }
///     path.extend(Draw::new(3.0, 1.0), &Integrals::ONE);
///     assert_eq!(path.draw().f, 0.0); // 3e-1000, and so on
///     sums.add(path);
/// }
/// assert_eq!(sums.ratio_of_means().value, 3.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ScaledSums<V: Lanes> {
    count: u64,
    sums: V::PerLane<PathSums>,
}

/// The sums of one channel.
#[derive(Clone, Copy, Debug)]
struct PathSums {
    f: Scaled,
    h: Scaled,
    hh: Scaled,
}

impl PathSums {
    fn plus(self, other: Self) -> Self {
        Self { f: self.f + other.f, h: self.h + other.h, hh: self.hh + other.hh }
    }

    /// Σf/Σh, of `count` > 0 draws.
    fn ratio_of_means(self, count: u64) -> ChannelEstimate {
        let n = count as f64;
        let plain = (self.f / Scaled::new(n)).value();
        let ratio = (self.f / self.h).value();
        let zero = self.h.is_zero();
        let value = if zero || !self.h.is_finite() || ratio.is_infinite() { plain } else { ratio };
        let nonfinite = !zero && (!ratio.is_finite() || !self.h.is_finite());
        let ess = (self.h * self.h / self.hh).value();
        let low = !zero && ess < planted!("path_ess": (n / 10.0).min(100.0), 0.0);
        ChannelEstimate {
            value: if value.is_finite() { value + 0.0 } else { f64::NAN }, // −0 becomes 0
            std_error: f64::NAN,
            flags: Flags::when(count == 1, Flags::ONE_SAMPLE)
                | Flags::when(nonfinite || !value.is_finite(), Flags::NONFINITE)
                | Flags::when(zero && self.f.is_zero(), Flags::NO_SUPPORT)
                | Flags::when(zero && !self.f.is_zero(), Flags::DENOM_ZERO)
                | Flags::when(low, Flags::LOW_ESS)
                | Flags::when(value < 0.0 && plain >= 0.0, Flags::NEGATIVE),
        }
    }
}

impl<V: Lanes> ScaledSums<V> {
    /// Σf/Σh per channel, which estimates F since h has the integral 1; consistent, with the bias of
    /// [`RatioOfMeans`](crate::RatioOfMeans).
    ///
    /// The error is unknown (NaN). No draw gives NaN and EMPTY, one draw f/h and ONE_SAMPLE. Σh = 0, a
    /// draw that is not finite, or a result beyond `f64` give the plain mean, and a plain mean beyond
    /// `f64` gives NaN, with DENOM_ZERO, NO_SUPPORT or NONFINITE as in all estimators. LOW_ESS if
    /// (Σh)²/Σh² is below min(100, N/10).
    pub fn ratio_of_means(&self) -> Estimate<V> {
        Estimate::from_channels(|channel| match self.count {
            0 => ChannelEstimate { value: f64::NAN, std_error: f64::NAN, flags: Flags::EMPTY },
            count => self.sums.get(channel).ratio_of_means(count),
        })
    }

    /// The number of paths so far.
    pub fn count(&self) -> u64 {
        self.count
    }
}

impl<V: Lanes> Default for ScaledSums<V> {
    fn default() -> Self {
        let nothing = PathSums { f: Scaled::ZERO, h: Scaled::ZERO, hh: Scaled::ZERO };
        Self { count: 0, sums: PerLane::from_fn(|_| nothing) }
    }
}

impl<V: Lanes> Accumulate<PathProduct<V>> for ScaledSums<V> {
    fn add(&mut self, path: PathProduct<V>) {
        self.count += 1;
        self.sums = PerLane::from_fn(|i| {
            let (f, h) = path.channel(i);
            self.sums.get(i).plus(PathSums { f, h, hh: h * h })
        });
    }
    fn add_batch(&mut self, paths: &[PathProduct<V>]) {
        for path in paths {
            self.add(*path);
        }
    }
}

impl<V: Lanes> Merge for ScaledSums<V> {
    fn merge(&mut self, later: &Self) {
        self.count += later.count;
        self.sums = PerLane::from_fn(|i| self.sums.get(i).plus(later.sums.get(i)));
    }
}
