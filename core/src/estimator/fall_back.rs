//! The policy of falling back to the plain mean where the denominator is ill-determined.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::{Estimator, Plain, Reads, Sample};
use crate::flags::Flags;
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::HasMeans;

/// `E`, but the plain mean in each channel where `E` raises DENOM_ILL.
///
/// Off unless asked for: the choice depends on the draws, so that an unbiased `E` is no longer.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, Estimator, FallBackWhenIll, Integrals, RatioOfMeans};
/// let mut moments = Comoments::<f64>::default();
/// for (f, h) in [(1.0, 1.0), (1.0, -0.999)] {
///     moments.add(Draw::new(f, h));
/// }
/// let integral = Integrals::new([0.5]);
/// assert!(RatioOfMeans.estimate(&moments, &integral)?.value > 900.0);
/// assert_eq!(FallBackWhenIll(RatioOfMeans).estimate(&moments, &integral)?.value, 1.0);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FallBackWhenIll<E>(pub E);

impl<E: Reads> Reads for FallBackWhenIll<E> {
    const ID: &'static str = E::ID;
    const DEFENSIVE_ID: &'static str = E::DEFENSIVE_ID;
    const MIN_DRAWS: u64 = E::MIN_DRAWS;
    type Value<V: Lanes> = E::Value<V>;
    type ErrorBar<V: Lanes> = E::ErrorBar<V>;
    fn value_on<V: Lanes>(&self, weight: f64, integrals: &Integrals<V>) -> E::Value<V> {
        self.0.value_on(weight, integrals)
    }
    fn error_bar_on<V: Lanes>(&self, weight: f64, integrals: &Integrals<V>) -> E::ErrorBar<V> {
        self.0.error_bar_on(weight, integrals)
    }
}

impl<S: HasMeans, E: Estimator<S>> Estimator<S> for FallBackWhenIll<E> {
    fn check(&self, sample: &Sample<'_, S>, integrals: &[f64; 1]) -> Result<(), Error> {
        self.0.check(sample, integrals)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, integrals: &[f64; 1]) -> ChannelEstimate {
        let estimate = self.0.estimate_channel(sample, integrals);
        if !estimate.flags.contains(Flags::DENOM_ILL) {
            return estimate;
        }
        let plain = Plain.estimate_channel(sample, integrals);
        ChannelEstimate { flags: plain.flags | estimate.flags, ..plain }
    }
}
