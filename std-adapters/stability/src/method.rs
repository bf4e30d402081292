//! What may be asked of moments.

use ratiocv_core::moments::{
    Blocked, ComomentsBlock, ComomentsState, ExtremesBlock, GroupsBlock, HasComoments, HasMeans, Joined, Moments,
    RatioOf, UnivariateBlock,
};
use ratiocv_core::{
    Beale, ChannelEstimate, Choose, Coefficients, Dependent, Difference, Estimator, FallBackWhenIll, Fit, Flags,
    HartleyRoss, Jackknife, MeanOfRatios, Mickey, OptimalDefensive, Plain, Quenouille, RandomMixture, RatioOfMeans,
    Regression, RegressionRatio, Sample, Tin, WithCoefficients,
};

/// Moments of one auxiliary that every estimator here reads, with tails, so that no flag is left out.
pub(crate) type Everything<V> =
    Blocked<V, Joined<ComomentsBlock<V>, UnivariateBlock<RatioOf<V>, 1>, GroupsBlock<V, 8>, ExtremesBlock<V>>>;

/// One channel of them, whatever the lanes.
pub(crate) type One = <Everything<f64> as Moments>::Channel;

/// Coefficients as least squares has them.
pub(crate) const FREE: Regression = Regression { dependent: Dependent::MinimumNorm, shrink: false };

/// An estimator of one auxiliary, or a number that its moments hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// [`Plain`].
    Plain,
    /// [`RatioOfMeans`].
    Ratio,
    /// [`RatioOfMeans`], plain where it is ill.
    RatioUnlessIll,
    /// [`Quenouille`].
    Quenouille,
    /// [`Beale`].
    Beale,
    /// [`Tin`].
    Tin,
    /// [`Jackknife`].
    Jackknife,
    /// [`MeanOfRatios`].
    MeanOfRatios,
    /// [`HartleyRoss`].
    HartleyRoss,
    /// [`Mickey`].
    Mickey,
    /// [`Difference`].
    Difference,
    /// [`RegressionRatio`].
    RegressionRatio,
    /// [`RegressionRatio`], not shrunk.
    FreeRatio,
    /// ȳ(H/x̄)^α with α given.
    Power(f64),
    /// [`OptimalDefensive`].
    OptimalDefensive,
    /// [`Choose`].
    Choose,
    /// α̂, not shrunk.
    Alpha,
    /// Σ(f − f̄)²/(N − this).
    Variance(f64),
    /// Σ((f − f̄) − R̂(h − h̄))², in squared unit roundoffs of Σ(f − f̄)².
    Residual,
    /// κ = Σ|h|/|Σh|.
    Condition,
}

impl Method {
    /// Of one channel's moments.
    pub(crate) fn estimate(self, moments: &One, count: u64, epsilon: f64, integral: f64) -> ChannelEstimate {
        let sample = Sample { channel: 0, count, epsilon, moments };
        let h = &[integral];
        let n = count as f64;
        let free = RegressionRatio { regression: FREE, ..RegressionRatio::default() };
        match self {
            Self::Plain => Plain.estimate_channel(&sample, h),
            Self::Ratio => RatioOfMeans.estimate_channel(&sample, h),
            Self::RatioUnlessIll => FallBackWhenIll(RatioOfMeans).estimate_channel(&sample, h),
            Self::Quenouille => Quenouille.estimate_channel(&sample, h),
            Self::Beale => Beale.estimate_channel(&sample, h),
            Self::Tin => Tin.estimate_channel(&sample, h),
            Self::Jackknife => Jackknife.estimate_channel(&sample, h),
            Self::MeanOfRatios => MeanOfRatios.estimate_channel(&sample, h),
            Self::HartleyRoss => HartleyRoss.estimate_channel(&sample, h),
            Self::Mickey => Mickey.estimate_channel(&sample, h),
            Self::Difference => Difference::default().estimate_channel(&sample, h),
            Self::RegressionRatio => RegressionRatio::default().estimate_channel(&sample, h),
            Self::FreeRatio => free.estimate_channel(&sample, h),
            Self::Power(alpha) => free.estimate_with(&sample, h, &Coefficients::given([alpha])),
            Self::OptimalDefensive => <OptimalDefensive>::default().estimate_channel(&sample, h),
            Self::Choose => Choose::default().estimate_channel(&sample, h),
            Self::Alpha => {
                let Coefficients { values, flags, .. } = free.fit(&sample, h);
                number(values[0], flags)
            }
            Self::Variance(less) => {
                let plain: ChannelEstimate = Plain.estimate_channel(&sample, h);
                number(HasComoments::<1>::comoments(moments).ff() / (n - less), plain.flags)
            }
            Self::Residual => {
                let (means, spread) = (HasMeans::<1>::means(moments, count), HasComoments::<1>::comoments(moments));
                let roundoff = epsilon / 2.0;
                number(spread.about(&[means.f / means.h[0]]) / spread.ff() / roundoff / roundoff, Flags::NONE)
            }
            Self::Condition => {
                let sum = (n * HasMeans::<1>::means(moments, count).h[0]).abs();
                number(HasMeans::<1>::tails(moments).map_or(f64::NAN, |tails| tails.abs_h / sum), Flags::NONE)
            }
        }
    }

    /// Its name in the table.
    pub fn name(self) -> String {
        match self {
            Self::Power(alpha) => format!("ratio to the power {alpha}"),
            Self::Variance(0.0) => "population variance".into(),
            Self::Variance(_) => "variance".into(),
            Self::Ratio => "ratio of means".into(),
            other => {
                let name = format!("{other:?}");
                let spaced = name.char_indices().flat_map(|(i, c)| {
                    let space = (i > 0 && c.is_uppercase()).then_some(' ');
                    space.into_iter().chain(core::iter::once(c.to_ascii_lowercase()))
                });
                spaced.collect()
            }
        }
    }
}

/// An estimator of two auxiliaries, or a coefficient of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Several {
    /// [`Difference`], not shrunk.
    Difference,
    /// β of this auxiliary.
    Beta(usize),
    /// [`RandomMixture`].
    RandomMixture,
    /// The weight that it gives to this auxiliary.
    Weight(usize),
    /// [`RandomMixture`] with given weights.
    Mixture([f64; 2]),
    /// [`OptimalDefensive`].
    OptimalDefensive,
}

impl Several {
    /// Of one channel's moments.
    pub(crate) fn estimate(
        self,
        moments: &ComomentsState<f64, 2>,
        count: u64,
        epsilon: f64,
        h: &[f64; 2],
    ) -> ChannelEstimate {
        let sample = Sample { channel: 0, count, epsilon, moments };
        let (difference, mixture) = (Difference { regression: FREE }, <RandomMixture>::default());
        match self {
            Self::Difference => difference.estimate_channel(&sample, h),
            Self::Beta(which) => coefficient(&difference.fit(&sample, h), which),
            Self::RandomMixture => mixture.estimate_channel(&sample, h),
            Self::Weight(which) => coefficient(&mixture.fit(&sample, h), which),
            Self::Mixture(weights) => mixture.estimate_with(&sample, h, &Coefficients::given(weights)),
            Self::OptimalDefensive => <OptimalDefensive>::default().estimate_channel(&sample, h),
        }
    }
}

/// β, or, beyond the last, the intercept f̄ − Σβh̄.
pub(crate) fn regressed(moments: &ComomentsState<f64, 5>, count: u64, epsilon: f64, which: usize) -> ChannelEstimate {
    let fitted = Difference { regression: FREE }.fit(&Sample { channel: 0, count, epsilon, moments }, &[1.0; 5]);
    if which < 5 {
        return coefficient(&fitted, which);
    }
    let means = moments.means(count);
    number((0..5).fold(means.f, |sum, k| sum - fitted.values[k] * means.h[k]), fitted.flags)
}

fn coefficient<const K: usize>(fitted: &Coefficients<K>, which: usize) -> ChannelEstimate {
    number(fitted.values[which], fitted.flags)
}

/// A number without an error bar.
pub(crate) fn number(value: f64, flags: Flags) -> ChannelEstimate {
    ChannelEstimate { value, std_error: f64::NAN, flags }
}
