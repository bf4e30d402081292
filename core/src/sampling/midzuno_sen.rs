//! The draw that makes the ratio of means unbiased.

use crate::draw::Draw;
use crate::error::Error;
use crate::estimate::Estimate;
use crate::estimator::{Estimator, RatioOfMeans};
use crate::lanes::Lanes;
use crate::moments::{Accumulate, Comoments};
use crate::planted::planted;
use crate::problem::{Auxiliaries, Integrand, Problem, Proposal};
use rand_core::Rng;

impl<F, A, P, X> Problem<F, A, P, X>
where
    F: Integrand<X>,
    A: Auxiliaries<X, F::Value, 1>,
    P: Proposal<Point = X>,
{
    /// Adds `draws` draws to `moments`, the first at a point X₁ ~ h/H, the others from the proposal g:
    /// the [`RatioOfMeans`] of them is exactly unbiased (Midzuno 1952; Sen 1952), without any f/h.
    ///
    /// `firsts` are densities h_j/H_j, h ≥ 0 being the auxiliary of this problem: one for each channel j,
    /// so that every channel is unbiased; or a single one, for all channels, which makes those
    /// unbiased whose h_j is proportional to it and leaves the others a bias of O(1/N). The first
    /// draw is divided by g like all others. One draw alone is importance sampling by h. No draw adds
    /// nothing. Needs g > 0 where h > 0.
    ///
    /// ```
    /// use rand_core::SeedableRng;
    /// use ratiocv_core::{moments::Sums, sampling::PiecewiseConstant};
    /// use ratiocv_core::{Estimator, Problem, RatioOfMeans, Uniform, WithIntegral};
    /// let h = WithIntegral::new(|x: &f64| if *x < 0.5 { 1.0 } else { 3.0 }, 2.0);
    /// let problem = Problem::new(|x: &f64| 6.0 * x * x).auxiliary(h).proposal(Uniform);
    /// let first = PiecewiseConstant::new(&[1.0, 3.0])?; // h/H
    /// let mut rng = rand_pcg::Pcg64::seed_from_u64(1);
    /// let (mut sum, runs) = (0.0, 10_000);
    /// for _ in 0..runs {
    ///     let mut moments = Sums::<f64>::default();
    ///     problem.accumulate_midzuno_sen(&[first], &mut moments, 2, &mut rng)?;
    ///     sum += RatioOfMeans.estimate(&moments, &problem.integrals())?.value;
    /// }
    /// assert!((sum / f64::from(runs) - 2.0).abs() < 0.04); // two draws each, and no bias
    /// # Ok::<(), ratiocv_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless there is one first density or one for each channel.
    pub fn accumulate_midzuno_sen<M: Accumulate<Draw<F::Value>>, Q: Proposal<Point = X>, R: Rng + ?Sized>(
        &self,
        firsts: &[Q],
        moments: &mut M,
        draws: u64,
        rng: &mut R,
    ) -> Result<(), Error> {
        let lanes = F::Value::LANES;
        if firsts.len() != 1 && firsts.len() != lanes {
            return Err(Error::LengthMismatch { what: "firsts", expected: lanes, got: firsts.len() });
        }
        if draws == 0 {
            return Ok(());
        }
        let mut first = Draw::ZERO;
        for (channel, density) in firsts.iter().enumerate() {
            let draw = planted!("midzuno_first": self.draw_at(&density.sample(rng)), self.draw(rng));
            // The first of them for all channels, each of the others for its own.
            first = draw.zip(first, |new: F::Value, old| {
                F::Value::from_fn(|lane| {
                    if channel == 0 || planted!("midzuno_channel": lane == channel, false) {
                        new.get(lane)
                    } else {
                        old.get(lane)
                    }
                })
            });
        }
        moments.add(first);
        self.accumulate(moments, planted!("midzuno_rest": draws - 1, draws), rng);
        Ok(())
    }

    /// The ratio of means of `draws` draws, made unbiased by
    /// [`accumulate_midzuno_sen`](Self::accumulate_midzuno_sen), with the error bar of the ratio of
    /// means, which is right to first order.
    ///
    /// # Errors
    /// As there, and [`Error::TooFewDraws`] of no draw.
    pub fn integrate_midzuno_sen<Q: Proposal<Point = X>, R: Rng + ?Sized>(
        &self,
        firsts: &[Q],
        draws: u64,
        rng: &mut R,
    ) -> Result<Estimate<F::Value>, Error> {
        let mut moments = Comoments::default();
        self.accumulate_midzuno_sen(firsts, &mut moments, draws, rng)?;
        RatioOfMeans.estimate(&moments, &self.integrals())
    }
}
