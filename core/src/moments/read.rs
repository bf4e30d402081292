//! What an estimator may ask of one channel's moments: one small trait per capability, so that one
//! richer accumulator serves several estimators in one pass.

use core::array;

/// Means of f and of `K` auxiliaries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Means<const K: usize = 1> {
    /// The mean of f.
    pub f: f64,
    /// The mean of each auxiliary.
    pub h: [f64; K],
}

/// Sums of products about the means, of f's residual e = f − Σ_k slope_k·h_k and of each h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread<const K: usize = 1> {
    /// The slopes that the residuals are about.
    pub slope: [f64; K],
    /// Σ(e − ē)². NaN where it underflowed, infinite where it overflowed.
    pub ee: f64,
    /// Σ(e − ē)(h_k − h̄_k).
    pub eh: [f64; K],
    /// Σ(h_i − h̄_i)(h_k − h̄_k), symmetric. Diagonal: NaN where it underflowed, infinite where it
    /// overflowed.
    pub hh: [[f64; K]; K],
}

impl<const K: usize> Spread<K> {
    /// Of f alone, Σ(f − f̄)² being `ff`; nothing is known of h.
    pub(crate) const fn of_integrand(ff: f64) -> Self {
        Self { slope: [0.0; K], ee: ff, eh: [0.0; K], hh: [[0.0; K]; K] }
    }

    /// Σ((f − f̄) − Σ_k c_k(h_k − h̄_k))²: never negative, and without cancellation near the
    /// least-squares c.
    pub fn about(&self, c: &[f64; K]) -> f64 {
        let turn: [f64; K] = array::from_fn(|k| self.slope[k] - c[k]);
        let mut sum = self.ee;
        // With a turn of 0 an overflowed square of that h does not matter.
        for k in (0..K).filter(|k| turn[*k] != 0.0) {
            let along: f64 = (0..K).filter(|j| turn[*j] != 0.0).map(|j| turn[j] * self.hh[k][j]).sum();
            sum += turn[k] * (2.0 * self.eh[k] + along);
        }
        if sum < 0.0 { 0.0 } else { sum }
    }

    /// The sum of squares that rounding alone may make, for draws of twice the unit roundoff `epsilon`.
    pub(crate) fn rounding_floor(&self, epsilon: f64) -> f64 {
        // What the rounding of sums over a block may leave of draws that are proportional but
        // for rounding: over the 10⁴ blocks of f32 of tests/stiff, C7, the median is 2 unit
        // roundoffs of the spread of f, the worst 36; 64 are allowed.
        let scale = 32.0 * epsilon;
        let fitted: f64 = (0..K).map(|k| self.slope[k] * self.slope[k] * self.hh[k][k]).sum();
        scale * scale * (self.ee + fitted)
    }

    /// Σ(f − f̄)².
    pub fn ff(&self) -> f64 {
        self.about(&[0.0; K])
    }

    /// Σ(f − f̄)(h_k − h̄_k); panics if there is no auxiliary `k`.
    pub fn fh(&self, k: usize) -> f64 {
        self.eh[k] + (0..K).map(|j| self.slope[j] * self.hh[k][j]).sum::<f64>()
    }
}

/// What the diagnostic tier knows beside the moments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tails {
    /// Σ|f|.
    pub abs_f: f64,
    /// Σ|h|.
    pub abs_h: f64,
    /// The largest |f|.
    pub max_f: f64,
    /// Draws with h = 0 and f = 0: r was taken as 0 there.
    pub nothing: u64,
    /// Draws with h = 0 and f ≠ 0: f/h is unbounded there.
    pub unbounded: u64,
}

/// Means; and, from the error-bar tier on, the spread.
pub trait HasMeans<const K: usize = 1> {
    /// The means of `count` draws.
    fn means(&self, count: u64) -> Means<K>;
    /// The spread, if these moments keep it.
    fn spread(&self) -> Option<Spread<K>> {
        None
    }
    /// The tails, if these moments keep them.
    fn tails(&self) -> Option<Tails> {
        None
    }
}

/// Second co-moments of f and `K` auxiliaries.
pub trait HasComoments<const K: usize = 1>: HasMeans<K> {
    /// The spread.
    fn comoments(&self) -> Spread<K>;
}

/// Moments of r = f/h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RatioMoments {
    /// The mean of r: not finite if a draw had h = 0 ≠ f.
    pub mean: f64,
    /// Σ(r − r̄)², if kept.
    pub squares: Option<f64>,
}

/// The mean of the ratios f/h′ on a raw or a defensive auxiliary.
pub trait HasRatioMean {
    /// The ratios on the auxiliary of defensive weight `weight` (0: raw) and known integral
    /// `integral`; `None` if these moments were accumulated for another one.
    fn ratio(&self, weight: f64, integral: f64) -> Option<RatioMoments>;
}

/// One group's draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Group<const K: usize = 1> {
    /// How many.
    pub count: u64,
    /// The mean of f.
    pub f: f64,
    /// The mean of each auxiliary.
    pub h: [f64; K],
}

/// Means of groups of draws, dealt round robin.
pub trait HasGroups<const K: usize = 1> {
    /// The number of groups.
    fn groups(&self) -> usize;
    /// Group `group` of a stream of `count` draws; panics if there is no such group.
    fn group(&self, count: u64, group: usize) -> Group<K>;
}

/// Means of groups of `K` pairs (f, h), dealt round robin.
pub trait HasPairs<const K: usize> {
    /// The number of groups.
    fn groups(&self) -> usize;
    /// Pair `pair` of group `group` of a stream of `count` draws; panics if there is none.
    fn group_of_pair(&self, count: u64, pair: usize, group: usize) -> Group;
}

/// Moments of the even- and of the odd-numbered draws.
pub trait HasFolds {
    /// The moments of a fold.
    type Fold;
    /// Fold `fold`, (N + 1 − fold)/2 draws of N; panics unless it is 0 or 1.
    fn fold(&self, fold: usize) -> &Self::Fold;
}

/// Third central moments, as sums, of f and h about their means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThirdMoments {
    /// Σ(h − h̄)³.
    pub hhh: f64,
    /// Σ(h − h̄)²(f − f̄).
    pub hhf: f64,
    /// Σ(h − h̄)(f − f̄)².
    pub hff: f64,
}

/// Third moments: what second-order predictions read.
pub trait HasThirdMoments {
    /// The sums of third powers.
    fn third(&self) -> ThirdMoments;
}
