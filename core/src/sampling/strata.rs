//! Channels in strata, each with draws of its own: Estimator 2 of the supplement.

use crate::error::Error;
use crate::estimate::{ChannelEstimate, Estimate};
use crate::estimator::{Estimator, Plain};
use crate::flags::Flags;
use crate::integrals::Integrals;
use crate::lanes::{Lanes, PerLane};
use crate::moments::{Moments, Variance};
use crate::planted::planted;
use crate::problem::{Problem, Proposal};
use crate::sampling::{allocate, table};
use rand_core::Rng;

/// Entry-wise stratification: each channel of `V` is in one of `K` strata, and stratum k has N_k
/// draws from its own g_k, evaluated for its own channels alone.
///
/// Unbiased, with variance (∫f_j²/g_k − F_j²)/N_k in channel j of stratum k; since a channel is in one
/// stratum, its error bar is that of its stratum's draws. A stratum at its best has g_k ∝ the L2 norm
/// over its channels (supplement, Lemma 1). Better or worse than vector-valued importance sampling of
/// ΣN_k draws (Lemma 3): the integrand decides.
///
/// ```
/// use rand_core::SeedableRng;
/// use ratiocv_core::sampling::{PiecewiseConstant, Strata};
/// use ratiocv_core::Spectrum;
/// let f = |x: &f64, channel: usize| [6.0 * x * x, 1.0 - x, 5.0 * x][channel];
/// let strata = Strata::<Spectrum<f64, 3>, 2>::new(|channel| if channel == 1 { 1 } else { 0 })?;
/// let g = [PiecewiseConstant::new(&[1.0, 3.0])?, PiecewiseConstant::new(&[3.0, 1.0])?];
/// let draws = strata.neyman(1000, Spectrum([3.0, 0.1, 2.0]))?; // the variances are guesses
/// assert_eq!(draws, [876, 124]);
/// let estimate = strata.integrate(f, &g, &draws, &mut rand_pcg::Pcg64::seed_from_u64(1))?;
/// for (channel, right) in [2.0, 0.5, 2.5].into_iter().enumerate() {
///     assert!((estimate.value[channel] - right).abs() < 5.0 * estimate.std_error[channel]);
/// }
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Strata<V: Lanes, const K: usize> {
    stratum: V::PerLane<usize>,
}

impl<V: Lanes, const K: usize> Strata<V, K> {
    /// Channel j is in stratum `stratum(j)`, of 0..`K`.
    ///
    /// # Errors
    /// [`Error::NoSuchStratum`] if that is not below `K`.
    pub fn new(stratum: impl FnMut(usize) -> usize) -> Result<Self, Error> {
        let strata = Self { stratum: PerLane::from_fn(stratum) };
        match (0..V::LANES).map(|channel| (channel, strata.of(channel))).find(|(_, stratum)| *stratum >= K) {
            None => Ok(strata),
            Some((channel, stratum)) => Err(Error::NoSuchStratum { channel, stratum, strata: K }),
        }
    }

    /// The stratum of channel `channel`; panics if there is no such channel.
    pub fn of(&self, channel: usize) -> usize {
        self.stratum.get(channel)
    }

    /// The channels of stratum `stratum`, in order.
    pub fn channels(&self, stratum: usize) -> impl Iterator<Item = usize> {
        (0..V::LANES).filter(move |channel| self.of(*channel) == stratum)
    }

    /// `f` of the channels of stratum `stratum`, 0 in the others, where it is not called.
    #[inline]
    pub fn value(&self, stratum: usize, mut f: impl FnMut(usize) -> V::Scalar) -> V {
        V::from_fn(|channel| if self.of(channel) == stratum { f(channel) } else { V::Scalar::ZERO })
    }

    /// N_k in proportion to the number of channels, rounded as [`allocate`] does.
    ///
    /// # Errors
    /// [`Error::TooFewForStrata`] if there are fewer draws than strata.
    pub fn proportional(&self, draws: u64) -> Result<[u64; K], Error> {
        allocate(draws, &core::array::from_fn(|stratum| self.channels(stratum).count() as f64))
    }

    /// N_k ∝ √V_k, V_k the sum over the channels of stratum k of `variance`, that of one draw: the
    /// least total variance for the same number of draws (Neyman 1934), rounded as [`allocate`] does.
    /// The variances may come from a pilot, whose own draws then stay out of the estimate.
    ///
    /// # Errors
    /// [`Error::TableEntry`] for a variance that is negative, infinite or NaN, [`Error::TableOfZeros`]
    /// if none is positive, [`Error::TooFewForStrata`] if there are fewer draws than strata.
    pub fn neyman(&self, draws: u64, variance: V::Wide) -> Result<[u64; K], Error> {
        let exponent = table::exponent("variance", (0..V::LANES).map(|channel| variance.get(channel)))?;
        let total =
            |stratum| self.channels(stratum).map(|channel| libm::ldexp(variance.get(channel), -exponent)).sum::<f64>();
        allocate(
            draws,
            &core::array::from_fn(|stratum| planted!("neyman_root": libm::sqrt(total(stratum)), total(stratum))),
        )
    }

    /// The estimate of `estimator`, each channel from the moments `parts[k]` of its own stratum k.
    ///
    /// # Errors
    /// As [`Estimator::estimate`], for the first stratum that has a channel and fails.
    pub fn estimate<M: Moments<Lanes = V>, E: Estimator<M::Channel, A>, const A: usize>(
        &self,
        estimator: &E,
        parts: &[M; K],
        integrals: &Integrals<V, A>,
    ) -> Result<Estimate<V>, Error> {
        let empty = ChannelEstimate { value: f64::NAN, std_error: f64::NAN, flags: Flags::EMPTY };
        let mut estimate = Estimate::from_channels(|_| empty);
        for (stratum, part) in parts.iter().enumerate().filter(|(stratum, _)| self.channels(*stratum).next().is_some())
        {
            let part = estimator.estimate(part, integrals)?;
            let own = |channel| planted!("own_stratum": self.of(channel) == stratum, self.of(channel) <= stratum);
            estimate =
                Estimate::from_channels(
                    |channel| {
                        if own(channel) { part.channel(channel) } else { estimate.channel(channel) }
                    },
                );
        }
        Ok(estimate)
    }

    /// The plain estimate from `draws[k]` draws from `proposals[k]` for each stratum k, one stratum
    /// after the other; `f(x, j)` is channel j of the integrand.
    ///
    /// # Errors
    /// [`Error::TooFewDraws`] if a stratum that has a channel has no draw.
    pub fn integrate<P: Proposal, R: Rng + ?Sized>(
        &self,
        f: impl Fn(&P::Point, usize) -> V::Scalar,
        proposals: &[P; K],
        draws: &[u64; K],
        rng: &mut R,
    ) -> Result<Estimate<V>, Error> {
        let parts: [Variance<V, 0>; K] = core::array::from_fn(|stratum| {
            let mut part = Variance::default();
            Problem::new(|x: &P::Point| self.value(stratum, |channel| f(x, channel)))
                .proposal(&proposals[stratum])
                .accumulate(&mut part, draws[stratum], rng);
            part
        });
        self.estimate(&Plain, &parts, &Integrals::NONE)
    }
}
