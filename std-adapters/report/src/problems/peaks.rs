//! Gaussian peaks in four dimensions, one per channel.

use crate::problems::truncated::TruncatedLogistic;
use crate::problems::{Axis, Curve, Description, PeaksBlock, Role, Solved, Source};
use core::f64::consts::PI;
use rand_core::Rng;
use ratiocv_core::moments::{Accumulate, BLOCK};
use ratiocv_core::{Draw, Integrals, Problem, Proposal, Spectrum, WithIntegral, unit_interval};
use ratiocv_simd::functions::Elementary;
use ratiocv_simd::{Work, at_best_level};

/// See [`Description`] for what it shows.
#[derive(Clone, Copy, Debug)]
pub struct Peaks;

type Channels = Spectrum<f64, 3>;
type Position = [f64; 4];

const CENTRES: [Position; 3] = [[0.5, 0.5, 0.5, 0.5], [0.4, 0.6, 0.5, 0.45], [0.7, 0.35, 0.6, 0.55]];
/// f_k = exp(−SHARPNESS |x − c_k|²), a Gaussian of standard deviation 0.1.
const SHARPNESS: f64 = 50.0;
/// A logistic density of this scale is a little wider than the Gaussian, and has heavier tails.
const SCALE: f64 = 0.06;

/// A density about each centre: the product of four logistic ones.
type Densities = [[TruncatedLogistic; 4]; 3];

fn densities() -> Densities {
    CENTRES.map(|centre| centre.map(|c| TruncatedLogistic::new(c, SCALE)))
}

/// A position and the three densities there, which the proposal and h both need.
type Point = (Position, Channels);

/// The mean of the channels' densities.
#[derive(Clone, Copy, Debug)]
struct Mixture(Densities);

impl Mixture {
    fn at(&self, x: Position) -> Point {
        (x, Spectrum(self.0.map(|density| (0..4).fold(1.0, |product, i| product * density[i].pdf(x[i])))))
    }
}

impl Proposal for Mixture {
    type Point = Point;
    #[inline]
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Point {
        let component = &self.0[(unit_interval(rng) * 3.0) as usize];
        self.at(core::array::from_fn(|i| component[i].quantile(unit_interval(rng))))
    }
    #[inline]
    fn pdf(&self, (_, densities): &Point) -> f64 {
        (densities[0] + densities[1] + densities[2]) / 3.0
    }
}

fn peak(x: &Position, centre: &Position) -> f64 {
    let squares = (0..4).fold(0.0, |sum, i| sum + (x[i] - centre[i]) * (x[i] - centre[i]));
    libm::exp(-SHARPNESS * squares)
}

impl Peaks {
    /// Many draws at a time, from the same uniform numbers: what [`Solved::source`] uses, and `f32` draws.
    ///
    /// ```
    /// use ratiocv_report::problems::Peaks;
    /// use ratiocv_simd::{Xoshiro16, functions::Elementary};
    /// let uniforms = f32::unit_intervals(&mut Xoshiro16::stream(1, 0));
    /// let (mut f, mut h) = ([[0.0; 64]; 3], [[0.0; 64]; 3]);
    /// Peaks.block::<f32>().draws(&uniforms, &mut f, &mut h);
    /// assert!(f.as_flattened().iter().chain(h.as_flattened()).all(|x| x.is_finite()));
    /// ```
    pub fn block<T: Elementary>(&self) -> PeaksBlock<T> {
        PeaksBlock::new(CENTRES, SCALE, SHARPNESS)
    }

    /// One draw at a time, straight from the formulas: what the blocks are compared with.
    pub fn one_by_one(&self) -> impl Source<Value = Spectrum<f64, 3>> {
        Problem::new(|(x, _): &Point| Spectrum(CENTRES.map(|centre| peak(x, &centre))))
            .auxiliary(WithIntegral::new(|(_, densities): &Point| *densities, Spectrum([1.0; 3])))
            .proposal(Mixture(densities()))
    }
}

/// Yields the draws a block at a time.
struct Blocks(PeaksBlock<f64>);

impl Blocks {
    /// Not inlined, so that all estimators share it.
    #[inline(never)]
    fn draws<const N: usize, R: Rng + ?Sized>(&self, rng: &mut R) -> [Draw<Channels>; N] {
        at_best_level(BlockOf { peaks: &self.0, rng })
    }
}

/// A block of draws, to be made with the best instructions of the machine.
struct BlockOf<'a, R: ?Sized, const N: usize> {
    peaks: &'a PeaksBlock<f64>,
    rng: &'a mut R,
}

impl<R: Rng + ?Sized, const N: usize> Work for BlockOf<'_, R, N> {
    type Output = [Draw<Channels>; N];
    #[inline(always)]
    fn run(self) -> Self::Output {
        let (mut f, mut h) = ([[0.0; N]; 3], [[0.0; N]; 3]);
        self.peaks.draws(&f64::unit_intervals(self.rng), &mut f, &mut h);
        let channels = |rows: &[[f64; N]; 3], i: usize| Spectrum([rows[0][i], rows[1][i], rows[2][i]]);
        core::array::from_fn(|i| Draw::new(channels(&f, i), channels(&h, i)))
    }
}

impl Source for Blocks {
    type Value = Channels;
    fn integrals(&self) -> Integrals<Channels> {
        Integrals::new([Spectrum([1.0; 3])])
    }
    fn accumulate<M: Accumulate<Draw<Channels>>, R: Rng + ?Sized>(&self, moments: &mut M, draws: u64, rng: &mut R) {
        let (mut left, mut block, mut next) = (draws, [Draw::ZERO; BLOCK], BLOCK);
        moments.add_from(draws, || {
            if next == BLOCK && left < BLOCK as u64 {
                return self.draws::<1, R>(rng)[0];
            }
            if next == BLOCK {
                (block, next) = (self.draws(rng), 0);
            }
            (left, next) = (left - 1, next + 1);
            block[next - 1]
        });
    }
}

impl Solved for Peaks {
    type Value = Channels;
    const UNIFORMS: usize = 5;
    const DESCRIPTION: Description = Description {
        id: "peaks-4d",
        title: "Three peaks in four dimensions",
        formula: "f_k = exp(−50|x − c_k|²) on [0, 1]⁴, c = (.5, .5, .5, .5), (.4, .6, .5, .45), (.7, .35, .6, .55); \
                  h_k = p_k, a product of logistic densities about c_k; x has the density g = (p_1 + p_2 + p_3)/3",
        why: "Several dimensions, a mixture that must serve all channels, and an auxiliary that has the right place but \
              not the right shape.",
    };

    fn exact(&self) -> Channels {
        let root = libm::sqrt(SHARPNESS);
        let side = |c: f64| libm::sqrt(PI) / (2.0 * root) * (libm::erf(root * (1.0 - c)) + libm::erf(root * c));
        Spectrum(CENTRES.map(|centre| centre.into_iter().fold(1.0, |product, c| product * side(c))))
    }
    fn source(&self) -> impl Source<Value = Channels> {
        Blocks(self.block())
    }
    fn channel(&self, channel: usize) -> String {
        format!("peak {}", channel + 1)
    }
    fn curves(&self) -> (Axis, Vec<Curve>) {
        let (mixture, exact) = (Mixture(densities()), self.exact());
        let mut curves = Vec::new();
        for (k, centre) in CENTRES.into_iter().enumerate() {
            // Along the first axis, through the peak.
            let through = |x: f64| [x, centre[1], centre[2], centre[3]];
            let f = |x| peak(&through(x), &centre) / exact[k];
            curves.push(Curve::of(self.channel(k), k, Role::Integrand, f));
            let h = |x| mixture.at(through(x)).1[k];
            curves.push(Curve::of(self.channel(k), k, Role::Auxiliary, h));
        }
        ("first coordinate, through each peak", curves)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratiocv_threads::stream;

    /// Keeps draws instead of moments.
    #[derive(Default)]
    struct Kept(Vec<Draw<Channels>>);

    impl Accumulate<Draw<Channels>> for Kept {
        fn add(&mut self, draw: Draw<Channels>) {
            self.0.push(draw);
        }
        fn add_batch(&mut self, draws: &[Draw<Channels>]) {
            self.0.extend_from_slice(draws);
        }
    }

    fn kept(source: &impl Source<Value = Channels>, draws: u64, rng: &mut impl Rng) -> Vec<Draw<Channels>> {
        let mut kept = Kept::default();
        source.accumulate(&mut kept, draws, rng);
        kept.0
    }

    /// Largest error of any number of any draw, as a fraction of it.
    fn difference(draws: &[Draw<Channels>], right: &[Draw<Channels>]) -> f64 {
        assert_eq!(draws.len(), right.len());
        let numbers = |draw: &Draw<Channels>| [draw.f, draw.h[0]].map(|x| [x[0], x[1], x[2]]);
        let mut worst = 0.0;
        for (draw, right) in draws.iter().zip(right) {
            for (x, right) in numbers(draw).as_flattened().iter().zip(numbers(right).as_flattened()) {
                let error = (x / right - 1.0).abs();
                assert!(error.is_finite(), "{x} instead of {right}");
                worst = f64::max(worst, error);
            }
        }
        worst
    }

    #[test]
    fn blocks_are_the_same_draws_to_eleven_digits() {
        // The scalar form is the less exact one: of 1 − p near p = 1 it keeps twelve digits.
        let (mut numbers, mut same) = (stream(1, 0), stream(1, 0));
        let right = kept(&Peaks.one_by_one(), 100_003, &mut same);
        let worst = difference(&kept(&Peaks.source(), 100_003, &mut numbers), &right);
        assert!(worst <= 1e-11, "{worst:e}");
        assert_eq!(numbers.next_u64(), same.next_u64(), "five numbers a draw");
    }

    #[test]
    fn a_draw_is_the_same_bits_in_a_block_and_alone() {
        let (mut numbers, mut same) = (stream(2, 0), stream(2, 0));
        let mut one_by_one = vec![];
        for _ in 0..640 {
            one_by_one.extend(kept(&Peaks.source(), 1, &mut same));
        }
        assert_eq!(kept(&Peaks.source(), 640, &mut numbers), one_by_one);
    }

    #[test]
    fn f32_draws_are_those_of_f64_to_four_digits() {
        let mut rng = stream(3, 0);
        let (block, coarse) = (Peaks.block::<f64>(), Peaks.block::<f32>());
        let mut worst = 0.0;
        for _ in 0..1000 {
            let uniforms: [[f32; 64]; 5] = f32::unit_intervals(&mut rng);
            let (mut f, mut h, mut f32s, mut h32s) = ([[0.0; 64]; 3], [[0.0; 64]; 3], [[0.0; 64]; 3], [[0.0; 64]; 3]);
            block.draws(&uniforms.map(|row| row.map(f64::from)), &mut f, &mut h);
            coarse.draws(&uniforms, &mut f32s, &mut h32s);
            for (right, x) in [(f, f32s), (h, h32s)] {
                for (right, x) in right.as_flattened().iter().zip(x.as_flattened()) {
                    let error = (f64::from(*x) / right - 1.0).abs();
                    assert!(error.is_finite(), "{x} instead of {right}");
                    worst = f64::max(worst, error);
                }
            }
        }
        assert!(worst <= 1e-4, "{worst:e}");
    }

    #[test]
    fn the_ends_of_the_unit_interval_are_ordinary() {
        let block = Peaks.block::<f64>();
        for choice in [0.0, 0.4, 1.0 - f64::EPSILON / 2.0] {
            for u in [0.0, 1.0 - f64::EPSILON / 2.0] {
                let (mut f, mut h) = ([[0.0]; 3], [[0.0]; 3]);
                block.draws(&[[choice], [u], [u], [u], [u]], &mut f, &mut h);
                let [f, h] = [f, h].map(|x| x.map(|row| row[0]));
                // The last number before 1 falls short of it by some 10⁻¹² in x.
                let x = if u == 0.0 { [0.0; 4] } else { [1.0; 4] };
                let (x, densities) = Mixture(densities()).at(x);
                let pdf = (densities[0] + densities[1] + densities[2]) / 3.0;
                for k in 0..3 {
                    let right = (peak(&x, &CENTRES[k]) / pdf, densities[k] / pdf);
                    assert!(
                        (f[k] / right.0 - 1.0).abs() <= 1e-9 && (h[k] / right.1 - 1.0).abs() <= 1e-9,
                        "{f:?} {h:?}"
                    );
                }
            }
        }
    }
}
