//! Estimators by name, and what pixels ask of them.

use crate::colour::Colour;
use core::fmt::Debug;
use ratiocv_core::moments::{Accumulate, Merge, Moments, Save};
use ratiocv_core::{
    Choose, Defensive, Draw, Estimate, Estimator, Fit, HartleyRoss, Integrals, Lanes, Mickey, Plain, RatioOfMeans,
    Reads, RegressionRatio, Spectrum, Tin,
};

/// The defensive weight unless another is given: 5 % of the gain where the auxiliary is good, and no
/// pixel divided by next to nothing.
pub(crate) const WEIGHT: f64 = 0.01;

/// How a pixel is estimated from the pairs of each depth and technique.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Method {
    rule: Rule,
    weight: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rule {
    Plain,
    Ratio,
    DefensiveRatio,
    HartleyRoss,
    DefensiveHartleyRoss,
    Mickey,
    DefensiveMickey,
    Tin,
    DefensiveTin,
    RegressionRatio,
    SharedRegressionRatio,
    Choose,
}

/// Names and what they stand for, the recommended one first.
const RULES: [(&str, Rule, &str); 12] = [
    ("defensive_ratio", Rule::DefensiveRatio, "ratio of means on 0.01 + 0.99 h: the default"),
    ("mc", Rule::Plain, "plain Monte Carlo, without auxiliaries"),
    ("ratio", Rule::Ratio, "ratio of means"),
    ("hartley_ross", Rule::HartleyRoss, "unbiased; rarely the best"),
    ("defensive_hartley_ross", Rule::DefensiveHartleyRoss, "the same on the defensive auxiliary"),
    ("mickey", Rule::Mickey, "unbiased, in eight groups"),
    ("defensive_mickey", Rule::DefensiveMickey, "the same on the defensive auxiliary: the best unbiased one"),
    ("tin", Rule::Tin, "ratio of means with most of its bias removed"),
    ("defensive_tin", Rule::DefensiveTin, "the same on the defensive auxiliary"),
    ("regression_ratio", Rule::RegressionRatio, "ratio to a power that each pixel learns"),
    (
        "shared_regression_ratio",
        Rule::SharedRegressionRatio,
        "ratio to a power learned from the 5 x 5 pixels about each; keeps the moments of all pixels",
    ),
    ("choose", Rule::Choose, "plain, ratio or regression, as the draws advise"),
];

impl Default for Method {
    fn default() -> Self {
        Self { rule: Rule::DefensiveRatio, weight: WEIGHT }
    }
}

impl Method {
    /// The method called `name` ("plain" is "mc").
    pub fn named(name: &str) -> Option<Self> {
        let name = if name == "plain" { "mc" } else { name };
        let (_, rule, _) = RULES.iter().find(|(known, ..)| *known == name)?;
        Some(Self { rule: *rule, weight: WEIGHT })
    }

    /// Plain Monte Carlo.
    pub const fn plain() -> Self {
        Self { rule: Rule::Plain, weight: WEIGHT }
    }

    /// With the defensive weight `weight`; `None` unless 0 ≤ `weight` < 1.
    #[must_use]
    pub fn with_weight(self, weight: f64) -> Option<Self> {
        (0.0..1.0).contains(&weight).then_some(Self { weight, ..self })
    }

    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        RULES.iter().map(|(_, rule, _)| Self { rule: *rule, weight: WEIGHT })
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        self.entry().0
    }

    /// What it is, in a few words.
    pub fn summary(&self) -> &'static str {
        self.entry().2
    }

    fn entry(&self) -> &'static (&'static str, Rule, &'static str) {
        RULES.iter().find(|(_, rule, _)| *rule == self.rule).unwrap_or(&RULES[0])
    }

    /// The defensive weight.
    pub const fn weight(&self) -> f64 {
        self.weight
    }

    /// Whether it reads auxiliaries.
    pub fn reads_auxiliaries(&self) -> bool {
        self.rule != Rule::Plain
    }

    /// How many pixels on each side a pixel learns its coefficients from, itself not counted.
    pub fn shared_radius(&self) -> u32 {
        if self.rule == Rule::SharedRegressionRatio { 2 } else { 0 }
    }

    /// Whether it has exponents to show.
    pub fn has_alpha(&self) -> bool {
        matches!(self.rule, Rule::RegressionRatio | Rule::SharedRegressionRatio)
    }

    /// Calls `visitor` with the estimator.
    pub fn visit<V: Visitor>(&self, visitor: V) -> V::Output {
        // The weight was checked when it was given.
        macro_rules! defensive {
            ($estimator:expr) => {
                match $estimator.defensive(self.weight) {
                    Ok(estimator) => visitor.visit(&estimator),
                    Err(_) => visitor.visit(&$estimator),
                }
            };
        }
        match self.rule {
            Rule::Plain => visitor.visit(&Plain),
            Rule::Ratio => visitor.visit(&RatioOfMeans),
            Rule::DefensiveRatio => defensive!(RatioOfMeans),
            Rule::HartleyRoss => visitor.visit(&HartleyRoss),
            Rule::DefensiveHartleyRoss => defensive!(HartleyRoss),
            Rule::Mickey => visitor.visit(&Mickey),
            Rule::DefensiveMickey => defensive!(Mickey),
            Rule::Tin => visitor.visit(&Tin),
            Rule::DefensiveTin => defensive!(Tin),
            Rule::RegressionRatio | Rule::SharedRegressionRatio => visitor.visit(&RegressionRatio::default()),
            Rule::Choose => visitor.visit(&Choose::default()),
        }
    }
}

/// RGB.
pub(crate) type Rgb = Spectrum<f32, 3>;

/// What is done with a method's estimator, whatever its type.
pub trait Visitor {
    /// What comes of it.
    type Output;
    /// Does it.
    fn visit<E: OnPixel<Rgb>>(self, estimator: &E) -> Self::Output;
}

/// An estimator of the pairs of one depth and technique.
///
/// *Implemented by* the estimators of [`Method`]; *called by* [`Pixel`](crate::Pixel).
pub trait OnPixel<C: Colour>: Sync {
    /// What it keeps of a term.
    type Term: Term<C>;
    /// Nothing yet.
    fn empty(&self) -> Self::Term;
    /// The estimate of one term; coefficients are learned from `neighbours` if there are any. The integral of
    /// h is 1.
    fn term(&self, own: &Self::Term, neighbours: Option<&Self::Term>) -> Estimate<C>;
    /// The exponent of each channel, for estimators that have one.
    fn alpha(&self, own: &Self::Term, neighbours: Option<&Self::Term>) -> [f64; 3] {
        let _ = (own, neighbours);
        [f64::NAN; 3]
    }
}

/// What an estimator keeps of a term.
pub trait Term<C: Colour>:
    Accumulate<Draw<C>> + Moments<Lanes = C> + Merge + Save + Copy + Debug + Send + Sync
{
}

impl<C: Colour, M> Term<C> for M where
    M: Accumulate<Draw<C>> + Moments<Lanes = C> + Merge + Save + Copy + Debug + Send + Sync
{
}

macro_rules! on_pixel {
    ($estimator:ty) => {
        impl<C: Colour> OnPixel<C> for $estimator
        where
            <Self as Reads>::Value<C>: Send + Sync,
            Self: Estimator<<<Self as Reads>::Value<C> as Moments>::Channel>,
        {
            type Term = <Self as Reads>::Value<C>;
            fn empty(&self) -> Self::Term {
                self.value(&Integrals::ONE)
            }
            fn term(&self, own: &Self::Term, _: Option<&Self::Term>) -> Estimate<C> {
                self.estimate_anyway(own, &Integrals::ONE)
            }
        }
    };
}

on_pixel!(Plain);
on_pixel!(RatioOfMeans);
on_pixel!(HartleyRoss);
on_pixel!(Mickey);
on_pixel!(Tin);
on_pixel!(Choose);
on_pixel!(Defensive<RatioOfMeans>);
on_pixel!(Defensive<HartleyRoss>);
on_pixel!(Defensive<Mickey>);
on_pixel!(Defensive<Tin>);

impl OnPixel<Rgb> for RegressionRatio {
    type Term = <Self as Reads>::Value<Rgb>;
    fn empty(&self) -> Self::Term {
        self.value(&Integrals::ONE)
    }
    fn term(&self, own: &Self::Term, neighbours: Option<&Self::Term>) -> Estimate<Rgb> {
        match neighbours {
            None => self.estimate_anyway(own, &Integrals::ONE),
            Some(all) => self.learn(all, &Integrals::ONE).estimate_anyway(own, &Integrals::ONE),
        }
    }
    fn alpha(&self, own: &Self::Term, neighbours: Option<&Self::Term>) -> [f64; 3] {
        let [alpha] = self.learn(neighbours.unwrap_or(own), &Integrals::ONE).coefficients;
        core::array::from_fn(|channel| alpha.get(channel))
    }
}
