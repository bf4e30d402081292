//! Estimators with coefficients, and coefficients that come from elsewhere than the draws.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::{Coefficients, Estimator, Sample};
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::{HasMeans, Moments};

/// An estimator with one coefficient per auxiliary.
///
/// *Implemented by* [`Difference`](crate::Difference), [`RegressionRatio`](crate::RegressionRatio),
/// mixtures and [`Choose`](crate::Choose); *called by* [`Fixed`] and [`CrossFitted`](crate::CrossFitted).
pub trait WithCoefficients<S, const K: usize = 1> {
    /// The estimate with these coefficients.
    fn estimate_with(
        &self,
        sample: &Sample<'_, S>,
        integrals: &[f64; K],
        coefficients: &Coefficients<K>,
    ) -> ChannelEstimate;
}

/// An estimator that can learn its coefficients from draws.
///
/// *Implemented by* those of [`WithCoefficients`]; *called by* themselves, on their own draws, and by
/// whoever learns from a pilot, from another fold, or from the merged moments of a neighbourhood.
pub trait Fit<S, const K: usize = 1>: WithCoefficients<S, K> {
    /// The coefficients that the moments suggest.
    fn fit(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> Coefficients<K>;

    /// This estimator with the coefficients that `moments`, of other draws, suggest.
    ///
    /// ```
    /// use ratiocv_core::{moments::{Accumulate, Comoments, Merge}, Draw, Estimator, Fit, Integrals, RegressionRatio};
    /// let mut pixels = [Comoments::<f64>::default(); 3];
    /// for (i, pixel) in pixels.iter_mut().enumerate() {
    ///     for j in 0..8 {
    ///         let h = f64::from((3 * j + i as i32) % 8) / 3.5;
    ///         pixel.add(Draw::new(1.0 + 0.5 * h, h));
    ///     }
    /// }
    /// let mut neighbourhood = pixels[0];
    /// neighbourhood.merge(&pixels[2]);
    /// // What the neighbours say about α serves the pixel between them, which has few draws.
    /// let learned = RegressionRatio::default().learn(&neighbourhood, &Integrals::ONE);
    /// let estimate = learned.estimate(&pixels[1], &Integrals::ONE)?;
    /// assert!((estimate.value - 1.5).abs() < 1e-3);
    /// # Ok::<(), ratiocv_core::Error>(())
    /// ```
    fn learn<M>(self, moments: &M, integrals: &Integrals<M::Lanes, K>) -> Fixed<Self, <M::Lanes as Lanes>::Wide, K>
    where
        Self: Sized,
        M: Moments<Channel = S>,
    {
        let closed = moments.closed();
        let mut fitted = [<M::Lanes as Lanes>::Wide::ZERO; K];
        for (k, lanes) in fitted.iter_mut().enumerate() {
            *lanes = Lanes::from_fn(|channel| {
                super::of_channel(&closed, channel, |sample| self.fit(sample, &integrals.channel(channel)).values[k])
            });
        }
        Fixed { estimator: self, coefficients: fitted }
    }
}

/// `E` with coefficients that do not depend on the draws: given, or learned from others.
///
/// `coefficients[k]` holds that of auxiliary k, a lane per channel; a single lane (`f64`) serves all
/// channels. Needs 1 draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fixed<E, W, const K: usize = 1> {
    pub(super) estimator: E,
    /// The coefficients.
    pub coefficients: [W; K],
}

impl<E, W: Lanes<Scalar = f64>, const K: usize> Fixed<E, W, K> {
    fn of_channel(&self, channel: usize) -> Coefficients<K> {
        let lane = if W::LANES == 1 { 0 } else { channel };
        Coefficients::given(self.coefficients.map(|lanes| lanes.get(lane)))
    }
}

impl<S, E, W, const K: usize> Estimator<S, K> for Fixed<E, W, K>
where
    S: HasMeans<K>,
    E: WithCoefficients<S, K>,
    W: Lanes<Scalar = f64>,
{
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; K]) -> Result<(), Error> {
        if sample.count >= 1 {
            return Ok(());
        }
        Err(Error::TooFewDraws { estimator: "an estimator with given coefficients", needed: 1, got: 0 })
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> ChannelEstimate {
        self.estimator.estimate_with(sample, integrals, &self.of_channel(sample.channel))
    }
}

/// An estimator of type `$estimator` that fits its coefficients to the draws it is applied to: its
/// moments, itself and its cross-fitted form.
macro_rules! fits_its_own_draws {
    ($estimator:ty, $id:expr, $defensive:literal, $cross_fitted:literal, block $block:ty, S: $($capability:tt)+) => {
        impl<const K: usize> crate::estimator::Reads<K> for $estimator {
            const ID: &'static str = $id;
            const DEFENSIVE_ID: &'static str = $defensive;
            const MIN_DRAWS: u64 = 2;
            type Value<V: crate::Lanes> = crate::moments::Blocked<V, $block>;
            type ErrorBar<V: crate::Lanes> = crate::moments::Blocked<V, $block>;
            fn value_on<V: crate::Lanes>(&self, _: f64, _: &crate::Integrals<V, K>) -> Self::Value<V> {
                Default::default()
            }
            fn error_bar_on<V: crate::Lanes>(&self, _: f64, _: &crate::Integrals<V, K>) -> Self::ErrorBar<V> {
                Default::default()
            }
        }

        impl<S: $($capability)+, const K: usize> crate::estimator::Estimator<S, K> for $estimator {
            fn check(&self, sample: &crate::estimator::Sample<'_, S>, _: &[f64; K]) -> Result<(), crate::Error> {
                crate::estimator::enough_draws::<Self, K>(sample.count)
            }
            fn estimate_channel(
                &self,
                sample: &crate::estimator::Sample<'_, S>,
                integrals: &[f64; K],
            ) -> crate::ChannelEstimate {
                let coefficients = crate::estimator::Fit::fit(self, sample, integrals);
                crate::estimator::WithCoefficients::estimate_with(self, sample, integrals, &coefficients)
            }
        }

        impl<const K: usize> crate::estimator::Reads<K> for crate::estimator::CrossFitted<$estimator> {
            const ID: &'static str = $cross_fitted;
            const DEFENSIVE_ID: &'static str = $cross_fitted;
            const MIN_DRAWS: u64 = 2;
            type Value<V: crate::Lanes> = crate::moments::Blocked<V, crate::moments::FoldsBlock<$block>>;
            type ErrorBar<V: crate::Lanes> = crate::moments::Blocked<V, crate::moments::FoldsBlock<$block>>;
            fn value_on<V: crate::Lanes>(&self, _: f64, _: &crate::Integrals<V, K>) -> Self::Value<V> {
                Default::default()
            }
            fn error_bar_on<V: crate::Lanes>(&self, _: f64, _: &crate::Integrals<V, K>) -> Self::ErrorBar<V> {
                Default::default()
            }
        }
    };
}
pub(super) use fits_its_own_draws;
