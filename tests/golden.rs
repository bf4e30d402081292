//! The golden values, by exact enumeration through the public API.

use ratiocv_core::moments::{Accumulate, Groups, Moments};
use ratiocv_core::{
    Beale, Defensive, Draw, Estimator, HartleyRoss, Integrals, MeanOfRatios, Mickey, Plain, Quenouille, RatioOfMeans,
    Reads, Tin,
};
use ratiocv_tests::enumerate::{Exact, over_groups};
use ratiocv_tests::golden::{Golden, Law, Params, Point, beyond, seed};

/// An estimate from draws in their order.
type Estimate = Box<dyn FnMut(&mut dyn Iterator<Item = Draw<f64>>) -> f64>;

/// `estimator` on its own error-bar moments, known integral `h`.
fn on_own_moments<E>(estimator: E, h: f64) -> Estimate
where
    E: Reads + Estimator<<E::ErrorBar<f64> as Moments>::Channel> + 'static,
{
    let integrals = Integrals::new([h]);
    let empty = estimator.error_bar(&integrals);
    Box::new(move |draws| read(&estimator, empty, draws, &integrals))
}

fn read<E: Estimator<M::Channel>, M>(
    estimator: &E,
    mut moments: M,
    draws: &mut dyn Iterator<Item = Draw<f64>>,
    integrals: &Integrals<f64>,
) -> f64
where
    M: Accumulate<Draw<f64>> + Moments<Lanes = f64>,
{
    for draw in draws {
        moments.add(draw);
    }
    estimator.estimate(&moments, integrals).map_or(f64::NAN, |estimate| estimate.value)
}

/// Mickey, raw or defensive, with any number of groups that the golden values have.
fn mickey<E>(estimator: E, groups: usize, h: f64) -> Option<Estimate>
where
    E: Copy
        + 'static
        + Estimator<<Groups<f64, 2> as Moments>::Channel>
        + Estimator<<Groups<f64, 4> as Moments>::Channel>
        + Estimator<<Groups<f64, 8> as Moments>::Channel>,
{
    let integrals = Integrals::new([h]);
    Some(match groups {
        2 => Box::new(move |draws| read(&estimator, Groups::<f64, 2>::default(), draws, &integrals)),
        4 => Box::new(move |draws| read(&estimator, Groups::<f64, 4>::default(), draws, &integrals)),
        8 => Box::new(move |draws| read(&estimator, Groups::<f64, 8>::default(), draws, &integrals)),
        _ => return None,
    })
}

fn defended<E: Reads>(estimator: E, weight: f64) -> Defensive<E> {
    estimator.defensive(weight).expect("a weight in range")
}

/// The estimator of a record, and into how many exchangeable groups its draws fall; `None` for
/// records of estimators that are not here yet.
fn estimator_of(id: &str, params: &Params, h: f64) -> Option<(Estimate, usize)> {
    // The golden values mix e + (1−e)x with H′ = e + (1−e)H; that is our mixture at another weight.
    let weight = params.eps.map_or(f64::NAN, |e| e / (e + (1.0 - e) * h));
    let groups = params.groups.unwrap_or(1);
    let ours = match id {
        "mc" => on_own_moments(Plain, h),
        "ratio" => on_own_moments(RatioOfMeans, h),
        "quenouille" => return Some((on_own_moments(Quenouille, h), 2)),
        "beale" => on_own_moments(Beale, h),
        "tin" => on_own_moments(Tin, h),
        "mean_of_ratios" => on_own_moments(MeanOfRatios, h),
        "hartley_ross" => on_own_moments(HartleyRoss, h),
        "defensive_ratio" => on_own_moments(defended(RatioOfMeans, weight), h),
        "defensive_hartley_ross" => on_own_moments(defended(HartleyRoss, weight), h),
        "mickey" => mickey(Mickey, groups, h)?,
        "defensive_mickey" => mickey(defended(Mickey, weight), groups, h)?,
        _ => return None,
    };
    Some((ours, groups))
}

/// Draws of a sample given group by group, dealt round robin, as the accumulators deal them.
fn dealt<'a>(support: &'a [Point], groups: &'a [&'a [usize]], unit: f64) -> impl Iterator<Item = Draw<f64>> + 'a {
    (0..groups[0].len()).flat_map(move |i| {
        groups.iter().map(move |group| Draw::new(support[group[i]].y, support[group[i]].x[0] / unit))
    })
}

/// What was compared, and how far off the worst of it was, in units of what is allowed.
#[derive(Debug, Default)]
struct Tally {
    compared: usize,
    other_estimators: usize,
    other_divisor: usize,
    worst: f64,
}

impl Tally {
    fn compare(&mut self, ours: f64, right: f64, scale: f64, tolerance: f64, what: &str) {
        let error = (ours - right).abs() / scale;
        assert!(error <= tolerance, "{what}: {ours:e} should be {right:e}, off by {error:e} of {scale:e}");
        self.worst = self.worst.max(error);
    }

    fn check_moments(&mut self, law: &Law, h: f64, unit: f64) {
        for record in &law.results {
            let Some((mut estimate, groups)) = estimator_of(&record.id, &record.params, h) else {
                self.other_estimators += 1;
                continue;
            };
            if record.params.ddof == Some(0) {
                self.other_divisor += 1;
                continue;
            }
            let Exact { expectation, bias, mse } =
                over_groups(&law.support, groups, record.n / groups, law.f, |groups| {
                    estimate(&mut dealt(&law.support, groups, unit))
                });
            let (right, right_bias, right_mse) = (record.expectation, record.bias, record.mse);
            let (right, right_bias, right_mse) = (right.unwrap(), right_bias.unwrap(), right_mse.unwrap());
            let what = format!("{} N={} {} {:?}", law.name, record.n, record.id, record.params);
            let scale = law.f.abs() + right_mse.sqrt();
            self.compare(expectation, right, scale, 1e-12, &format!("expectation, {what}"));
            self.compare(bias, right_bias, scale, 1e-12, &format!("bias, {what}"));
            self.compare(mse, right_mse, right_mse + law.f * law.f, 1e-12, &format!("MSE, {what}"));
            self.compared += 1;
        }
    }
}

fn law_count(golden: &Golden) -> usize {
    golden.distributions.len()
}

#[test]
fn moments_of_the_seeds_estimators_are_exact() {
    let golden = seed();
    let mut tally = Tally::default();
    for law in &golden.distributions {
        tally.check_moments(law, law.h.first(), 1.0);
    }
    println!("{tally:?}");
    assert_eq!(law_count(&golden), 6);
    // 9 estimators on 6 laws at 5 sizes, Quenouille at the 4 even ones.
    assert_eq!(tally.compared, 9 * 30 - 6);
    assert_eq!(tally.other_divisor, 2 * 30);
}

#[test]
fn moments_of_grouped_mickey_are_exact() {
    let golden = beyond();
    let mut tally = Tally::default();
    for law in &golden.distributions {
        // These were computed on x/H.
        tally.check_moments(law, 1.0, law.h.first());
    }
    println!("{tally:?}");
    // Groups 2 | 2, 4 | 2, 4, 8 at N = 2, 4, 8, raw and defensive, on 6 laws.
    assert_eq!(tally.compared, 2 * 6 * 6);
}

#[test]
fn single_samples_give_the_golden_estimates() {
    let golden = seed();
    let mut tally = Tally::default();
    for law in &golden.distributions {
        for sample in &law.pointwise {
            let draw = |i: &usize| Draw::new(law.support[*i].y, law.support[*i].x[0]);
            for record in &sample.values {
                let Some((mut estimate, groups)) = estimator_of(&record.id, &record.params, law.h.first()) else {
                    tally.other_estimators += 1;
                    continue;
                };
                if record.params.ddof == Some(0) {
                    tally.other_divisor += 1;
                    continue;
                }
                // The golden halves are the first and the last draws; ours alternate.
                let half = sample.sample.len() / 2;
                let mut order: Vec<usize> = (0..sample.sample.len()).collect();
                if groups == 2 {
                    order = (0..half).flat_map(|i| [i, half + i]).collect();
                }
                let ours = estimate(&mut order.iter().map(|i| draw(&sample.sample[*i])));
                let what = format!("{} {:?} {}", law.name, sample.sample, record.id);
                tally.compare(ours, record.value, record.value.abs().max(law.f.abs()), 1e-13, &what);
                tally.compared += 1;
            }
        }
    }
    println!("{tally:?}");
    // Two samples a law; of 4 draws (9 estimators) and of 7 (8: no halves).
    assert_eq!(tally.compared, 6 * (9 + 8));
    assert_eq!(tally.other_divisor, 6 * 2 * 2);
}

/// Where h = 0 has positive probability, undefined samples fall back, flagged, with exactly the
/// probability that the golden values give; the defensive estimators have no undefined sample.
#[test]
fn undefined_samples_are_as_frequent_as_the_golden_values_say() {
    let mut compared = 0;
    for law in &seed().singular {
        let h = law.h.first();
        for record in law.results.iter().filter(|record| record.params.ddof != Some(0)) {
            let Some(groups) = estimator_of(&record.id, &record.params, h).map(|(_, groups)| groups) else { continue };
            let weight = record.params.eps.map_or(0.0, |e| e / (e + (1.0 - e) * h));
            let exact = over_groups(&law.support, groups, record.n / groups, 0.0, |groups| {
                let draws: Vec<_> = dealt(&law.support, groups, 1.0).collect();
                f64::from(u8::from(fell_back(&record.id, weight, h, &draws)))
            });
            let what = format!("{} N={} {}", law.name, record.n, record.id);
            let right = record.p_singular.unwrap_or(0.0);
            assert!((exact.expectation - right).abs() <= 1e-14, "{what}: {} should be {right}", exact.expectation);
            compared += 1;
        }
    }
    assert_eq!(compared, 28);
}

fn fell_back(id: &str, weight: f64, h: f64, draws: &[Draw<f64>]) -> bool {
    fn flags<E: Reads + Estimator<<E::ErrorBar<f64> as Moments>::Channel>>(
        estimator: E,
        h: f64,
        draws: &[Draw<f64>],
    ) -> bool {
        let integrals = Integrals::new([h]);
        let mut moments = estimator.error_bar(&integrals);
        moments.add_batch(draws);
        estimator.estimate(&moments, &integrals).expect("enough draws").flags(0).fell_back()
    }
    match id {
        "mc" => flags(Plain, h, draws),
        "ratio" => flags(RatioOfMeans, h, draws),
        "quenouille" => flags(Quenouille, h, draws),
        "beale" => flags(Beale, h, draws),
        "tin" => flags(Tin, h, draws),
        "mean_of_ratios" => flags(MeanOfRatios, h, draws),
        "hartley_ross" => flags(HartleyRoss, h, draws),
        "defensive_ratio" => flags(defended(RatioOfMeans, weight), h, draws),
        "defensive_hartley_ross" => flags(defended(HartleyRoss, weight), h, draws),
        other => panic!("{other}"),
    }
}

/// Lemma 9: Bias[ȳ/x̄] = −Cov(ȳ/x̄, x̄)/H, exactly, for every N.
#[test]
fn lemma_9_holds_exactly() {
    for law in &seed().distributions {
        let h = law.h.first();
        for n in [2, 3, 8] {
            let (mut ratio, _) = estimator_of("ratio", &Params::default(), h).expect("the ratio of means");
            let bias =
                over_groups(&law.support, 1, n, law.f, |groups| ratio(&mut dealt(&law.support, groups, 1.0))).bias;
            let covariance = over_groups(&law.support, 1, n, 0.0, |groups| {
                let mean_h = groups[0].iter().map(|i| law.support[*i].x[0]).sum::<f64>() / n as f64;
                ratio(&mut dealt(&law.support, groups, 1.0)) * (mean_h - h)
            });
            let (right, scale) = (-covariance.expectation / h, law.f.abs() + covariance.mse.sqrt());
            assert!((bias - right).abs() <= 1e-13 * scale, "{} N={n}: {bias:e} should be {right:e}", law.name);
        }
    }
}
