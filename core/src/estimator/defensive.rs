//! Any estimator on the defensive auxiliary.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::combined::mixed_twice;
use crate::estimator::{Combined, Estimator, Reads, Sample};
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::Means;
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
    E: for<'a> Estimator<Combined<'a, S>>,
{
    fn check(&self, sample: &Sample<'_, S>, integrals: &[f64; 1]) -> Result<(), Error> {
        self.on_defended(sample, integrals, |sample| self.estimator.check(sample, integrals))
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, integrals: &[f64; 1]) -> ChannelEstimate {
        self.on_defended(sample, integrals, |sample| self.estimator.estimate_channel(sample, integrals))
    }
    #[inline(always)]
    fn of_means_alone(&self, &Means { f, h }: &Means, integrals: &[f64; 1]) -> Option<f64> {
        let defended = Means { f, h: [Combined::defensive(&(), self.weight, self.constant(integrals)).mean(&h)] };
        self.estimator.of_means_alone(&defended, integrals)
    }
}

impl<E> Defensive<E> {
    /// εH.
    #[inline(always)]
    fn constant(&self, &[integral]: &[f64; 1]) -> f64 {
        planted!("defensive_integral": self.weight * integral, self.weight)
    }

    #[inline]
    fn on_defended<S, T>(
        &self,
        sample: &Sample<'_, S>,
        integrals: &[f64; 1],
        read: impl FnOnce(&Sample<'_, Combined<'_, S>>) -> T,
    ) -> T {
        read(&sample.of(&Combined::defensive(sample.moments, self.weight, self.constant(integrals))))
    }
}
