//! What comes out: value, standard error, flags, per channel.

use crate::error::Error;
use crate::flags::Flags;
use crate::lanes::{Lanes, PerLane};
use crate::planted::planted;

/// The estimate of one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelEstimate {
    /// The estimate of F.
    pub value: f64,
    /// Its standard error; NaN where unknown, never negative.
    pub std_error: f64,
    /// Remarks.
    pub flags: Flags,
}

/// An estimate of F = ∫f, element-wise over the channels of `V`.
///
/// `std_error` is NaN wherever it is unknown: moments of the value tier, one draw, overflow.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, Estimator, Flags, Integrals, RatioOfMeans, Spectrum};
/// let mut pixel = Comoments::<Spectrum<f64, 2>>::default();
/// pixel.add(Draw::new(Spectrum([1.0, 1.0]), Spectrum([1.0, 0.0])));
/// pixel.add(Draw::new(Spectrum([2.0, 3.0]), Spectrum([2.0, 0.0])));
/// let estimate = RatioOfMeans.estimate(&pixel, &Integrals::new([Spectrum([1.5, 1.0])]))?;
/// assert_eq!(estimate.value[0], 1.5);
/// assert_eq!((estimate.value[1], estimate.flags(1)), (2.0, Flags::DENOM_ZERO)); // the plain mean
/// assert!(estimate.strict().is_err());
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Estimate<V: Lanes> {
    /// The estimate of F.
    pub value: V::Wide,
    /// Its standard error.
    pub std_error: V::Wide,
    flags: V::PerLane<Flags>,
}

impl<V: Lanes> Estimate<V> {
    /// Puts an estimate together from its channels.
    #[inline]
    pub(crate) fn from_channels(channel: impl FnMut(usize) -> ChannelEstimate) -> Self {
        let channels = V::PerLane::<ChannelEstimate>::from_fn(channel);
        Self {
            value: V::Wide::from_fn(|i| channels.get(i).value),
            std_error: V::Wide::from_fn(|i| channels.get(i).std_error),
            flags: PerLane::from_fn(|i| channels.get(i).flags),
        }
    }

    /// Values without error bars or remarks, if all channels have one.
    #[inline(always)]
    pub(crate) fn of_values(value: impl Fn(usize) -> Option<f64>) -> Option<Self> {
        let mut are_known = true;
        let value = V::Wide::from_fn(|channel| {
            let value = value(channel);
            are_known &= value.is_some();
            value.unwrap_or(f64::NAN)
        });
        are_known.then(|| Self { value, std_error: V::Wide::splat(f64::NAN), flags: PerLane::from_fn(|_| Flags::NONE) })
    }

    /// The flags of channel `channel`; panics if there is no such channel.
    pub fn flags(&self, channel: usize) -> Flags {
        self.flags.get(channel)
    }

    /// Everything about channel `channel`; panics if there is no such channel.
    pub fn channel(&self, channel: usize) -> ChannelEstimate {
        ChannelEstimate {
            value: self.value.get(channel),
            std_error: self.std_error.get(channel),
            flags: self.flags(channel),
        }
    }

    /// The sum of this and an estimate from other, independent draws: values add, errors add in
    /// quadrature, flags unite. An unknown error makes that of the sum unknown.
    ///
    /// For estimates that share draws the values add as well, but not so the errors.
    ///
    /// ```
    /// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, Estimator, Integrals, Plain};
    /// let [mut a, mut b] = [Comoments::<f64>::default(); 2];
    /// for (f, g) in [(1.0, 10.0), (7.0, 18.0)] {
    ///     a.add(Draw::new(f, 1.0));
    ///     b.add(Draw::new(g, 1.0));
    /// }
    /// let [a, b] = [Plain.estimate(&a, &Integrals::ONE)?, Plain.estimate(&b, &Integrals::ONE)?]; // 4 ± 3, 14 ± 4
    /// assert_eq!((a.plus_independent(&b).value, a.plus_independent(&b).std_error), (18.0, 5.0));
    /// # Ok::<(), ratiocv_core::Error>(())
    /// ```
    #[must_use]
    pub fn plus_independent(&self, other: &Self) -> Self {
        Self::from_channels(|channel| {
            let (a, b) = (self.channel(channel), other.channel(channel));
            ChannelEstimate {
                value: a.value + b.value,
                std_error: planted!("quadrature": libm::hypot(a.std_error, b.std_error), a.std_error + b.std_error),
                flags: a.flags | b.flags,
            }
        })
    }

    /// The same estimate with `flags` raised as well, per channel: those of its weights, for example.
    #[must_use]
    pub fn flagged(&self, flags: impl Fn(usize) -> Flags) -> Self {
        Self::from_channels(|i| {
            let channel = self.channel(i);
            ChannelEstimate { flags: channel.flags | flags(i), ..channel }
        })
    }

    /// The same estimate, or an error if any channel raised any flag.
    ///
    /// # Errors
    /// [`Error::Flagged`], with the first such channel.
    pub fn strict(self) -> Result<Self, Error> {
        match (0..V::LANES).find(|channel| !self.flags(*channel).is_empty()) {
            None => Ok(self),
            Some(channel) => Err(Error::Flagged { channel, flags: self.flags(channel) }),
        }
    }
}
