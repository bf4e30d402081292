//! What an estimator may ask of one channel's moments: one small trait per capability, so that one
//! richer accumulator serves several estimators in one pass.

/// Means of f and of `K` auxiliaries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Means<const K: usize = 1> {
    /// The mean of f.
    pub f: f64,
    /// The mean of each auxiliary.
    pub h: [f64; K],
}

/// Sums of products about the means, of f's residual e = f − slope·h and of h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The slope that the residuals are about.
    pub slope: f64,
    /// Σ(e − ē)². NaN where it underflowed, infinite where it overflowed.
    pub ee: f64,
    /// Σ(e − ē)(h − h̄).
    pub eh: f64,
    /// Σ(h − h̄)². NaN where it underflowed, infinite where it overflowed.
    pub hh: f64,
}

impl Spread {
    /// Σ((f − f̄) − c(h − h̄))²: never negative, and without cancellation near the least-squares c.
    pub fn about(&self, c: f64) -> f64 {
        let turn = self.slope - c;
        // With turn = 0 an overflowed hh does not matter.
        let rest = if turn == 0.0 { 0.0 } else { turn * (2.0 * self.eh + turn * self.hh) };
        let sum = self.ee + rest;
        if sum < 0.0 { 0.0 } else { sum }
    }

    /// Σ(f − f̄)².
    pub fn ff(&self) -> f64 {
        self.about(0.0)
    }

    /// Σ(f − f̄)(h − h̄).
    pub fn fh(&self) -> f64 {
        self.eh + self.slope * self.hh
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
    fn spread(&self) -> Option<Spread> {
        None
    }
    /// The tails, if these moments keep them.
    fn tails(&self) -> Option<Tails> {
        None
    }
}

/// Second co-moments of f and one auxiliary.
pub trait HasComoments: HasMeans<1> {
    /// The spread.
    fn comoments(&self) -> Spread;
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
pub struct Group {
    /// How many.
    pub count: u64,
    /// The mean of f.
    pub f: f64,
    /// The mean of the auxiliary.
    pub h: f64,
}

/// Means of groups of draws, dealt round robin.
pub trait HasGroups {
    /// The number of groups.
    fn groups(&self) -> usize;
    /// Group `group` of a stream of `count` draws; panics if there is no such group.
    fn group(&self, count: u64, group: usize) -> Group;
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
