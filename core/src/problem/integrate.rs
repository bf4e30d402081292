//! The driver loop: from functions to draws to an estimate.

use crate::draw::Draw;
use crate::error::Error;
use crate::estimate::Estimate;
use crate::estimator::{Estimator, Reads};
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::{Accumulate, Moments};
use crate::problem::{Auxiliaries, Integrand, Proposal};
use core::marker::PhantomData;
use rand_core::Rng;

/// An integrand, its auxiliaries, and a proposal.
///
/// ```
/// use rand_core::SeedableRng;
/// use ratiocv_core::{HartleyRoss, Problem, Spectrum, Uniform, WithIntegral};
/// let problem = Problem::new(|x: &f64| Spectrum([x + x * x, 2.0 + x * x]))
///     .auxiliary(WithIntegral::new(|x: &f64| Spectrum([*x, 1.0 + x]), Spectrum([0.5, 1.5])))
///     .proposal(Uniform);
/// let mut rng = rand_pcg::Pcg64::seed_from_u64(1);
/// let estimate = problem.integrate(&HartleyRoss, 10_000, &mut rng)?;
/// assert!((estimate.value[0] - 5.0 / 6.0).abs() < 5.0 * estimate.std_error[0]);
/// assert!((estimate.value[1] - 7.0 / 3.0).abs() < 5.0 * estimate.std_error[1]);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Problem<F, A = (), P = (), X = ()> {
    integrand: F,
    auxiliaries: A,
    proposal: P,
    point: PhantomData<fn(&X)>,
}

impl<F> Problem<F> {
    /// The integral of `integrand`, so far without an auxiliary or a proposal.
    pub const fn new<X>(integrand: F) -> Problem<F, (), (), X>
    where
        F: Integrand<X>,
    {
        Problem { integrand, auxiliaries: (), proposal: (), point: PhantomData }
    }
}

impl<F, A, P, X> Problem<F, A, P, X> {
    /// With one auxiliary.
    pub fn auxiliary<H>(self, auxiliary: H) -> Problem<F, (H,), P, X> {
        self.auxiliaries((auxiliary,))
    }

    /// With several auxiliaries: a tuple or an array.
    pub fn auxiliaries<H>(self, auxiliaries: H) -> Problem<F, H, P, X> {
        Problem { integrand: self.integrand, auxiliaries, proposal: self.proposal, point: PhantomData }
    }

    /// With draws from `proposal`.
    pub fn proposal<G: Proposal<Point = X>>(self, proposal: G) -> Problem<F, A, G, X> {
        Problem { integrand: self.integrand, auxiliaries: self.auxiliaries, proposal, point: PhantomData }
    }
}

impl<F: Integrand<X>, A, P: Proposal<Point = X>, X> Problem<F, A, P, X> {
    /// One draw: f(X)/g(X) and h_k(X)/g(X) at a point X ~ g.
    #[inline(always)]
    pub fn draw<R: Rng + ?Sized, const K: usize>(&self, rng: &mut R) -> Draw<F::Value, K>
    where
        A: Auxiliaries<X, F::Value, K>,
    {
        self.draw_at(&self.proposal.sample(rng))
    }

    /// f(x)/g(x) and h_k(x)/g(x) at a point of the caller's choice.
    ///
    /// Where the pdf is 0 and so is the value, the quotient is 0: a point that the proposal returned
    /// by rounding at the edge of its support carries nothing.
    ///
    /// ```
    /// use ratiocv_core::{sampling::Discrete, Problem};
    /// let sum = Problem::new(|i: &usize| [1.0, 3.0][*i]).proposal(Discrete::new(&[0.5, 0.5])?);
    /// assert_eq!((sum.draw_at::<0>(&0).f, sum.draw_at::<0>(&1).f), (2.0, 6.0)); // their mean is 1 + 3
    /// # Ok::<(), ratiocv_core::Error>(())
    /// ```
    #[inline(always)]
    pub fn draw_at<const K: usize>(&self, x: &X) -> Draw<F::Value, K>
    where
        A: Auxiliaries<X, F::Value, K>,
    {
        let pdf = F::Value::narrow(<F::Value as Lanes>::Wide::splat(self.proposal.pdf(x)));
        let over = |value: F::Value| {
            // A division, never a product with 1/pdf: that overflows for the smallest pdfs.
            let quotient = value / pdf;
            let nothing = quotient.except(F::Value::equal(value, F::Value::ZERO));
            F::Value::select(F::Value::equal(pdf, F::Value::ZERO), nothing, quotient)
        };
        Draw { f: over(self.integrand.value(x)), h: self.auxiliaries.values(x).map(over) }
    }

    /// The known integrals of the auxiliaries.
    pub fn integrals<const K: usize>(&self) -> Integrals<F::Value, K>
    where
        A: Auxiliaries<X, F::Value, K>,
    {
        self.auxiliaries.integrals()
    }

    /// Adds `draws` draws to `moments`.
    #[inline(always)]
    pub fn accumulate<M, R: Rng + ?Sized, const K: usize>(&self, moments: &mut M, draws: u64, rng: &mut R)
    where
        A: Auxiliaries<X, F::Value, K>,
        M: Accumulate<Draw<F::Value, K>>,
    {
        moments.add_from(draws, || self.draw(rng));
    }

    /// The estimate of `estimator` from `draws` draws, with the moments that it names for an error
    /// bar.
    ///
    /// # Errors
    /// As [`Estimator::estimate`].
    pub fn integrate<E, R: Rng + ?Sized, const K: usize>(
        &self,
        estimator: &E,
        draws: u64,
        rng: &mut R,
    ) -> Result<Estimate<F::Value>, Error>
    where
        A: Auxiliaries<X, F::Value, K>,
        E: Reads<K> + Estimator<<E::ErrorBar<F::Value> as Moments>::Channel, K>,
    {
        let integrals = self.integrals();
        let mut moments = estimator.error_bar(&integrals);
        self.accumulate(&mut moments, draws, rng);
        estimator.estimate(&moments, &integrals)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimator::{Plain, RatioOfMeans};
    use crate::moments::Sums;
    use crate::problem::{Uniform, UniformCube, WithIntegral};
    use rand_core::SeedableRng;
    use rand_pcg::Pcg64;

    #[test]
    fn two_auxiliaries_give_the_ratios_of_either() {
        let first = WithIntegral::new(|x: &f64| *x, 0.5);
        let second = WithIntegral::new(|x: &f64| 1.0 - *x, 0.5);
        let problem = Problem::new(|x: &f64| 3.0 * x).auxiliaries((first, second)).proposal(Uniform);
        let draws: [Draw<f64, 2>; 100] = {
            let mut rng = Pcg64::seed_from_u64(5);
            core::array::from_fn(|_| problem.draw(&mut rng))
        };
        let mut both = Sums::<f64, 2>::default();
        both.add_batch(&draws);
        let means = crate::moments::HasMeans::means(&both.channel(0), both.count());
        assert!((means.h[0] + means.h[1] - 1.0).abs() <= 1e-15);
        assert_eq!(problem.integrals(), Integrals::new([0.5, 0.5]));
        // One pass over the draws for each auxiliary; the plain mean is the same from all of them.
        let mut ratios = [Sums::<f64>::default(); 2];
        for draw in &draws {
            for (k, moments) in ratios.iter_mut().enumerate() {
                moments.add(draw.auxiliary(k));
            }
        }
        let exact = RatioOfMeans.estimate(&ratios[0], &Integrals::new([0.5])).unwrap();
        assert!((exact.value - 1.5).abs() <= 1e-15);
        let plain = Plain.estimate(&both, &problem.integrals()).unwrap();
        assert!((plain.value - Plain.estimate(&ratios[1], &Integrals::ONE).unwrap().value).abs() <= 1e-15);
    }

    #[test]
    fn plain_needs_no_auxiliary() {
        let problem = Problem::new(|x: &[f64; 3]| x[0] * x[1] * x[2]).proposal(UniformCube);
        let estimate = problem.integrate(&Plain, 10_000, &mut Pcg64::seed_from_u64(6)).unwrap();
        // |z| ≤ 5 fails once in 1.7 million seeds; this one is fixed.
        assert!((estimate.value - 0.125).abs() <= 5.0 * estimate.std_error);
    }

    #[test]
    fn an_array_of_auxiliaries_is_as_good_as_a_tuple() {
        let h = |c: f64| WithIntegral::new(move |x: &f64| c * x, c / 2.0);
        let problem = Problem::new(|x: &f64| x * x).auxiliaries([h(1.0), h(2.0), h(4.0)]).proposal(Uniform);
        let draw: Draw<f64, 3> = problem.draw(&mut Pcg64::seed_from_u64(7));
        assert_eq!(draw.h[2], 4.0 * draw.h[0]);
        assert_eq!(problem.integrals().channel(0), [0.5, 1.0, 2.0]);
    }
}
