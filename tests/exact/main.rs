//! The golden values, by exact enumeration through the public API.

mod records;

use ratiocv_core::moments::{Accumulate, Moments};
use ratiocv_core::{
    Beale, Draw, Estimator, HartleyRoss, Integrals, MeanOfRatios, Plain, Quenouille, RatioOfMeans, Reads, Tin,
};
use ratiocv_tests::enumerate::{Exact, over_groups};
use ratiocv_tests::golden::{Law, Params, Point, beyond, seed};
use records::{Known, defended, estimator_of};
use std::collections::BTreeMap;

/// Points of a sample given group by group, dealt round robin, as the accumulators deal them.
fn dealt<'a>(support: &'a [Point], groups: &'a [&'a [usize]]) -> impl Iterator<Item = &'a Point> {
    (0..groups[0].len()).flat_map(move |i| groups.iter().map(move |group| &support[group[i]]))
}

/// What was compared, by id, and how far off the worst of it was.
#[derive(Debug, Default)]
struct Tally {
    compared: BTreeMap<String, usize>,
    elsewhere: usize,
    other_divisor: usize,
    worst: f64,
}

impl Tally {
    fn compare(&mut self, ours: f64, right: f64, scale: f64, tolerance: f64, what: &str) {
        let error = (ours - right).abs() / scale;
        assert!(error <= tolerance, "{what}: {ours:e} should be {right:e}, off by {error:e} of {scale:e}");
        self.worst = self.worst.max(error);
    }

    fn count(&mut self, id: &str) {
        *self.compared.entry(id.to_owned()).or_default() += 1;
    }

    fn total(&self) -> usize {
        self.compared.values().sum()
    }

    fn check_moments(&mut self, law: &Law, known: &Known) {
        for record in &law.results {
            let Some((mut estimate, groups)) = estimator_of(&record.id, &record.params, known) else {
                self.elsewhere += 1;
                continue;
            };
            if record.params.ddof == Some(0) {
                self.other_divisor += 1;
                continue;
            }
            let Exact { expectation, bias, mse } =
                over_groups(&law.support, groups, record.n / groups, law.f, |groups| {
                    estimate(&mut dealt(&law.support, groups))
                });
            let (right, right_bias, right_mse) = (record.expectation, record.bias, record.mse);
            let (right, right_bias, right_mse) = (right.unwrap(), right_bias.unwrap(), right_mse.unwrap());
            let what = format!("{} N={} {} {:?}", law.name, record.n, record.id, record.params);
            let scale = law.f.abs() + right_mse.sqrt();
            self.compare(expectation, right, scale, 1e-12, &format!("expectation, {what}"));
            self.compare(bias, right_bias, scale, 1e-12, &format!("bias, {what}"));
            self.compare(mse, right_mse, right_mse + law.f * law.f, 1e-12, &format!("MSE, {what}"));
            self.count(&record.id);
        }
    }
}

#[test]
fn moments_of_the_seeds_estimators_are_exact() {
    let golden = seed();
    let mut tally = Tally::default();
    for law in &golden.distributions {
        tally.check_moments(law, &Known { h: law.h.all(), unit: 1.0 });
    }
    println!("{tally:?}");
    assert_eq!(golden.distributions.len(), 6);
    let records: usize = golden.distributions.iter().map(|law| law.results.len()).sum();
    // Beale and Tin with divisor N are other estimators.
    assert_eq!(tally.other_divisor, 2 * 30);
    assert_eq!((tally.elsewhere, tally.total()), (0, records - tally.other_divisor));
}

#[test]
fn moments_beyond_the_seed_are_exact() {
    let golden = beyond();
    let mut tally = Tally::default();
    for law in &golden.distributions {
        // These were computed on x/H.
        tally.check_moments(law, &Known { h: law.h.all(), unit: law.h.first() });
    }
    println!("{tally:?}");
    let records: usize = golden.distributions.iter().map(|law| law.results.len()).sum();
    // Midzuno and Sen's first draw is sampled differently.
    assert_eq!((tally.elsewhere, tally.total()), (18, records - 18));
}

#[test]
fn single_samples_give_the_golden_estimates() {
    let golden = seed();
    let mut tally = Tally::default();
    let mut records = 0;
    for law in &golden.distributions {
        let known = Known { h: law.h.all(), unit: 1.0 };
        for sample in &law.pointwise {
            records += sample.values.len();
            for record in &sample.values {
                let Some((mut estimate, groups)) = estimator_of(&record.id, &record.params, &known) else {
                    tally.elsewhere += 1;
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
                let ours = estimate(&mut order.iter().map(|i| &law.support[sample.sample[*i]]));
                let what = format!("{} {:?} {} {:?}", law.name, sample.sample, record.id, record.params);
                tally.compare(ours, record.value, record.value.abs().max(law.f.abs()), 1e-13, &what);
                tally.count(&record.id);
            }
        }
    }
    println!("{tally:?}");
    assert_eq!(tally.other_divisor, 6 * 2 * 2);
    assert_eq!((tally.elsewhere, tally.total()), (0, records - tally.other_divisor));
}

/// Where h = 0 has positive probability, undefined samples fall back, flagged, with exactly the
/// probability that the golden values give; the defensive estimators have no undefined sample.
#[test]
fn undefined_samples_are_as_frequent_as_the_golden_values_say() {
    let mut compared = 0;
    for law in &seed().singular {
        let h = law.h.first();
        for record in law.results.iter().filter(|record| record.params.ddof != Some(0)) {
            let known = Known { h: law.h.all(), unit: 1.0 };
            let (_, groups) = estimator_of(&record.id, &record.params, &known).expect("an estimator of ours");
            let weight = record.params.eps.map_or(0.0, |e| e / (e + (1.0 - e) * h));
            let exact = over_groups(&law.support, groups, record.n / groups, 0.0, |groups| {
                let draws: Vec<_> = dealt(&law.support, groups).map(|point| Draw::new(point.y, point.x[0])).collect();
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
            let known = Known { h: law.h.all(), unit: 1.0 };
            let (mut ratio, _) = estimator_of("ratio", &Params::default(), &known).expect("the ratio of means");
            let bias = over_groups(&law.support, 1, n, law.f, |groups| ratio(&mut dealt(&law.support, groups))).bias;
            let covariance = over_groups(&law.support, 1, n, 0.0, |groups| {
                let mean_h = groups[0].iter().map(|i| law.support[*i].x[0]).sum::<f64>() / n as f64;
                ratio(&mut dealt(&law.support, groups)) * (mean_h - h)
            });
            let (right, scale) = (-covariance.expectation / h, law.f.abs() + covariance.mse.sqrt());
            assert!((bias - right).abs() <= 1e-13 * scale, "{} N={n}: {bias:e} should be {right:e}", law.name);
        }
    }
}
