//! A ratio inside an integral does not converge; the ratio over whole paths does.

use crate::catalogue::{Everything, Method, everything};
use crate::exhibits::replicates::average;
use crate::measure::{Options, cell_seed};
use crate::problems::{Nested, OneLobe, Path, Rgb, Solved};
use rand_pcg::Pcg64;
use ratiocv_core::moments::{Accumulate, Sums};
use ratiocv_core::{Defensive, Draw, Estimator, Integrals, Lanes, PathProduct, Plain, Proposal, RatioOfMeans};

/// Bias against the number of paths, on [`Nested`].
///
/// `naive_ratio` is a counter-example: nobody should use it. It puts a ratio of one draw into every
/// integral but the first, H₁ Σy₁·H₂(y₂/x₂)·H₃(y₃/x₃)/Σx₁, and each of these is off by as much as a mean of
/// ratios is, whatever the number of paths (Lu et al. 2025, supplement, section 4.3). The others are the
/// core's own on the draws f = Πy_d, h = Πx_d/H_d of whole paths (their Eq. 17).
#[derive(Clone, Debug, serde::Serialize)]
pub struct NestedBias {
    /// The names of the channels.
    pub channels: Vec<String>,
    /// What the bias of `naive_ratio` tends to, over F: exact, per channel.
    pub limit: Vec<f64>,
    /// One curve per estimator.
    pub curves: Vec<NestedCurve>,
}

/// One estimator of [`NestedBias`].
#[derive(Clone, Debug, serde::Serialize)]
pub struct NestedCurve {
    /// Its id.
    pub estimator: &'static str,
    /// By number of paths, ascending.
    pub points: Vec<Bias>,
}

/// Mean error over F of many estimates.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Bias {
    /// Paths per estimate.
    pub draws: u64,
    /// Independent estimates.
    pub replicates: u64,
    /// Per channel.
    pub bias: Vec<f64>,
    /// Its standard error, per channel.
    pub std_error: Vec<f64>,
}

/// The counter-example and its remedies.
const ESTIMATORS: [&str; 4] = ["naive_ratio", "ratio", "hartley_ross", "mickey"];
/// Paths per estimate: 2¹ to 2⁹.
const POWERS: core::ops::RangeInclusive<u32> = 1..=9;
/// Paths at each size.
const PATHS: u64 = 1 << 19;
const QUICK_PATHS: u64 = 1 << 17;

/// The draw whose ratio of means is the naive nested ratio: of the first integral y₁ times the one-draw
/// ratios H_d·(f_d/h_d) inside it, and x₁. On this problem f_d = h_d, but for the lamp at the end.
fn naive(path: &Path) -> Draw<Rgb> {
    let [first, inner @ ..] = &path.bounces;
    let x1 = first.albedo * first.lobe / Rgb::splat(first.pdf);
    let inside = inner.iter().fold(Rgb::splat(path.light), |product, bounce| product * bounce.albedo);
    Draw::new(x1 * inside, x1)
}

/// The path as one draw of the joint integral, put together bounce by bounce, as a path tracer would.
fn whole(path: &Path) -> Draw<Rgb> {
    let mut product = PathProduct::default();
    for (number, bounce) in path.bounces.iter().enumerate() {
        let h = bounce.albedo * bounce.lobe / Rgb::splat(bounce.pdf);
        let f = if number + 1 == path.bounces.len() { h * Rgb::splat(path.light) } else { h };
        product.extend(Draw::new(f, h), &Integrals::new([bounce.albedo]));
    }
    product.draw()
}

impl NestedBias {
    pub(super) fn measure(options: &Options) -> Self {
        let exact = Nested.exact();
        let paths = if options.quick { QUICK_PATHS } else { PATHS };
        let mut curves = ESTIMATORS.map(|estimator| NestedCurve { estimator, points: vec![] });
        for draws in POWERS.map(|power| 1 << power) {
            let replicates = paths / draws;
            let seed = cell_seed(options.seed, "nested-bias", draws);
            let biases = average(seed, replicates, |rng| estimates(draws, rng).map(|value| (value - exact) / exact));
            for (curve, bias) in curves.iter_mut().zip(biases) {
                let (bias, std_error) = (bias.value.0.to_vec(), bias.std_error.0.to_vec());
                curve.points.push(Bias { draws, replicates, bias, std_error });
            }
        }
        let limit = (Nested::naive_limit() - exact) / exact;
        Self {
            channels: (0..Rgb::LANES).map(|channel| Nested.channel(channel)).collect(),
            limit: limit.0.to_vec(),
            curves: curves.into(),
        }
    }
}

/// The estimates of all [`ESTIMATORS`] from the same paths.
fn estimates(draws: u64, rng: &mut Pcg64) -> [Rgb; 4] {
    let weight = Defensive::<Plain>::DEFAULT_WEIGHT;
    let one = Integrals::<Rgb>::ONE;
    let mut naive_moments = Sums::<Rgb>::default();
    let mut moments: Everything<Rgb> =
        everything::<Rgb, (), ()>(weight, &one).unwrap_or_else(|error| panic!("{error}"));
    let paths: Vec<Path> = (0..draws).map(|_| OneLobe.sample(rng)).collect();
    moments.add_batch(&paths.iter().map(whole).collect::<Vec<_>>());
    naive_moments.add_batch(&paths.iter().map(naive).collect::<Vec<_>>());
    ESTIMATORS.map(|id| match Method::from_id(id) {
        Some(method) => method.estimate(weight, &moments, &one).value,
        None => RatioOfMeans.estimate_anyway(&naive_moments, &Integrals::new([Nested::first_integral()])).value,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratiocv_threads::stream;

    #[test]
    fn bounce_by_bounce_is_the_product_of_all() {
        let rng = &mut stream(1, 1);
        for _ in 0..100 {
            let path = OneLobe.sample(rng);
            let (ours, pdf) = (whole(&path), Rgb::splat(OneLobe.pdf(&path)));
            for (ours, right) in [(ours.f, path.f() / pdf), (ours.h[0], path.h() / pdf)] {
                assert!((0..3).all(|j| libm::fabs(ours[j] / right[j] - 1.0) <= 1e-14), "{ours:?} {right:?}");
            }
        }
    }

    #[test]
    fn only_the_naive_bias_stays() {
        let options = Options { quick: true, seed: 3, ..Options::default() };
        let exhibit = NestedBias::measure(&options);
        let last = |curve: usize| exhibit.curves[curve].points.last().unwrap();
        for channel in 0..3 {
            // 512 estimates of 512 paths. z ≤ 5: one seed in 1.7 million would fail; this one is fixed.
            let z = |curve: usize, right: f64| (last(curve).bias[channel] - right) / last(curve).std_error[channel];
            assert!(libm::fabs(z(0, exhibit.limit[channel])) <= 5.0, "{}", z(0, exhibit.limit[channel]));
            assert!(libm::fabs(z(0, 0.0)) > 10.0, "{}", z(0, 0.0));
            for unbiased in [2, 3] {
                assert!(libm::fabs(z(unbiased, 0.0)) <= 5.0, "{}", z(unbiased, 0.0));
            }
            // The ratio's own bias, O(1/N), is a tenth of a percent here.
            assert!(libm::fabs(last(1).bias[channel]) <= 5.0 * last(1).std_error[channel] + 0.005);
        }
    }
}
