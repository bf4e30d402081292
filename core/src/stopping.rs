//! When to stop: a rule that may be asked after every draw.

use crate::error::Error;
use crate::estimate::{ChannelEstimate, Estimate};
use crate::flags::Flags;
use crate::lanes::{Lanes, PerLane};
use crate::planted::planted;

/// Stops sampling once the error is small enough, however often it is asked.
///
/// A normal interval of 1.96 standard errors holds at one number of draws, fixed beforehand. Who
/// looks again and again, and stops when it is narrow enough, is misled far more often than one time
/// in twenty. The interval here is F̂ ± radius with Robbins' normal mixture,
///
/// ```text
/// radius = std_error·√((1 + 1/(Nρ²))·(log(1 + Nρ²) − 2 log(α/M)))
/// ```
///
/// for M channels. It holds at all N at once: with probability 1 − α, as far as is promised below, no
/// channel's F is ever outside from the burn-in on. So N may be chosen by looking, by this rule or by
/// any other.
///
/// # Stopping
/// A channel's target is met when |F̂ − F| ≤ max(`absolute`, `relative`·|F|) for every F in the
/// interval: where radius ≤ `absolute`, or radius ≤ `relative`·(|F̂| − radius).
///
/// Never before the burn-in; never where the error is unknown (NaN: no draw, one draw, all draws
/// black, overflow, moments of the value tier); never under a flag that says that the error bar cannot
/// be trusted: NO_SUPPORT, DENOM_ILL, LOW_ESS, HEAVY_TAIL, AUX_MISMATCH. So give loops an upper limit
/// of draws too. An error of exactly 0 (f ∝ h, or a constant) stops at the burn-in, not before.
///
/// # What is promised
/// - Exact for increments that are Gaussian with a known variance, from the first draw on: then
///   (1 + Nρ²)^(−½)·exp(ρ²S²/(2(1 + Nρ²))), S the sum of N standardised increments, is a martingale
///   that starts at 1 and exceeds 1/α with a probability of α at most (Ville 1939; Robbins 1970).
/// - Asymptotic in the burn-in m for everything else: for independent draws with more than two
///   moments, estimated variance, and a radius that is tightest at m log m draws, the probability of
///   ever being wrong from m draws on is at most α in the limit of large m (Waudby-Smith, Arbour,
///   Sinha, Kennedy, Ramdas 2024, *Time-uniform central limit theory and asymptotic confidence
///   sequences*, arXiv 2103.06476, theorem 2.8); for any ρ the radius approaches that of an exact
///   sequence (their definition 2.1). To first order every estimator here but the mean of ratios is
///   the mean of y − c(x − H); what is left falls like log log N/N, faster than the radius.
/// - Together by the union bound, α/M for each of M channels: conservative where channels vary
///   together.
///
/// # What is not
/// - Nothing at a small burn-in with skewed draws, nor where y − cx has no variance. What happens once
///   in 1/p draws has not been seen at the burn-in m with probability (1 − p)^m.
/// - The interval of [`MeanOfRatios`](crate::MeanOfRatios) is one for its own limit, which is not F.
/// - A channel that falls back to the plain mean on the way changes from one sequence to another, and
///   may be wrong with a probability of up to 2α/M.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, Estimator, Integrals, RatioOfMeans, Stopping};
/// let stopping = Stopping { alpha: 0.05, burn_in: 64, tightest: 500, absolute: 0.0, relative: 0.01 };
/// let (mut pixel, mut count) = (Comoments::<f64>::default(), 0);
/// while count < 100_000 {
///     let x = (count as f64 * 0.618_033_988_749_895).fract();
///     pixel.add(Draw::new(x * (1.0 + 0.2 * x), 2.0 * x)); // F = 17/30, H = 1
///     count += 1;
///     let estimate = RatioOfMeans.estimate(&pixel, &Integrals::ONE)?;
///     if stopping.decide(&estimate, count)?.all_met() {
///         assert!((estimate.value - 17.0 / 30.0).abs() < 0.01 * 17.0 / 30.0);
///         break;
///     }
/// }
/// assert!((64..1000).contains(&count));
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stopping {
    /// The probability of error that is allowed, of all channels and all looks together.
    pub alpha: f64,
    /// The number of draws below which there is no look: as many as the normal approximation of a
    /// mean needs, 64 or more.
    pub burn_in: u64,
    /// The number of draws at which the radius is smallest in standard errors (3.04 of them for
    /// α = 0.05 and one channel): as many as you expect to need, at least `burn_in`. It sets ρ.
    pub tightest: u64,
    /// The error that is small enough, in units of F; 0 for none.
    pub absolute: f64,
    /// The error that is small enough as a fraction of |F|; 0 for none.
    pub relative: f64,
}

/// Where each channel stands; made by [`Stopping::decide`].
#[derive(Clone, Copy, Debug)]
pub struct Decision<V: Lanes> {
    /// Half the width of each channel's interval, in units of F; NaN before the burn-in and where the
    /// standard error is unknown.
    pub radius: V::Wide,
    met: V::PerLane<bool>,
}

impl<V: Lanes> Decision<V> {
    /// Whether channel `channel` has met its target; panics if there is no such channel.
    pub fn met(&self, channel: usize) -> bool {
        self.met.get(channel)
    }

    /// Whether all channels have: time to stop.
    pub fn all_met(&self) -> bool {
        (0..V::LANES).all(|channel| self.met(channel))
    }
}

impl Stopping {
    /// Radius and verdict for `estimate` from `count` draws.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless 0 < `alpha` < 1, 1 ≤ `burn_in` ≤ `tightest`, and `absolute` and
    /// `relative` are finite, not negative and not both 0.
    pub fn decide<V: Lanes>(&self, estimate: &Estimate<V>, count: u64) -> Result<Decision<V>, Error> {
        self.check()?;
        let width = if count < self.burn_in { f64::NAN } else { self.width(count, V::LANES) };
        let radius = |channel| width * estimate.std_error.get(channel);
        Ok(Decision {
            radius: V::Wide::from_fn(radius),
            met: PerLane::from_fn(|channel| self.is_met(&estimate.channel(channel), radius(channel))),
        })
    }

    /// The radius in standard errors.
    fn width(&self, count: u64, channels: usize) -> f64 {
        let alpha = self.alpha / planted!("stopping_union": channels as f64, 1.0);
        let spent = planted!("stopping_sides": -2.0, -1.0) * libm::log(alpha);
        // The width is least at Nρ² = u with u = log(1 + u) − 2 log α. Any ρ is valid; one step from
        // u = −2 log α comes within 0.2 % of the least width for all α ≤ ½.
        let best = spent + libm::log1p(spent);
        let time = best * (count as f64 / self.tightest as f64);
        libm::sqrt((1.0 + planted!("stopping_time": 1.0 / time, 0.0)) * (libm::log1p(time) + spent))
    }

    fn is_met(&self, channel: &ChannelEstimate, radius: f64) -> bool {
        let untrusted = [Flags::NO_SUPPORT, Flags::DENOM_ILL, Flags::LOW_ESS, Flags::HEAVY_TAIL, Flags::AUX_MISMATCH];
        let trusted = !untrusted.iter().any(|flag| channel.flags.contains(*flag));
        // The least |F| in the interval, not |F̂|. Comparisons with NaN are false.
        let least = planted!("stopping_relative": channel.value.abs() - radius, channel.value.abs());
        trusted && (radius <= self.absolute || radius <= self.relative * least)
    }

    fn check(&self) -> Result<(), Error> {
        let Self { alpha, burn_in, tightest, absolute, relative } = *self;
        let error = |parameter, got, needed| Err(Error::Parameter { parameter, got, needed });
        let bearable = |x: f64| x.is_finite() && x >= 0.0;
        if !(alpha > 0.0 && alpha < 1.0) {
            error("alpha", alpha, "above 0 and below 1: 0.05 is the usual choice")
        } else if burn_in == 0 {
            error("burn_in", 0.0, "at least 1: 64 draws or more let a mean become normal")
        } else if tightest < burn_in {
            error("tightest", tightest as f64, "at least burn_in: give the number of draws you expect to need")
        } else if !bearable(absolute) {
            error("absolute", absolute, "finite and not negative: give the error you can bear, or 0")
        } else if !bearable(relative) {
            error("relative", relative, "finite and not negative: give the error you can bear over |F|, or 0")
        } else if absolute == 0.0 && relative == 0.0 {
            error("relative", relative, "above 0 where absolute is 0: no error bar falls to 0 by more draws")
        } else {
            Ok(())
        }
    }
}
