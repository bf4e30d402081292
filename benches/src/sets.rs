//! Work on the same draws, side by side: ours, by hand, other libraries, a naive loop.
//!
//! A contender's answer is compared with the scalar reference after its first pass and after its third; a
//! wrong one panics. What the CPU cannot run is said on stderr and left out.

use crate::answer::Answer;
use crate::contender::{Contender, Measured};
use crate::draws::Draws;
#[cfg(target_arch = "x86_64")]
use crate::kernels::by_hand;
use crate::kernels::naive::Naive;
use crate::kernels::ours::{self, Ours};
use crate::kernels::{average::Average, ndarray_stats::NdarrayStats, statrs::Statrs};
use ratiocv_core::moments::{Accumulate, Comoments, Moments, RatioMean, RatioVariance, Sums};
use ratiocv_core::{Draw, HartleyRoss, Integrals, Lanes, Reads, Spectrum};
use std::rc::Rc;

/// Draws that 16 channels of f and h in `f32` make 16 KiB of: they stay in L1.
pub const IN_L1: usize = 128;
/// Draws that make 128 KiB, beyond L1.
pub const IN_L2: usize = 1024;

/// What each rounding in `f32` may cost, of a moment's scale: unit roundoff (a sum of n terms is off by at most
/// n of them; Higham 1993), times 4, because squares about the first draw add up to so much more than those
/// about the mean, times 2, because ours come in two parts, the residual's and the auxiliary's.
const SINGLE: f64 = 8.0 / (1 << 24) as f64;
/// The same in `f64`, and 1000 times as much for raw sums, where the mean is large beside the spread.
const DOUBLE: f64 = 8000.0 / (1_u64 << 53) as f64;

/// A contender passes so often over the draws before its answer is compared for the last time.
const CHECKED_PASSES: usize = 3;

/// Everything, from sets of `draws` draws.
pub fn all(draws: usize) -> Vec<Measured> {
    let sets = [comoments("comoments", draws), pixels(draws), sums(draws), ratios(draws)];
    sets.into_iter().flatten().collect()
}

/// Five co-moments of 16 channels.
pub fn comoments(name: &'static str, draws: usize) -> Vec<Measured> {
    let set = Set::<Spectrum<f32, 16>>::singles(name, draws);
    let (statrs, ndarray_stats) = (Statrs::new(&set.draws), NdarrayStats::new(&set.draws));
    let set = set
        .with_ours("ours", SINGLE, Comoments::default(), ours::comoments)
        .with("naive", DOUBLE, Naive::default())
        .with("average", DOUBLE, Average::<16, 1>::default())
        .with("statrs", DOUBLE, statrs)
        .with("ndarray-stats", DOUBLE, ndarray_stats);
    #[cfg(target_arch = "x86_64")]
    let set = set
        .with("naive-sse2", DOUBLE, by_hand::NaiveSse2::default())
        .with_if("avx2", "AVX2", SINGLE, by_hand::Avx2::new())
        .with_if("avx2-bare", "AVX2", SINGLE, by_hand::BareAvx2::new())
        .with_if("avx512", "AVX-512", SINGLE, by_hand::Avx512::new())
        .with_if("avx512-bare", "AVX-512", SINGLE, by_hand::BareAvx512::new());
    set.contenders
}

/// Five co-moments of one channel and of three, eight pixels in the lanes of a pack.
pub fn pixels(draws: usize) -> Vec<Measured> {
    let one = Set::<Spectrum<f32, 8>>::singles("pixels-1", draws)
        .with_ours("ours", SINGLE, Comoments::default(), ours::comoments)
        .with("average", DOUBLE, Average::<1, 8>::default());
    let three = Set::<Spectrum<Spectrum<f32, 8>, 3>>::singles("pixels-3", draws)
        .with_ours("ours", SINGLE, Comoments::default(), ours::comoments)
        .with("average", DOUBLE, Average::<3, 8>::default());
    one.contenders.into_iter().chain(three.contenders).collect()
}

/// Means of f and h of 16 channels.
pub fn sums(draws: usize) -> Vec<Measured> {
    let set = Set::<Spectrum<f32, 16>>::singles("sums", draws).with_ours("ours", SINGLE, Sums::default(), ours::means);
    #[cfg(target_arch = "x86_64")]
    let set = set.with_if("raw-sums", "AVX2", SINGLE, by_hand::RawSums::new());
    set.contenders
}

/// What has f/h in it, of 16 channels in `f32` and in `f64`.
pub fn ratios(draws: usize) -> Vec<Measured> {
    let singles = Set::<Spectrum<f32, 16>>::singles("ratios-f32", draws).with_ratios(SINGLE);
    let doubles = Set::<Spectrum<f64, 16>>::doubles("ratios-f64", draws).with_ratios(DOUBLE);
    #[cfg(target_arch = "x86_64")]
    let (singles, doubles) = (
        singles.with_if("divider", "AVX2", SINGLE, by_hand::Divider::<f32>::new()),
        doubles.with_if("divider", "AVX2", DOUBLE, by_hand::Divider::<f64>::new()),
    );
    singles.contenders.into_iter().chain(doubles.contenders).collect()
}

/// Contenders for the same draws.
struct Set<V> {
    name: &'static str,
    draws: Rc<Draws<V>>,
    right: Vec<Answer>,
    contenders: Vec<Measured>,
}

impl<V: Lanes<Scalar = f32> + 'static> Set<V> {
    fn singles(name: &'static str, count: usize) -> Self {
        Self::of(name, Draws::new(count, |x| x as f32))
    }
}

impl<V: Lanes<Scalar = f64> + 'static> Set<V> {
    fn doubles(name: &'static str, count: usize) -> Self {
        Self::of(name, Draws::new(count, |x| x))
    }
}

impl<V: Lanes + 'static> Set<V> {
    fn of(name: &'static str, draws: Draws<V>) -> Self {
        Self { name, right: Answer::reference(&draws), draws: Rc::new(draws), contenders: Vec::new() }
    }

    /// Adds a contender; panics if its answer is off by more than `rounding` for each draw of all passes and two.
    fn with(mut self, id: &str, rounding: f64, mut contender: impl Contender<Draw<V>> + 'static) -> Self {
        let (set, draws) = (self.name, self.draws.clone());
        let tolerance = rounding * (CHECKED_PASSES * draws.len() + 2) as f64;
        for passes in [1, CHECKED_PASSES - 1] {
            for _ in 0..passes {
                contender.pass(&draws);
            }
            let answers = contender.answer();
            assert_eq!(answers.len(), V::LANES, "{set}/{id} answers for other channels");
            for (channel, (answer, right)) in answers.iter().zip(&self.right).enumerate() {
                answer.check(right, tolerance, &format!("{set}/{id}, channel {channel}"));
            }
        }
        let samples = draws.len() * V::LANES;
        let pass = Box::new(move || contender.pass(core::hint::black_box(&**draws)));
        self.contenders.push(Measured { set, id: id.into(), samples, pass });
        self
    }

    /// Adds a contender if the CPU has what it needs, and says so if not.
    #[cfg(target_arch = "x86_64")]
    fn with_if(
        self,
        id: &str,
        needs: &str,
        rounding: f64,
        contender: Option<impl Contender<Draw<V>> + 'static>,
    ) -> Self {
        match contender {
            Some(contender) => self.with(id, rounding, contender),
            None => {
                eprintln!("{}/{id} is left out: it needs {needs}, which this CPU does not offer", self.name);
                self
            }
        }
    }

    /// Adds one of our accumulators, as this build compiles it and as the machine's level is picked at run time.
    fn with_ours<M>(self, id: &str, rounding: f64, moments: M, read: fn(&M::Channel, f64) -> Answer) -> Self
    where
        M: Accumulate<Draw<V>> + Moments + Copy + 'static,
        M::Channel: 'static,
    {
        let dispatched = Ours::fed_by(moments, ratiocv_simd::add_batch, read);
        self.with(id, rounding, Ours::new(moments, read)).with(&format!("{id}-dispatched"), rounding, dispatched)
    }

    /// Adds our accumulators with ratios in them.
    fn with_ratios(self, rounding: f64) -> Self {
        let none = Integrals::ONE;
        self.with_ours("ours-ratio-mean", rounding, RatioMean::default(), ours::ratios)
            .with_ours("ours-ratio-variance", rounding, RatioVariance::default(), ours::ratios)
            .with_ours("ours-hartley-ross", rounding, HartleyRoss.value(&none), ours::means_and_ratio)
            .with_ours("ours-hartley-ross-error-bar", rounding, HartleyRoss.error_bar(&none), ours::comoments_and_ratio)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Takes the first draw for the mean.
    struct FirstDraw(Vec<Answer>);

    impl Contender<Draw<f64>> for FirstDraw {
        fn pass(&mut self, draws: &[Draw<f64>]) {
            self.0 = vec![Answer { f: Some(draws[0].f), ..Answer::default() }];
        }
        fn answer(&self) -> Vec<Answer> {
            self.0.clone()
        }
    }

    #[test]
    #[should_panic(expected = "test/wrong, channel 0: mean of f")]
    fn a_wrong_contender_is_not_measured() {
        let _ = Set::<f64>::doubles("test", 8).with("wrong", DOUBLE, FirstDraw(Vec::new()));
    }

    #[test]
    fn all_are_right_on_any_number_of_draws() {
        for draws in [1, 2, 5, 64, 65, 1000] {
            assert!(all(draws).len() > 15);
        }
    }
}
