//! One channel at a time, chosen at random: Estimator 3 of the supplement.

use crate::lanes::Lanes;
use crate::planted::planted;
use crate::problem::Proposal;
use crate::sampling::Discrete;
use rand_core::Rng;

/// Chooses a channel k with probability p_k, then X ~ g_k. A point is (k, X), its pdf p_k·g_k(X).
///
/// The integrand is f_k(X) in channel k and 0 in the others ([`in_channel`]): unbiased, with variance
/// (∫f_j²/(p_j g_j) − F_j²)/N in channel j. The total is least where p_k·g_k ∝ |f_k| (supplement,
/// Lemma 4): g_k ∝ |f_k| and p_k ∝ ∫|f_k|; it is then still no less than that of vector-valued
/// importance sampling at its best (Lemma 5), so this is for channels that are dear to evaluate. A
/// channel that is never chosen is 0 with NO_SUPPORT. All N draws count for every channel.
///
/// ```
/// use rand_core::SeedableRng;
/// use ratiocv_core::sampling::{Discrete, PiecewiseConstant, RandomMixture, in_channel};
/// use ratiocv_core::{Plain, Problem, Spectrum};
/// let f = |channel: usize, x: f64| [6.0 * x * x, 1.0 - x][channel];
/// let g = [PiecewiseConstant::new(&[1.0, 3.0])?, PiecewiseConstant::new(&[3.0, 1.0])?];
/// let problem = Problem::new(|(k, x): &(usize, f64)| in_channel::<Spectrum<f64, 2>>(*k, f(*k, *x)))
///     .proposal(RandomMixture::new(Discrete::new(&[2.0, 0.5])?, g));
/// let estimate = problem.integrate(&Plain, 1000, &mut rand_pcg::Pcg64::seed_from_u64(1))?;
/// assert!((estimate.value[0] - 2.0).abs() < 5.0 * estimate.std_error[0]);
/// assert!((estimate.value[1] - 0.5).abs() < 5.0 * estimate.std_error[1]);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RandomMixture<P, const K: usize> {
    choice: Discrete<K>,
    proposals: [P; K],
}

impl<P, const K: usize> RandomMixture<P, K> {
    /// Channel k is chosen by `choice`, and then a point by `proposals[k]`.
    pub const fn new(choice: Discrete<K>, proposals: [P; K]) -> Self {
        Self { choice, proposals }
    }
}

impl<P: Proposal, const K: usize> Proposal for RandomMixture<P, K> {
    type Point = (usize, P::Point);
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> (usize, P::Point) {
        let channel = self.choice.sample(rng);
        (channel, self.proposals[channel].sample(rng))
    }
    #[inline]
    fn pdf(&self, (channel, x): &(usize, P::Point)) -> f64 {
        let conditional = self.proposals.get(*channel).map_or(0.0, |proposal| proposal.pdf(x));
        planted!("mixture_choice": self.choice.pdf(channel), 1.0) * conditional
    }
}

/// `value` in channel `channel` and 0 in the others; 0 everywhere if there is no such channel.
///
/// A renderer that chose channel k itself adds `Draw { f: in_channel(k, f_k / (p_k * pdf)), h: [] }`.
///
/// ```
/// use ratiocv_core::{sampling::in_channel, Spectrum};
/// assert_eq!(in_channel::<Spectrum<f32, 3>>(1, 0.5), Spectrum([0.0, 0.5, 0.0]));
/// assert_eq!(in_channel::<Spectrum<f32, 3>>(3, 0.5), Spectrum([0.0; 3]));
/// ```
#[inline]
pub fn in_channel<V: Lanes>(channel: usize, value: V::Scalar) -> V {
    V::from_fn(|lane| if lane == channel { value } else { V::Scalar::ZERO })
}
