//! Known integrals that are not quite known.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::{Estimator, Sample};
use crate::lanes::Lanes;
use crate::moments::{Group, HasComoments, HasGroups, HasMeans, HasRatioMean, Means, RatioMoments, Spread, Tails};
use crate::planted::planted;

/// `E` with integrals Ĥ_k that were estimated themselves, from other draws, with standard errors.
///
/// For Ĥ from N₂ cheap draws of h alone, N·MSE/F² of a ratio grows by (N/N₂)·C20, and the best α falls
/// to C11/(C20(1 + N/N₂)). Both come out of one thing: x̄ − Ĥ has the variance Var(x̄) + Var(Ĥ), so `E`
/// is shown co-moments in which every auxiliary varies by that much more, by itself. Error bars grow by
/// c²·Var(Ĥ), fitted coefficients shrink as a ridge regression does, and AUX_MISMATCH allows for it.
///
/// `std_errors[k]` holds those of Ĥ_k, a lane per channel or one for all; 0 changes nothing, to the bit.
/// `E` must take its error bar and its coefficients from co-moments (not [`Jackknife`](crate::Jackknife)).
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, EstimatedIntegrals, Estimator, Integrals, RatioOfMeans};
/// let mut moments = Comoments::<f64>::default();
/// for h in [0.5, 1.0, 1.5] {
///     moments.add(Draw::new(2.0 * h, h)); // the ratio itself has no error
/// }
/// let estimator = EstimatedIntegrals { estimator: RatioOfMeans, std_errors: [0.05] };
/// let estimate = estimator.estimate(&moments, &Integrals::new([1.1]))?;
/// assert!((estimate.value - 2.2).abs() < 1e-12 && (estimate.std_error - 2.0 * 0.05).abs() < 1e-12);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EstimatedIntegrals<E, W, const K: usize = 1> {
    /// The estimator.
    pub estimator: E,
    /// The standard error of each integral.
    pub std_errors: [W; K],
}

/// Moments in which the means of the auxiliaries are less certain than their draws say.
#[derive(Clone, Copy, Debug)]
pub struct Uncertain<'a, S, const K: usize = 1> {
    moments: &'a S,
    /// What to add to Σ(h_k − h̄_k)².
    more: [f64; K],
}

impl<S: HasComoments<K>, E, W: Lanes<Scalar = f64>, const K: usize> Estimator<S, K> for EstimatedIntegrals<E, W, K>
where
    E: for<'a> Estimator<Uncertain<'a, S, K>, K>,
{
    fn check(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> Result<(), Error> {
        self.estimator.check(&sample.of(&self.uncertain(sample)), integrals)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> ChannelEstimate {
        self.estimator.estimate_channel(&sample.of(&self.uncertain(sample)), integrals)
    }
}

impl<E, W: Lanes<Scalar = f64>, const K: usize> EstimatedIntegrals<E, W, K> {
    fn uncertain<'a, S>(&self, sample: &Sample<'a, S>) -> Uncertain<'a, S, K> {
        let n = sample.count as f64;
        let lane = if W::LANES == 1 { 0 } else { sample.channel };
        // Var(x̄) = Σ(x − x̄)²/(n − 1)/n, and so much more for Var(Ĥ).
        let more = self.std_errors.map(|error| {
            let variance = error.get(lane) * error.get(lane);
            planted!("estimated_integrals": variance * (n - 1.0) * n, variance * (n - 1.0))
        });
        Uncertain { moments: sample.moments, more }
    }
}

impl<S: HasMeans<K>, const K: usize> HasMeans<K> for Uncertain<'_, S, K> {
    fn means(&self, count: u64) -> Means<K> {
        self.moments.means(count)
    }
    fn spread(&self) -> Option<Spread<K>> {
        self.moments.spread().map(|spread| widened(spread, &self.more))
    }
    fn tails(&self) -> Option<Tails> {
        self.moments.tails()
    }
}

impl<S: HasComoments<K>, const K: usize> HasComoments<K> for Uncertain<'_, S, K> {
    fn comoments(&self) -> Spread<K> {
        widened(self.moments.comoments(), &self.more)
    }
}

impl<S: HasGroups<K>, const K: usize> HasGroups<K> for Uncertain<'_, S, K> {
    fn groups(&self) -> usize {
        self.moments.groups()
    }
    fn group(&self, count: u64, group: usize) -> Group<K> {
        self.moments.group(count, group)
    }
}

impl<S: HasRatioMean> HasRatioMean for Uncertain<'_, S> {
    fn ratio(&self, weight: f64, integral: f64) -> Option<RatioMoments> {
        self.moments.ratio(weight, integral)
    }
}

/// `more` is added to each Σ(h_k − h̄_k)²; Σ(f − f̄)² and Σ(f − f̄)(h_k − h̄_k) stay, so that what is
/// added goes into the residuals e = f − slope·h too.
fn widened<const K: usize>(mut spread: Spread<K>, more: &[f64; K]) -> Spread<K> {
    for (k, more) in more.iter().enumerate().filter(|(_, more)| **more != 0.0) {
        let slope = spread.slope[k];
        spread.ee += slope * slope * more;
        spread.eh[k] -= planted!("estimated_slope": slope * more, 0.0);
        spread.hh[k][k] += more;
    }
    spread
}
