//! Every estimator by its id: what names in files, pages and on the command line stand for.

use crate::Group;
use ratiocv_core::moments::{
    Blocked, ComomentsBlock, ExtremesBlock, FoldsBlock, GroupsBlock, HasComoments, HasFolds, HasGroups, HasRatioMean,
    Joined, Moments, RatioOf, RatioVariance, ThirdBlock, UnivariateBlock,
};
use ratiocv_core::predict::{Order, Population, Predict, Prediction};
use ratiocv_core::{
    Beale, Choose, CrossFitted, Defensive, Difference, Error, Estimate, Estimator, HartleyRoss, Integrals, Jackknife,
    Lanes, MeanOfRatios, Mickey, OptimalDefensive, Plain, Quenouille, RatioOfMeans, Reads, RegressionRatio, Tin,
};

/// Moments that every estimator of the catalogue can read, so that one pass over the draws serves
/// all of them: ratios on the raw and on one defensive auxiliary, eight groups, and two folds.
pub type Everything<V, E = (), T = ()> = Blocked<V, EverythingBlock<V, E, T>>;

/// The kernel of [`Everything`].
pub type EverythingBlock<V, E, T> = Joined<
    ComomentsBlock<V>,
    [UnivariateBlock<RatioOf<V>, 1>; 2],
    GroupsBlock<V, 8>,
    E,
    T,
    FoldsBlock<ComomentsBlock<V>>,
>;

/// [`Everything`] with tails, for all flags, and third moments, for second-order predictions.
pub type Diagnosed<V> = Everything<V, ExtremesBlock<V>, ThirdBlock<V>>;

/// An empty [`Everything`] or [`Diagnosed`] for defensive estimators of weight `weight`.
///
/// # Errors
/// [`Error::Weight`] unless 0 ≤ `weight` < 1.
pub fn everything<V, E, T>(weight: f64, integrals: &Integrals<V>) -> Result<Everything<V, E, T>, Error>
where
    V: Lanes,
    E: ratiocv_core::moments::Kernel<State: Default>,
    T: ratiocv_core::moments::Kernel<State: Default>,
{
    let defended = RatioVariance::defensive(weight, integrals)?;
    Ok(Blocked::with_ratios(Blocked::both(RatioVariance::default(), defended)))
}

/// What moments must offer for every estimator to read them.
pub trait ServesAll: HasComoments + HasRatioMean + HasGroups + HasFolds<Fold: HasComoments> {}

impl<S: HasComoments + HasRatioMean + HasGroups + HasFolds<Fold: HasComoments>> ServesAll for S {}

/// An estimator, by id.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Method {
    rule: Rule,
    defensive: bool,
}

/// The formula, whatever auxiliary it is applied to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Rule {
    Plain,
    RatioOfMeans,
    Quenouille,
    Beale,
    Tin,
    MeanOfRatios,
    HartleyRoss,
    Mickey,
    Jackknife,
    RegressionRatio,
    OptimalDefensiveRatio,
    OptimalDefensiveMickey,
    Difference,
    CrossFittedDifference,
    Choose,
    ChooseUnbiased,
}

/// Something to be done with an estimator of any type, on its own moments of lanes `V`.
///
/// *Implemented by* whoever measures estimators; *called by* [`Method::visit`].
pub trait Visitor<V: Lanes> {
    /// What comes of it.
    type Output;
    /// Does it.
    fn visit<E>(self, estimator: &E) -> Self::Output
    where
        E: Reads + Predict + Sync + Estimator<<E::ErrorBar<V> as Moments>::Channel>;
}

/// `$body` with `$estimator` bound to the estimator that `$method` stands for: a macro, since each
/// arm has a type of its own.
macro_rules! with_estimator {
    ($method:expr, $weight:expr, $estimator:ident => $body:expr) => {{
        let (method, weight) = ($method, $weight);
        macro_rules! on_auxiliary {
            ($rule:expr) => {
                if method.defensive {
                    let $estimator = &$rule.defensive(weight).unwrap_or_else(|error| panic!("{error}"));
                    $body
                } else {
                    let $estimator = &$rule;
                    $body
                }
            };
        }
        macro_rules! alone {
            ($rule:expr) => {{
                let $estimator = &$rule;
                $body
            }};
        }
        match method.rule {
            Rule::Plain => alone!(Plain),
            Rule::RatioOfMeans => on_auxiliary!(RatioOfMeans),
            Rule::Quenouille => on_auxiliary!(Quenouille),
            Rule::Beale => on_auxiliary!(Beale),
            Rule::Tin => on_auxiliary!(Tin),
            Rule::MeanOfRatios => on_auxiliary!(MeanOfRatios),
            Rule::HartleyRoss => on_auxiliary!(HartleyRoss),
            Rule::Mickey => on_auxiliary!(Mickey),
            Rule::Jackknife => on_auxiliary!(Jackknife),
            Rule::RegressionRatio => alone!(RegressionRatio::default()),
            Rule::OptimalDefensiveRatio => alone!(OptimalDefensive::of(RatioOfMeans)),
            Rule::OptimalDefensiveMickey => alone!(OptimalDefensive::of(Mickey)),
            Rule::Difference => alone!(Difference::default()),
            Rule::CrossFittedDifference => alone!(CrossFitted(Difference::default())),
            Rule::Choose => alone!(Choose::default()),
            Rule::ChooseUnbiased => alone!(CrossFitted(Choose::default())),
        }
    }};
}

fn id<E: Reads>(_: &E) -> &'static str {
    E::ID
}

fn min_draws<E: Reads>(_: &E) -> u64 {
    E::MIN_DRAWS
}

impl Method {
    /// Plain Monte Carlo: what all others are compared with.
    pub const PLAIN: Self = Self { rule: Rule::Plain, defensive: false };

    /// Every estimator: plain, the ratios on the raw auxiliary and on the defensive one, those with
    /// fitted coefficients, and the choosers.
    pub fn all() -> impl Iterator<Item = Self> {
        use Rule::{
            Beale, Choose, ChooseUnbiased, CrossFittedDifference, Difference, HartleyRoss, Jackknife, MeanOfRatios,
            Mickey, OptimalDefensiveMickey, OptimalDefensiveRatio, Quenouille, RatioOfMeans, RegressionRatio, Tin,
        };
        let ratios = [RatioOfMeans, Quenouille, Beale, Tin, Jackknife, MeanOfRatios, HartleyRoss, Mickey];
        let fitted = [
            RegressionRatio,
            OptimalDefensiveRatio,
            OptimalDefensiveMickey,
            Difference,
            CrossFittedDifference,
            Choose,
            ChooseUnbiased,
        ];
        let on = move |defensive| ratios.into_iter().map(move |rule| Self { rule, defensive });
        let alone = fitted.into_iter().map(|rule| Self { rule, defensive: false });
        core::iter::once(Self::PLAIN).chain(on(false)).chain(on(true)).chain(alone)
    }

    /// The estimator of that id.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::all().find(|method| method.id() == id)
    }

    /// Its id: in files, pages and on the command line.
    pub fn id(self) -> &'static str {
        with_estimator!(self, Defensive::<Plain>::DEFAULT_WEIGHT, estimator => id(estimator))
    }

    /// The least number of draws it is defined for.
    pub fn min_draws(self) -> u64 {
        with_estimator!(self, Defensive::<Plain>::DEFAULT_WEIGHT, estimator => min_draws(estimator))
    }

    /// Whether it works on the defensive auxiliary.
    pub fn is_defensive(self) -> bool {
        self.defensive
    }

    /// Its kind.
    pub fn group(self) -> Group {
        match self.rule {
            Rule::Plain => Group::Plain,
            Rule::RatioOfMeans | Rule::Quenouille | Rule::Beale | Rule::Tin | Rule::Jackknife | Rule::MeanOfRatios => {
                Group::Ratio
            }
            Rule::HartleyRoss | Rule::Mickey | Rule::CrossFittedDifference | Rule::ChooseUnbiased => Group::Unbiased,
            Rule::RegressionRatio | Rule::OptimalDefensiveRatio | Rule::OptimalDefensiveMickey | Rule::Difference => {
                Group::Fitted
            }
            Rule::Choose => Group::Chooser,
        }
    }

    /// Whether its expectation is F for every number of draws.
    pub fn is_unbiased(self) -> bool {
        use Rule::{ChooseUnbiased, CrossFittedDifference, HartleyRoss, Mickey, Plain};
        matches!(self.rule, Plain | HartleyRoss | Mickey | CrossFittedDifference | ChooseUnbiased)
    }

    /// Whether it converges to F.
    pub fn is_consistent(self) -> bool {
        self.rule != Rule::MeanOfRatios
    }

    /// One line on what it is.
    pub fn about(self) -> &'static str {
        match (self.rule, self.defensive) {
            (Rule::Plain, _) => "plain Monte Carlo: the mean of f",
            (Rule::RatioOfMeans, false) => "H mean(f)/mean(h); bias O(1/N)",
            (Rule::Quenouille, false) => "jackknife of two halves of the ratio; bias O(1/N^2)",
            (Rule::Beale, false) => "ratio with Beale's correction; bias O(1/N^2)",
            (Rule::Tin, false) => "ratio with Tin's correction; bias O(1/N^2)",
            (Rule::Jackknife, false) => "delete-a-group jackknife of the ratio, with its own error bar; bias O(1/N^2)",
            (Rule::Jackknife, true) => "jackknife on the defensive auxiliary",
            (Rule::RegressionRatio, _) => "mean(f) (H/mean(h))^alpha, alpha learned from the draws",
            (Rule::OptimalDefensiveRatio, _) => "ratio on the best mixture of h and the proposal, learned",
            (Rule::OptimalDefensiveMickey, _) => "mickey on the best mixture of h and the proposal, learned",
            (Rule::Difference, _) => "mean(f) + beta (H - mean(h)), beta learned from the draws",
            (Rule::CrossFittedDifference, _) => "difference with beta from the other half of the draws: unbiased",
            (Rule::Choose, _) => "plain, ratio or difference, whichever predicts the least error",
            (Rule::ChooseUnbiased, _) => "the same choice, made by the other half of the draws: unbiased",
            (Rule::MeanOfRatios, false) => "H mean(f/h); bias does not vanish, for comparison",
            (Rule::HartleyRoss, false) => "unbiased; good where f/h is nearly constant",
            (Rule::Mickey, false) => "unbiased, with the variance of the ratio (8 groups)",
            (Rule::RatioOfMeans, true) => "ratio on the defensive auxiliary: denominators stay away from 0",
            (Rule::Quenouille, true) => "quenouille on the defensive auxiliary",
            (Rule::Beale, true) => "beale on the defensive auxiliary",
            (Rule::Tin, true) => "tin on the defensive auxiliary",
            (Rule::MeanOfRatios, true) => "mean_of_ratios on the defensive auxiliary",
            (Rule::HartleyRoss, true) => "hartley_ross on the defensive auxiliary: unbiased, f/h bounded",
            (Rule::Mickey, true) => "mickey on the defensive auxiliary: the unbiased one to take",
        }
    }

    /// The estimate from moments that serve all estimators, with defensive weight `weight`; flagged
    /// fall-backs where there are too few draws.
    pub fn estimate<M: Moments<Channel: ServesAll>>(
        self,
        weight: f64,
        moments: &M,
        integrals: &Integrals<M::Lanes>,
    ) -> Estimate<M::Lanes> {
        with_estimator!(self, weight, estimator => estimator.estimate_anyway(moments, integrals))
    }

    /// Bias and MSE that theory expects; see [`Predict`].
    pub fn predict(self, weight: f64, population: &Population, draws: u64, order: Order) -> Prediction {
        with_estimator!(self, weight, estimator => estimator.predict(population, draws, order))
    }

    /// Lets `visitor` do its work with the estimator's own type.
    pub fn visit<V: Lanes, T: Visitor<V>>(self, weight: f64, visitor: T) -> T::Output {
        with_estimator!(self, weight, estimator => visitor.visit(estimator))
    }
}

#[cfg(test)]
mod tests {
    use super::Method;

    #[test]
    fn ids_are_unique_and_lead_back() {
        let ids: Vec<_> = Method::all().map(Method::id).collect();
        assert_eq!(ids.len(), 24);
        for method in Method::all() {
            assert_eq!(Method::from_id(method.id()), Some(method));
            assert!(method.min_draws() >= 1 && !method.about().is_empty());
        }
        assert_eq!(ids[..3], ["mc", "ratio", "quenouille"]);
        assert_eq!(Method::from_id("vanilla"), None);
    }
}
