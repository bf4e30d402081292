//! The ratio of two integrals neither of which is known.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::remarks::Remarks;
use crate::estimator::{Estimator, Reads, Sample, enough_draws};
use crate::integrals::Integrals;
use crate::lanes::Lanes;
use crate::moments::{Comoments, HasComoments};
use crate::planted::planted;
use crate::solve::solve;

/// ∫f/∫d, d the auxiliary number 0, the others controls c whose integrals C are known:
/// R̂ − γᵀ(c̄ − C)/d̄ with R̂ = f̄/d̄, γ = Cov(c)⁻¹Cov(c, f − R̂d).
///
/// Consistent (Bocquet-Nouaille et al., arXiv 2510.13504); bias O(1/N), MSE to first order
/// Var(f − R·d − γᵀc)/(N·D²), never above that of f̄/d̄. `Integrals` has a place for d that is not read:
/// put NaN. With `K` = 1 there are no controls. Needs 2 draws; d̄ = 0 gives NaN and DENOM_ZERO, there
/// being nothing to fall back to.
///
/// ```
/// use ratiocv_core::{moments::{Accumulate, Comoments}, Draw, Estimator, Integrals, RatioOfIntegrals};
/// let mut moments = Comoments::<f64, 2>::default();
/// for i in 0..32 {
///     let x = f64::from(i * 5 % 32) / 16.0;
///     moments.add(Draw { f: 1.0 + 4.0 * x, h: [1.0 + x, x] });
/// }
/// let estimate = RatioOfIntegrals.estimate(&moments, &Integrals::new([f64::NAN, 1.0]))?;
/// assert!((estimate.value - 2.5).abs() < 0.01 && estimate.std_error < 1e-6); // 5/2 at x = 1
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RatioOfIntegrals;

impl<const K: usize> Reads<K> for RatioOfIntegrals {
    const ID: &'static str = "ratio_of_integrals";
    const DEFENSIVE_ID: &'static str = "ratio_of_integrals";
    const MIN_DRAWS: u64 = 2;
    type Value<V: Lanes> = Comoments<V, K>;
    type ErrorBar<V: Lanes> = Comoments<V, K>;
    fn value_on<V: Lanes>(&self, _: f64, _: &Integrals<V, K>) -> Self::Value<V> {
        Comoments::default()
    }
    fn error_bar_on<V: Lanes>(&self, _: f64, _: &Integrals<V, K>) -> Self::ErrorBar<V> {
        Comoments::default()
    }
}

impl<S: HasComoments<K>, const K: usize> Estimator<S, K> for RatioOfIntegrals {
    fn check(&self, sample: &Sample<'_, S>, _: &[f64; K]) -> Result<(), Error> {
        enough_draws::<Self, K>(sample.count)
    }
    fn estimate_channel(&self, sample: &Sample<'_, S>, integrals: &[f64; K]) -> ChannelEstimate {
        let means = sample.moments.means(sample.count);
        let Some((&d, _)) = means.h.split_first() else {
            return Remarks::without_auxiliary(sample).value(f64::NAN, &[0.0; K]);
        };
        // The integral of d is what its draws say: nothing to remark on.
        let of_d = if d.is_finite() && d != 0.0 { d } else { 1.0 };
        let known: [f64; K] = core::array::from_fn(|k| if k == 0 { of_d } else { integrals[k] });
        let remarks = Remarks::with_auxiliaries(sample, &known);
        let undefined = ChannelEstimate { value: f64::NAN, std_error: f64::NAN, flags: remarks.flags() };
        if d == 0.0 {
            return ChannelEstimate { flags: remarks.flags() | remarks.zero_denominator(), ..undefined };
        }
        if remarks.flags().fell_back() {
            return undefined;
        }
        let ratio = means.f / d;
        let spread = sample.moments.comoments();
        // γ: regression of z = f − R̂d on the controls alone.
        let controls = core::array::from_fn(|k| if k == 0 || spread.hh[k][k] == 0.0 { 0.0 } else { 1.0 });
        let with_z = core::array::from_fn(
            |k| planted!("ratio_of_integrals_z": spread.fh(k) - ratio * spread.hh[k][0], spread.fh(k)),
        );
        let gamma = solve(&spread.hh, &with_z, &controls, 64.0 * sample.epsilon);
        let rank = gamma.determined.iter().sum::<f64>();
        let value = (1..K).filter(|k| gamma.x[*k] != 0.0).fold(means.f, |value, k| {
            value
                + gamma.x[k] * planted!("ratio_of_integrals_sign": integrals[k] - means.h[k], means.h[k] - integrals[k])
        });
        let c = core::array::from_fn(|k| if k == 0 { ratio } else { gamma.x[k] });
        let over = remarks.value_with_fit(value, &c, rank);
        ChannelEstimate { value: over.value / d, std_error: over.std_error / d.abs(), ..over }
    }
}
