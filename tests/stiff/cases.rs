//! How the cases are run: in the middle of three channels, with the isolation law checked each time.

use ratiocv_core::moments::{Accumulate, Comoments, Moments};
use ratiocv_core::{ChannelEstimate, Draw, Estimator, Integrals, Lanes, RatioOfMeans, Reads, Scalar, Spectrum};

/// The estimate of `estimator` from draws of the case, on the estimator's own moments.
pub(crate) fn run<S: Scalar, E>(estimator: E, draws: &[(S, S)], integral: f64) -> ChannelEstimate
where
    E: Reads + Estimator<<E::ErrorBar<Spectrum<S, 3>> as Moments>::Channel>,
{
    let draws: Vec<_> = draws.iter().map(|(f, h)| Draw::new(*f, *h)).collect();
    run_on(&estimator, |integrals| estimator.error_bar(integrals), &draws, [integral])
}

/// The same on the moments that `empty` makes, for any number of auxiliaries: in channel 1 of 3, after checking
/// that channels 0 and 2 are, to the bit, what they are beside an innocent channel.
pub(crate) fn run_on<S: Scalar, E, M, const K: usize>(
    estimator: &E,
    empty: impl Fn(&Integrals<Spectrum<S, 3>, K>) -> M,
    draws: &[Draw<S, K>],
    integrals: [f64; K],
) -> ChannelEstimate
where
    M: Accumulate<Draw<Spectrum<S, 3>, K>> + Moments<Lanes = Spectrum<S, 3>>,
    E: Estimator<M::Channel, K>,
{
    let beside = |i: usize| S::from_f64(0.5 + (i * 7 % 5) as f64 / 8.0);
    let estimate = |case: &dyn Fn(usize) -> Draw<S, K>, integrals: [f64; K]| {
        let integrals = Integrals::new(integrals.map(|integral| Spectrum([1.0, integral, 0.75])));
        let mut moments = empty(&integrals);
        for i in 0..draws.len() {
            let Draw { f, h } = case(i);
            // Further auxiliaries of the channels beside it are the first ones, out of step.
            let h = core::array::from_fn(|k| Spectrum([beside(i + 3 + 2 * k), h[k], beside(i + 2 * k)]));
            moments.add(Draw { f: Spectrum([beside(i), f, beside(i + 3)]), h });
        }
        estimator.estimate_anyway(&moments, &integrals)
    };
    let case = estimate(&|i| draws[i], integrals);
    let innocent = estimate(&|_| Draw { f: S::ONE, h: [S::ONE; K] }, [1.0; K]);
    for channel in [0, 2] {
        let (ours, alone) = (case.channel(channel), innocent.channel(channel));
        assert_eq!(ours.value.to_bits(), alone.value.to_bits(), "channel {channel}");
        assert_eq!(ours.std_error.to_bits(), alone.std_error.to_bits(), "channel {channel}");
        assert_eq!(ours.flags, alone.flags, "channel {channel}");
    }
    case.channel(1)
}

/// The ratio of means, of `f64` draws.
pub(crate) fn ratio(draws: &[(f64, f64)], integral: f64) -> ChannelEstimate {
    run(RatioOfMeans, draws, integral)
}

/// The ratio of means, of `f32` draws.
pub(crate) fn ratio32(draws: &[(f32, f32)], integral: f64) -> ChannelEstimate {
    run(RatioOfMeans, draws, integral)
}

/// Σ(x − x̄)² of `xs`, through the co-moments of f.
pub(crate) fn squares<S: Scalar>(xs: impl IntoIterator<Item = S>) -> f64 {
    moments(xs.into_iter().map(|x| (x, S::ONE))).channel(0).spread_of_f()
}

/// Co-moments of draws, added one by one.
pub(crate) fn moments<V: Lanes>(draws: impl IntoIterator<Item = (V, V)>) -> Comoments<V> {
    ratiocv_tests::samples::filled(Comoments::default(), draws)
}

/// What the tests read of a channel.
pub(crate) trait Read {
    /// Σ(f − f̄)².
    fn spread_of_f(&self) -> f64;
    /// The mean of f.
    fn mean_of_f(&self) -> f64;
}

impl Read for ratiocv_core::moments::ComomentsState<f64> {
    fn spread_of_f(&self) -> f64 {
        ratiocv_core::moments::HasComoments::comoments(self).ff()
    }
    fn mean_of_f(&self) -> f64 {
        ratiocv_core::moments::HasMeans::means(self, 1).f
    }
}
