//! From a golden record to the estimator of this crate that it is about.

use ratiocv_core::moments::{Accumulate, GroupedPairs, Groups, Moments, Pairs, Sums};
use ratiocv_core::{
    Beale, Defensive, Dependent, DeterministicMixture, Difference, Draw, Estimator, HartleyRoss, Integrals, Jackknife,
    MeanOfRatios, Mickey, OptimalDefensive, Plain, Quenouille, RandomMixture, RatioOfMeans, Reads, Regression,
    RegressionRatio, Tin,
};
use ratiocv_tests::golden::{Params, Point, Weights};

/// An estimate from the points that were drawn, in their order.
pub(crate) type Estimate = Box<dyn FnMut(&mut dyn Iterator<Item = &Point>) -> f64>;

/// The known integrals of a law's auxiliaries, and the unit that they are divided by.
#[derive(Clone, Debug)]
pub(crate) struct Known {
    pub(crate) h: Vec<f64>,
    pub(crate) unit: f64,
}

impl Known {
    fn integrals<const K: usize>(&self) -> Integrals<f64, K> {
        Integrals::new(core::array::from_fn(|k| self.h[k] / self.unit))
    }

    fn draw<const K: usize>(&self, point: &Point) -> Draw<f64, K> {
        Draw { f: point.y, h: core::array::from_fn(|k| point.x[k] / self.unit) }
    }
}

/// `estimator` on draws that go into `empty`.
fn on<E, M, const K: usize>(estimator: E, empty: M, known: &Known) -> Estimate
where
    E: Estimator<M::Channel, K> + 'static,
    M: Accumulate<Draw<f64, K>> + Moments<Lanes = f64> + Clone + 'static,
{
    let known = known.clone();
    Box::new(move |points| {
        let mut moments = empty.clone();
        points.for_each(|point| moments.add(known.draw(point)));
        estimator.estimate(&moments, &known.integrals()).map_or(f64::NAN, |estimate| estimate.value)
    })
}

/// `estimator` on its own error-bar moments.
fn on_own_moments<E, const K: usize>(estimator: E, known: &Known) -> Estimate
where
    E: Reads<K> + Estimator<<E::ErrorBar<f64> as Moments>::Channel, K> + 'static,
    E::ErrorBar<f64>: 'static,
{
    let empty = estimator.error_bar(&known.integrals());
    on(estimator, empty, known)
}

/// `estimator` on the proposal itself as the auxiliary: h/g = 1 in every draw.
fn on_constant_auxiliary<E>(estimator: E) -> Estimate
where
    E: Reads + Estimator<<E::ErrorBar<f64> as Moments>::Channel> + 'static,
{
    Box::new(move |points| {
        let mut moments = estimator.error_bar(&Integrals::ONE);
        points.for_each(|point| moments.add(Draw::new(point.y, 1.0)));
        estimator.estimate(&moments, &Integrals::ONE).map_or(f64::NAN, |estimate| estimate.value)
    })
}

pub(crate) fn defended<E: Reads>(estimator: E, weight: f64) -> Defensive<E> {
    estimator.defensive(weight).expect("a weight in range")
}

/// `estimator` on as many groups as the golden values have.
fn on_groups<E>(estimator: E, groups: usize, known: &Known) -> Option<Estimate>
where
    E: 'static
        + Estimator<<Groups<f64, 2> as Moments>::Channel>
        + Estimator<<Groups<f64, 4> as Moments>::Channel>
        + Estimator<<Groups<f64, 8> as Moments>::Channel>,
{
    Some(match groups {
        2 => on(estimator, Groups::<f64, 2>::default(), known),
        4 => on(estimator, Groups::<f64, 4>::default(), known),
        8 => on(estimator, Groups::<f64, 8>::default(), known),
        _ => return None,
    })
}

/// `estimator` on `K` auxiliaries with the coefficients that `fixed` gives it, on value-tier moments.
fn with_coefficients(id: &str, alpha: &[f64], known: &Known) -> Option<Estimate> {
    fn of<const K: usize>(id: &str, alpha: &[f64], known: &Known) -> Option<Estimate> {
        let alpha: [f64; K] = alpha.try_into().ok()?;
        let h: [f64; K] = known.integrals::<K>().0;
        let empty = Sums::<f64, K>::default();
        Some(match id {
            "difference_cv" | "difference_cv_opt" => on(Difference::default().fixed(alpha), empty, known),
            // The golden weights multiply the raw auxiliaries.
            "random_mixture" | "random_mixture_opt" => {
                let weights = core::array::from_fn(|k| alpha[k] * h[k]);
                on(<RandomMixture>::default().fixed(weights), empty, known)
            }
            "optimal_defensive_ratio" => on(<OptimalDefensive>::default().fixed(alpha), empty, known),
            _ => on(RegressionRatio::default().fixed(alpha), empty, known),
        })
    }
    match alpha.len() {
        1 => of::<1>(id, alpha, known),
        2 => of::<2>(id, alpha, known),
        3 => of::<3>(id, alpha, known),
        _ => None,
    }
}

/// The fitted difference, without the shrinkage that is ours.
fn fitted_difference(auxiliaries: usize, dependent: Dependent, known: &Known) -> Option<Estimate> {
    let difference = Difference { regression: Regression { dependent, shrink: false } };
    Some(match auxiliaries {
        1 => on_own_moments::<_, 1>(difference, known),
        2 => on_own_moments::<_, 2>(difference, known),
        3 => on_own_moments::<_, 3>(difference, known),
        _ => return None,
    })
}

fn deterministic_mixture(weights: Weights, techniques: usize, known: &Known) -> Option<Estimate> {
    fn of<const K: usize>(weights: Weights, known: &Known) -> Estimate {
        let known = known.clone();
        Box::new(move |points| {
            let mut moments = GroupedPairs::<f64, K, 8>::default();
            points.for_each(|point| {
                let draw: Draw<f64, K> = known.draw(point);
                let all: f64 = draw.h.iter().sum();
                let weight = |k: usize| match weights {
                    Weights::Given => point.w[k],
                    Weights::Balance => draw.h[k] / all,
                };
                moments.add(Pairs::weighted(draw, core::array::from_fn(weight)));
            });
            DeterministicMixture.estimate(&moments, &known.integrals()).map_or(f64::NAN, |estimate| estimate.value)
        })
    }
    match techniques {
        2 => Some(of::<2>(weights, known)),
        3 => Some(of::<3>(weights, known)),
        _ => None,
    }
}

/// The estimator of a record, and into how many exchangeable groups its draws fall; `None` for
/// records that other tests are about (`midzuno`, which has a first draw of its own).
pub(crate) fn estimator_of(id: &str, params: &Params, known: &Known) -> Option<(Estimate, usize)> {
    let h = known.h[0] / known.unit;
    // The golden values mix e + (1−e)x with H′ = e + (1−e)H; that is our mixture at another weight.
    let weight = params.eps.map_or(f64::NAN, |e| e / (e + (1.0 - e) * h));
    let groups = params.groups.unwrap_or(1);
    let alpha = params.coefficients();
    let ours = match id {
        "mc" => on_own_moments::<_, 1>(Plain, known),
        "ratio" => on_own_moments(RatioOfMeans, known),
        "quenouille" => return Some((on_own_moments(Quenouille, known), 2)),
        "beale" => on_own_moments(Beale, known),
        "tin" => on_own_moments(Tin, known),
        "mean_of_ratios" => on_own_moments(MeanOfRatios, known),
        "hartley_ross" => on_own_moments(HartleyRoss, known),
        "defensive_ratio" => on_own_moments(defended(RatioOfMeans, weight), known),
        "defensive_hartley_ross" => on_own_moments(defended(HartleyRoss, weight), known),
        // The whole weight on H leaves a constant auxiliary.
        "optimal_defensive_hartley_ross" if weight >= 1.0 => on_constant_auxiliary(HartleyRoss),
        "optimal_defensive_hartley_ross" => on_own_moments(defended(HartleyRoss, weight), known),
        "mickey" => on_groups(Mickey, groups, known)?,
        "jackknife" => on_groups(Jackknife, groups, known)?,
        "defensive_mickey" => on_groups(defended(Mickey, weight), groups, known)?,
        "defensive_jackknife" => on_groups(defended(Jackknife, weight), groups, known)?,
        "optimal_defensive_mickey" => on_groups(OptimalDefensive::of(Mickey).fixed([alpha[0]]), groups, known)?,
        "optimal_defensive_jackknife" => on_groups(OptimalDefensive::of(Jackknife).fixed([alpha[0]]), groups, known)?,
        "regression_ratio_est" => {
            let clamp = params.clamp.as_ref().map_or((f64::NEG_INFINITY, f64::INFINITY), |c| (c[0].0, c[1].0));
            let regression = Regression { shrink: false, ..Regression::default() };
            on_own_moments::<_, 1>(RegressionRatio { regression, clamp, undetermined: params.fallback_alpha? }, known)
        }
        "difference_cv_est" if params.singular.as_deref() == Some("zero") => {
            fitted_difference(params.auxiliaries?, Dependent::Plain, known)?
        }
        "difference_cv_est" => fitted_difference(params.auxiliaries?, Dependent::MinimumNorm, known)?,
        "deterministic_mixture" => deterministic_mixture(params.weights?, params.auxiliaries?, known)?,
        "regression_ratio"
        | "regression_ratio_opt"
        | "multiple_regression_ratio"
        | "multiple_regression_ratio_opt"
        | "random_mixture"
        | "random_mixture_opt"
        | "difference_cv"
        | "difference_cv_opt"
        | "optimal_defensive_ratio" => with_coefficients(id, &alpha, known)?,
        _ => return None,
    };
    Some((ours, groups))
}
