//! Some channels of each sample: Estimator 4 of the supplement.

use crate::lanes::{Lanes, Scalar};
use crate::planted::planted;
use crate::problem::{Proposal, unit_interval};
use crate::sampling::discrete::PARTS;
use core::marker::PhantomData;
use rand_core::Rng;

/// X ~ g, and a set of channels, of which channel j is a member with probability a_j(X).
///
/// A point is (X, accepted channels), its pdf g(X). The integrand is f_j·1{accepted_j}/a_j
/// ([`Accepted::value`]), where the supplement's Eq. 4 lacks the indicator: unbiased, with variance
/// (∫f_j²/(g·a_j) − F_j²)/N in channel j, never less than with a_j = 1 (supplement, Lemma 6): for
/// channels that are dear to evaluate where they are small. Rejected samples count as draws, of
/// value 0. a_j(x) must be positive wherever f_j(x) is not 0, as a pdf must.
///
/// ```
/// use rand_core::SeedableRng;
/// use ratiocv_core::sampling::{Accepted, Partial};
/// use ratiocv_core::{Plain, Problem, Spectrum, Uniform};
/// type Pair = Spectrum<f64, 2>;
/// let f = |channel: usize, x: f64| [6.0 * x * x, 1.0 - x][channel];
/// let problem = Problem::new(|(x, accepted): &(f64, Accepted<Pair>)| accepted.value(|channel| f(channel, *x)))
///     .proposal(Partial::new(Uniform, |x: &f64| Spectrum([0.2 + 0.8 * x, 1.0])));
/// let estimate = problem.integrate(&Plain, 1000, &mut rand_pcg::Pcg64::seed_from_u64(1))?;
/// assert!((estimate.value[0] - 2.0).abs() < 5.0 * estimate.std_error[0]);
/// assert!((estimate.value[1] - 0.5).abs() < 5.0 * estimate.std_error[1]);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Partial<V, P, A> {
    proposal: P,
    acceptance: A,
    lanes: PhantomData<fn() -> V>,
}

impl<V: Lanes, P: Proposal, A: Fn(&P::Point) -> V::Wide> Partial<V, P, A> {
    /// Points from `proposal`, accepted for channel j with probability `acceptance(x)`\[j\].
    pub const fn new(proposal: P, acceptance: A) -> Self {
        Self { proposal, acceptance, lanes: PhantomData }
    }
}

impl<V: Lanes, P: Proposal, A: Fn(&P::Point) -> V::Wide> Proposal for Partial<V, P, A> {
    type Point = (P::Point, Accepted<V>);
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Self::Point {
        let x = self.proposal.sample(rng);
        let accepted = Accepted::roll((self.acceptance)(&x), rng);
        (x, accepted)
    }
    /// The density of x; the probabilities of acceptance are in [`Accepted::value`].
    #[inline]
    fn pdf(&self, (x, _): &Self::Point) -> f64 {
        self.proposal.pdf(x)
    }
}

/// The channels for which a sample was accepted, each independently of the others, and with what
/// probability.
///
/// A renderer adds `Draw { f: accepted.value(|channel| …) / pdf, h: [] }`.
///
/// ```
/// use rand_core::SeedableRng;
/// use ratiocv_core::{sampling::Accepted, Spectrum};
/// type Rgb = Spectrum<f32, 3>;
/// let rng = &mut rand_pcg::Pcg64::seed_from_u64(1);
/// let accepted = Accepted::<Rgb>::roll(Spectrum([1.0, 0.0, 0.5]), rng);
/// let rgb = accepted.value(|channel| [0.25, f32::NAN, 4.0][channel]); // called for accepted channels
/// assert_eq!((rgb[0], rgb[1]), (0.25, 0.0));
/// assert_eq!(rgb[2], if accepted.contains(2) { 8.0 } else { 0.0 });
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Accepted<V: Lanes> {
    /// Of accepted channels; 0 for rejected ones, NaN where it is no probability.
    probability: V::Wide,
}

impl<V: Lanes> Accepted<V> {
    /// Accepts channel j with the probability `probability`\[j\], rounded up to a multiple of 2⁻⁵³
    /// so that it is exactly the frequency. Takes one random number per channel, whatever the
    /// probabilities. What is no probability (below 0, above 1, NaN) makes NaN of its channel alone.
    #[inline]
    pub fn roll<R: Rng + ?Sized>(probability: V::Wide, rng: &mut R) -> Self {
        let probability = V::Wide::from_fn(|channel| {
            let (u, probability) = (unit_interval(rng), probability.get(channel));
            if !(0.0..=1.0).contains(&probability) {
                f64::NAN
            } else if u < probability {
                libm::ceil(probability * PARTS) / PARTS
            } else {
                planted!("accepted_indicator": 0.0, probability)
            }
        });
        Self { probability }
    }

    /// Whether channel `channel` is to be evaluated; panics if there is no such channel.
    #[inline]
    pub fn contains(&self, channel: usize) -> bool {
        self.probability.get(channel) > 0.0
    }

    /// f_j/a_j in every accepted channel j, 0 in the others; `f` is called for accepted channels
    /// alone, in order.
    #[inline]
    pub fn value(&self, mut f: impl FnMut(usize) -> V::Scalar) -> V {
        V::from_fn(|channel| {
            let probability = V::Scalar::from_f64(self.probability.get(channel));
            if self.contains(channel) {
                f(channel) / planted!("accepted_probability": probability, V::Scalar::ONE)
            } else {
                probability // 0, or NaN
            }
        })
    }
}
