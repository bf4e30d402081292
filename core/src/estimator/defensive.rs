//! Any estimator on the defensive auxiliary.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::{Estimator, Reads, Sample};
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::{Group, HasComoments, HasGroups, HasMeans, HasRatioMean, Means, RatioMoments, Spread, Tails};
use crate::planted::planted;

/// `E` on h′ = εH + (1−ε)h, which has the same integral H and keeps away from 0.
///
/// y/x′ ≤ y/(εH): the estimator stays as consistent, and Hartley–Ross and Mickey as unbiased, as
/// before, and no draw can make the ratio explode. Made by [`Reads::defensive`]; the usual weight is
/// 0.01. Where everything is linear in h it costs nothing per draw: the moments of h′ are formed
/// from those of h when the estimate is made. Only f/h′ must be accumulated as such, by the moments
/// that the estimator names.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Moments}, Draw, Estimator, HartleyRoss, Integrals, Reads};
/// let estimator = HartleyRoss.defensive(0.01)?;
/// let mut moments = estimator.error_bar::<f64>(&Integrals::ONE);
/// for (f, h) in [(1.0, 1.1), (1.0, 0.9), (0.5, 0.0)] {
///     moments.add(Draw::new(f, h)); // the last would make f/h infinite
/// }
/// assert!(estimator.estimate(&moments, &Integrals::ONE)?.value.is_finite());
/// assert!(HartleyRoss.estimate(&moments, &Integrals::ONE).is_err()); // made for h′, not for h
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Defensive<E> {
    pub(crate) estimator: E,
    pub(crate) weight: f64,
}

impl<E> Defensive<E> {
    /// The weight that the authors of the method use: h′ = 0.01 + 0.99h for H = 1.
    pub const DEFAULT_WEIGHT: f64 = 0.01;

    /// ε.
    pub const fn weight(&self) -> f64 {
        self.weight
    }
}

impl<E: Reads> Reads for Defensive<E> {
    const ID: &'static str = E::DEFENSIVE_ID;
    const DEFENSIVE_ID: &'static str = E::DEFENSIVE_ID;
    const MIN_DRAWS: u64 = E::MIN_DRAWS;
    type Value<V: Lanes> = E::Value<V>;
    type ErrorBar<V: Lanes> = E::ErrorBar<V>;
    fn value_on<V: Lanes>(&self, weight: f64, integrals: &Integrals<V>) -> E::Value<V> {
        self.estimator.value_on(mixed_twice(self.weight, weight), integrals)
    }
    fn error_bar_on<V: Lanes>(&self, weight: f64, integrals: &Integrals<V>) -> E::ErrorBar<V> {
        self.estimator.error_bar_on(mixed_twice(self.weight, weight), integrals)
    }
}

impl<S, E> Estimator<S> for Defensive<E>
where
    E: for<'a> Estimator<Mixed<'a, S>>,
{
    fn check(&self, sample: &Sample<'_, S>, integrals: &[f64; 1]) -> Result<(), Error> {
        self.on_mixed(sample, integrals, |sample| self.estimator.check(sample, integrals))
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, integrals: &[f64; 1]) -> ChannelEstimate {
        self.on_mixed(sample, integrals, |sample| self.estimator.estimate_channel(sample, integrals))
    }
}

impl<E> Defensive<E> {
    #[inline]
    fn on_mixed<S, T>(
        &self,
        sample: &Sample<'_, S>,
        &[integral]: &[f64; 1],
        read: impl FnOnce(&Sample<'_, Mixed<'_, S>>) -> T,
    ) -> T {
        let moments = Mixed { moments: sample.moments, weight: self.weight, integral };
        read(&Sample { count: sample.count, epsilon: sample.epsilon, moments: &moments })
    }
}

/// The weight of H in an auxiliary that is mixed with it twice.
fn mixed_twice(first: f64, second: f64) -> f64 {
    first + second - first * second
}

/// The moments of (f, h′), seen through those of (f, h).
#[derive(Clone, Copy, Debug)]
pub struct Mixed<'a, S> {
    moments: &'a S,
    weight: f64,
    integral: f64,
}

impl<S> Mixed<'_, S> {
    /// A mean of h′.
    fn mean(&self, h: f64) -> f64 {
        planted!("defensive_integral": self.weight * self.integral, self.weight) + (1.0 - self.weight) * h
    }

    /// Spreads of h′: x′ moves (1−ε) times as far as x.
    fn spread_of(&self, spread: Spread) -> Spread {
        let scale = 1.0 - self.weight;
        Spread { slope: spread.slope / scale, ee: spread.ee, eh: spread.eh * scale, hh: spread.hh * scale * scale }
    }
}

impl<S: HasMeans> HasMeans for Mixed<'_, S> {
    fn means(&self, count: u64) -> Means {
        let Means { f, h: [h] } = self.moments.means(count);
        Means { f, h: [self.mean(h)] }
    }
    fn spread(&self) -> Option<Spread> {
        self.moments.spread().map(|spread| self.spread_of(spread))
    }
    /// As of h: the condition of the defended sum is no worse.
    fn tails(&self) -> Option<Tails> {
        self.moments.tails().map(|tails| Tails {
            abs_h: (1.0 - self.weight) * tails.abs_h,
            nothing: 0,
            unbounded: 0,
            ..tails
        })
    }
}

impl<S: HasComoments> HasComoments for Mixed<'_, S> {
    fn comoments(&self) -> Spread {
        self.spread_of(self.moments.comoments())
    }
}

impl<S: HasRatioMean> HasRatioMean for Mixed<'_, S> {
    fn ratio(&self, weight: f64, integral: f64) -> Option<RatioMoments> {
        self.moments.ratio(mixed_twice(self.weight, weight), integral)
    }
}

impl<S: HasGroups> HasGroups for Mixed<'_, S> {
    fn groups(&self) -> usize {
        self.moments.groups()
    }
    fn group(&self, count: u64, group: usize) -> Group {
        let group = self.moments.group(count, group);
        Group { h: self.mean(group.h), ..group }
    }
}
