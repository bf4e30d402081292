//! The product auxiliary over the vertices of a path.

use crate::draw::Draw;
use crate::integrals::Integrals;
use crate::lanes::{Lanes, PerLane, Scalar};
use crate::planted::planted;
use crate::scaled::Scaled;

/// f = Πf_d and h = Πh_d/H_d(prefix) over the steps d of a path so far: a draw of the joint integral,
/// whose auxiliary has the integral 1 ([`Integrals::ONE`]), with `K` auxiliaries.
///
/// E\[h\] = 1 by the tower rule: given the path up to step d, its factor has the mean 1 (Lu et al.
/// 2025, Eq. 17–20, with H_d at the vertices of the same path; the factors are not independent, as
/// Eq. 21 has it, and need not be). So every estimator of this crate runs on the draws of whole paths
/// unchanged, and keeps its bias and consistency. A ratio *inside* each integral does not: it
/// converges to something else.
///
/// The products keep an exponent per channel, so that no depth over- or underflows on the way;
/// [`draw`](Self::draw) rounds to `V` at the end, to 0 or an infinity where the product itself is out
/// of range ([`ScaledSums`](crate::ScaledSums) add up such paths). Without a step both are 1.
///
/// The variance of h grows with depth: (4/3)^D − 1 after D factors uniform on \[0, 2), so that at
/// D = 50 nearly all weight is in a few paths. Estimators raise LOW_ESS there.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Sums}, Draw, Estimator, Integrals, PathProduct, RatioOfMeans, Spectrum};
/// let mut pixel = Sums::<Spectrum<f32, 2>>::default();
/// for (u, v) in [(0.5_f32, 1.5), (1.5, 0.5), (0.5, 0.5), (1.5, 1.5)] {
///     let mut path = PathProduct::default();
///     // f/pdf and h/pdf of each step, and ∫h over all directions of that step.
///     path.extend(Draw::new(Spectrum([u, 2.0 * u]), Spectrum([u, u])), &Integrals::ONE);
///     path.extend(Draw::new(Spectrum([3.0 * v, v]), Spectrum([v, 4.0 * v])), &Integrals::new([Spectrum([1.0, 4.0])]));
///     pixel.add(path.draw());
/// }
/// assert_eq!(RatioOfMeans.estimate(&pixel, &Integrals::ONE)?.value, Spectrum([3.0, 2.0]));
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PathProduct<V: Lanes, const K: usize = 1> {
    f: V::PerLane<Scaled>,
    h: [V::PerLane<Scaled>; K],
    trivial: V::PerLane<u32>,
}

impl<V: Lanes, const K: usize> Default for PathProduct<V, K> {
    fn default() -> Self {
        let one = V::PerLane::<Scaled>::from_fn(|_| Scaled::ONE);
        Self { f: one, h: [one; K], trivial: PerLane::from_fn(|_| 0) }
    }
}

impl<V: Lanes, const K: usize> PathProduct<V, K> {
    /// Appends a step: f_d and h_d over the pdf of the step, and H_d(prefix), the integral of h_d over
    /// all such steps from the path as it was before.
    ///
    /// H_d = 0 in a channel counts as the factor 1 there, whatever h_d is, which keeps the mean at 1;
    /// [`trivial`](Self::trivial) counts these. A factor whose H_d is not finite is NaN, and so is the
    /// auxiliary of that channel from there on: estimators fall back to the plain mean. No channel
    /// touches another.
    ///
    /// What may end a path, such as absorption, is a step with f_d = 0 where it ends; divide h_d by the
    /// probability of survival as well, or leave it as it is: either has the mean H_d.
    pub fn extend(&mut self, step: Draw<V, K>, integrals: &Integrals<V, K>) {
        let (step, mut trivial) = (step.widen(), self.trivial);
        self.f = PerLane::from_fn(|i| self.f.get(i) * Scaled::new(step.f.get(i)));
        self.h = core::array::from_fn(|k| {
            let integral = integrals.0[k];
            trivial = PerLane::from_fn(|i| trivial.get(i).saturating_add(u32::from(integral.get(i) == 0.0)));
            PerLane::from_fn(|i| self.h[k].get(i) * factor(step.h[k].get(i), integral.get(i)))
        });
        self.trivial = trivial;
    }

    /// The path as one draw, to be estimated with [`Integrals::ONE`].
    pub fn draw(&self) -> Draw<V, K> {
        let rounded = |product: &V::PerLane<Scaled>| V::from_fn(|i| V::Scalar::from_f64(product.get(i).value()));
        Draw { f: rounded(&self.f), h: core::array::from_fn(|k| rounded(&self.h[k])) }
    }

    /// How often an integral of channel `channel` was 0 and the factor 1 stood in, over all steps and
    /// auxiliaries; panics if there is no such channel.
    pub fn trivial(&self, channel: usize) -> u32 {
        self.trivial.get(channel)
    }
}

impl<V: Lanes> PathProduct<V> {
    /// f and h of channel `channel`, with their exponents.
    pub(super) fn channel(&self, channel: usize) -> (Scaled, Scaled) {
        (self.f.get(channel), self.h[0].get(channel))
    }
}

/// h/H of one step.
fn factor(h: f64, integral: f64) -> Scaled {
    if integral == 0.0 {
        // Any factor of mean 1 will do, and 1 has no variance.
        return planted!("path_trivial_factor": Scaled::ONE, Scaled::new(h));
    }
    if !integral.is_finite() {
        return Scaled::NAN; // h/∞ would be a silent 0
    }
    Scaled::new(h) / planted!("path_local_integral": Scaled::new(integral), Scaled::ONE)
}
