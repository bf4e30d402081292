//! An auxiliary that does not know of shadows, and an exponent that learns where to distrust it.

use crate::exhibits::floor::{HEIGHT, Spot, WIDTH};
use crate::exhibits::replicates::Averages;
use crate::measure::{Options, cell_seed};
use crate::problems::Rgb;
use ratiocv_core::moments::{Comoments, Merge};
use ratiocv_core::{Estimator, Fit, Integrals, Lanes, Plain, RatioOfMeans, RegressionRatio, Spectrum};
use ratiocv_threads::{map_chunks, merge_tree, stream};

/// A picture: a floor under coloured lamps, in shadows that the auxiliary ignores.
///
/// In each pixel f is the light from a point of a lamp, drawn by luminance, and h the same without what
/// stands in the way, H in closed form. In the light f = h and every ratio is exact. In a shadow, the exponent
/// α of ȳ(H/x̄)^α (Lu et al. 2025, supplement, Eq. 22) is learned from the pixel's own draws, or from those of
/// the (2·[`REACH`]+1)² pixels around.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Shadow {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Draws per pixel.
    pub draws: u64,
    /// Independent pictures.
    pub replicates: u64,
    /// The picture, to compare with.
    #[serde(skip)]
    pub exact: Vec<[f64; 3]>,
    /// The estimators.
    pub estimators: Vec<Shaded>,
    /// The mean α that the pixels learned by themselves, per channel.
    #[serde(skip)]
    pub alpha: Vec<[f64; 3]>,
    /// The same, learned from the neighbourhood.
    #[serde(skip)]
    pub shared_alpha: Vec<[f64; 3]>,
}

/// One estimator of [`Shadow`].
#[derive(Clone, Debug, serde::Serialize)]
pub struct Shaded {
    /// Its id.
    pub estimator: &'static str,
    /// The first of the pictures that it made.
    #[serde(skip)]
    pub picture: Vec<[f64; 3]>,
    /// The mean squared error of each pixel, over replicates and channels.
    #[serde(skip)]
    pub mse: Vec<f64>,
    /// RMSE over the pixels where some light is missing, and its standard error.
    pub in_shadow: (f64, f64),
    /// RMSE over all others.
    pub in_light: f64,
}

/// The estimators, in the order of their pictures.
const ESTIMATORS: [&str; 4] = ["mc", "ratio", "regression_ratio", "shared_regression_ratio"];
const PIXELS: usize = WIDTH * HEIGHT;
const DRAWS: u64 = 32;
const REPLICATES: u64 = 24;
const QUICK_REPLICATES: u64 = 6;
/// How many pixels away a neighbour may be.
pub const REACH: usize = 2;

type Pixel = Comoments<Rgb>;

/// What one picture, or the sum of several, has to say.
struct Pictures {
    /// Of the first picture.
    values: Vec<[Rgb; 4]>,
    alphas: Vec<[Rgb; 2]>,
    squares: Vec<[f64; 4]>,
    /// MSE over the pixels in shadow, and in the light.
    regions: Averages<Spectrum<f64, 2>, 4>,
}

impl Merge for Pictures {
    fn merge(&mut self, later: &Self) {
        for (mine, theirs) in self.alphas.iter_mut().zip(&later.alphas) {
            *mine = [mine[0] + theirs[0], mine[1] + theirs[1]];
        }
        for (mine, theirs) in self.squares.iter_mut().zip(&later.squares) {
            *mine = core::array::from_fn(|i| mine[i] + theirs[i]);
        }
        self.regions.merge(&later.regions);
    }
}

impl Shadow {
    pub(super) fn measure(options: &Options) -> Self {
        let exact = map_chunks(PIXELS as u64, WIDTH as u64, |row| {
            (row.start..row.start + row.count).map(|pixel| Spot::of_pixel(pixel as usize).exact()).collect::<Vec<_>>()
        })
        .concat();
        let replicates = if options.quick { QUICK_REPLICATES } else { REPLICATES };
        let seed = cell_seed(options.seed, "shadow", DRAWS);
        let parts = map_chunks(replicates, 1, |chunk| picture(seed, chunk.index, &exact));
        let Some(all) = merge_tree(parts) else { unreachable!("there are replicates") };
        let count = replicates as f64;
        let regions = all.regions.estimates();
        let estimators = ESTIMATORS.iter().enumerate().map(|(i, estimator)| {
            let rmse = |region: usize| libm::sqrt(regions[i].value[region]);
            Shaded {
                estimator,
                picture: all.values.iter().map(|values| values[i].0).collect(),
                mse: all.squares.iter().map(|squares| squares[i] / count).collect(),
                in_shadow: (rmse(0), regions[i].std_error[0] / (2.0 * rmse(0))),
                in_light: rmse(1),
            }
        });
        let mean_alpha = |which: usize| all.alphas.iter().map(|alphas| (alphas[which] / Rgb::splat(count)).0).collect();
        Self {
            width: WIDTH,
            height: HEIGHT,
            draws: DRAWS,
            replicates,
            exact: exact.iter().map(|rgb| rgb.0).collect(),
            estimators: estimators.collect(),
            alpha: mean_alpha(0),
            shared_alpha: mean_alpha(1),
        }
    }
}

/// Picture number `number`, by all estimators, from the same draws.
fn picture(seed: u64, number: u64, exact: &[Rgb]) -> Pictures {
    let pixels: Vec<Pixel> = (0..PIXELS)
        .map(|pixel| {
            let mut moments = Pixel::default();
            let rng = &mut stream(seed, number * PIXELS as u64 + pixel as u64);
            Spot::of_pixel(pixel).accumulate(&mut moments, DRAWS, rng);
            moments
        })
        .collect();
    let around = neighbourhoods(&pixels);
    let (mut values, mut alphas, mut squares) = (vec![], vec![], vec![]);
    let (mut sums, mut counts) = ([Spectrum([0.0; 2]); 4], [0.0; 2]);
    for pixel in 0..PIXELS {
        let (moments, f) = (&pixels[pixel], exact[pixel]);
        let h = Spot::of_pixel(pixel).unshadowed();
        let integrals = Integrals::new([h]);
        let [own, shared] = [moments, &around[pixel]].map(|draws| RegressionRatio::default().learn(draws, &integrals));
        let estimates = [
            Plain.estimate_anyway(moments, &integrals).value,
            RatioOfMeans.estimate_anyway(moments, &integrals).value,
            own.estimate_anyway(moments, &integrals).value,
            shared.estimate_anyway(moments, &integrals).value,
        ];
        let region = if f == h { 1 } else { 0 };
        counts[region] += 1.0;
        let mse = estimates.map(|value| {
            let error = value - f;
            (0..3).map(|channel| error[channel] * error[channel]).sum::<f64>() / 3.0
        });
        for (sum, mse) in sums.iter_mut().zip(mse) {
            sum[region] += mse;
        }
        values.push(estimates);
        alphas.push([own, shared].map(|learned| learned.coefficients[0]));
        squares.push(mse);
    }
    let mut regions = Averages::new();
    regions.add(sums.map(|sum| sum / Spectrum(counts)));
    Pictures { values, alphas, squares, regions }
}

/// The moments of each pixel merged with those of the pixels up to [`REACH`] rows and columns away.
fn neighbourhoods(pixels: &[Pixel]) -> Vec<Pixel> {
    let reach = |i: usize, size: usize| i.saturating_sub(REACH)..(i + REACH + 1).min(size);
    let merged = |parts: &mut dyn Iterator<Item = &Pixel>| {
        parts.fold(Pixel::default(), |mut sum, part| {
            sum.merge(part);
            sum
        })
    };
    let rows: Vec<Pixel> = (0..PIXELS)
        .map(|pixel| {
            let (row, column) = (pixel / WIDTH, pixel % WIDTH);
            merged(&mut reach(column, WIDTH).map(|column| &pixels[row * WIDTH + column]))
        })
        .collect();
    (0..PIXELS)
        .map(|pixel| {
            let (row, column) = (pixel / WIDTH, pixel % WIDTH);
            merged(&mut reach(row, HEIGHT).map(|row| &rows[row * WIDTH + column]))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratiocv_core::moments::Moments;

    #[test]
    fn learning_helps_in_the_shadow_and_does_no_harm_in_the_light() {
        let shadow = Shadow::measure(&Options { quick: true, ..Options::default() });
        let [plain, ratio, own, shared] = [0, 1, 2, 3].map(|i| &shadow.estimators[i]);
        // Of six pictures; the seed is fixed. An α of the pixel's own is noisy.
        for (better, worse, least) in [(own, plain, 6.0), (own, ratio, 3.0), (shared, ratio, 6.0)] {
            let noise = libm::hypot(better.in_shadow.1, worse.in_shadow.1);
            let z = (worse.in_shadow.0 - better.in_shadow.0) / noise;
            assert!(z > least, "{} and {}: {z}", better.estimator, worse.estimator);
        }
        // An α from beyond the edge of a shadow harms a little.
        for (shaded, most) in [(ratio, 1e-12), (own, 1e-12), (shared, 1e-3)] {
            assert!(shaded.in_light <= most && plain.in_light > 0.1, "{}: {}", shaded.estimator, shaded.in_light);
        }
    }

    #[test]
    fn neighbourhoods_hold_what_is_near() {
        let mut pixels = vec![Pixel::default(); PIXELS];
        let rng = &mut stream(1, 1);
        Spot::of_pixel(0).accumulate(&mut pixels[3 * WIDTH + 5], 7, rng);
        let around = neighbourhoods(&pixels);
        for (pixel, moments) in around.iter().enumerate() {
            let near = (pixel / WIDTH).abs_diff(3) <= REACH && (pixel % WIDTH).abs_diff(5) <= REACH;
            assert_eq!(moments.count(), if near { 7 } else { 0 });
        }
    }
}
