//! Predictions against golden constants, exact moments, and the terms of the exact expansion.

use ratiocv_core::moments::{
    Accumulate, Blocked, ComomentsBlock, Joined, Moments, RatioOf, RatioVariance, ThirdBlock, UnivariateBlock,
};
use ratiocv_core::predict::{Order, Population, Predict, Prediction};
use ratiocv_core::{
    Beale, Choose, CrossFitted, Difference, Draw, Estimator, HartleyRoss, Integrals, Jackknife, MeanOfRatios, Mickey,
    OptimalDefensive, Plain, Quenouille, RatioOfMeans, Reads, Regression, RegressionRatio, Tin,
};
use ratiocv_tests::assert_close;
use ratiocv_tests::enumerate::over_groups;
use ratiocv_tests::golden::{Point, seed};
use ratiocv_tests::population::{expectation, population};

/// The coefficients of 1/N and of 1/N² of bias and MSE.
fn coefficients(estimator: &impl Predict, population: &Population) -> [(f64, f64); 2] {
    let n = 4.0;
    let first = estimator.predict(population, 4, Order::First);
    let second = estimator.predict(population, 4, Order::Second);
    [(first.bias * n, (second.bias - first.bias) * n * n), (first.mse * n, (second.mse - first.mse) * n * n)]
}

#[test]
fn coefficients_are_those_of_the_golden_values() {
    for law in &seed().distributions {
        let constants = law.constants.as_ref().expect("constants");
        let ours = population(&law.support, 0.125);
        for (name, ours) in [
            ("20", ours.c20),
            ("11", ours.f_c11 / ours.f),
            ("02", ours.ff_c02 / ours.f / ours.f),
            ("30", ours.c30),
            ("21", ours.f_c21 / ours.f),
            ("12", ours.ff_c12 / ours.f / ours.f),
        ] {
            let right = constants.c[name].0;
            assert_close(ours, right, 1e-15 * (1.0 + right.abs()) * 4.0, &format!("{} C{name}", law.name));
        }
        let scale = law.f.abs() * (1.0 + constants.c["20"].0);
        let check = |ours: f64, right: f64, what: &str| {
            assert_close(ours, right, 1e-13 * (scale + right.abs()), &format!("{} {what}", law.name));
        };
        let [ratio_bias, ratio_mse] = coefficients(&RatioOfMeans, &ours);
        check(ratio_bias.0, constants.first_order["bias_ratio"].0, "bias_ratio");
        check(ratio_mse.0, constants.first_order["mse_ratio"].0, "mse_ratio");
        check(ratio_bias.1, constants.second_order_bias["ratio"].0, "second bias, ratio");
        check(Plain.predict(&ours, 1, Order::First).mse, constants.first_order["mse_mc"].0, "mse_mc");
        let hartley_ross = coefficients(&HartleyRoss, &ours)[1].0;
        check(hartley_ross, constants.first_order["mse_hartley_ross"].0, "mse_hartley_ross");
        let second = |estimator: &dyn Fn(Order) -> Prediction| {
            (estimator(Order::Second).bias - estimator(Order::First).bias) * 16.0
        };
        for (name, bias) in [
            ("quenouille", second(&|order| Quenouille.predict(&ours, 4, order))),
            ("beale_ddof1", second(&|order| Beale.predict(&ours, 4, order))),
            ("tin_ddof1", second(&|order| Tin.predict(&ours, 4, order))),
        ] {
            check(bias, constants.second_order_bias[name].0, name);
        }
    }
}

#[test]
fn exact_predictions_are_exact() {
    let mut compared = 0;
    for law in &seed().distributions {
        for record in &law.results {
            let weight = record.params.eps.map_or(0.125, |e| e / (e + (1.0 - e) * law.h.first()));
            let population = population(&law.support, weight);
            let n = record.n as u64;
            let ours = match record.id.as_str() {
                "mc" => Plain.predict(&population, n, Order::First),
                "mean_of_ratios" => MeanOfRatios.predict(&population, n, Order::First),
                "hartley_ross" => HartleyRoss.predict(&population, n, Order::Second),
                "defensive_hartley_ross" => {
                    HartleyRoss.defensive(weight).unwrap().predict(&population, n, Order::Second)
                }
                _ => continue,
            };
            let (bias, mse) = (record.bias.unwrap(), record.mse.unwrap());
            let what = format!("{} N={n} {}", law.name, record.id);
            assert_close(ours.bias, bias, 1e-13 * (law.f.abs() + mse.sqrt()), &what);
            assert_close(ours.mse, mse, 1e-12 * (mse + law.f * law.f), &what);
            compared += 1;
        }
    }
    assert_eq!(compared, 4 * 30);
}

/// A law near its mean: the n-th term of every expansion shrinks with the n-th power of `spread`.
fn mild(support: &[Point], spread: f64) -> Vec<Point> {
    let (f, h) = (expectation(support, |y, _| y), expectation(support, |_, x| x));
    support
        .iter()
        .map(|point| Point {
            y: f + spread * (point.y - f),
            x: vec![h + spread * (point.x[0] - h)],
            p: point.p,
            w: vec![],
        })
        .collect()
}

/// The coefficient of 1/N² in a quantity that is `first`/N + A/N² + B/N³ + C/N⁴ + …, from its values
/// at 4, 8 and 16 draws.
fn second_coefficient(first: f64, values: [f64; 3]) -> f64 {
    let [d4, d8, d16] =
        [(values[0], 4.0), (values[1], 8.0), (values[2], 16.0)].map(|(v, n): (f64, f64)| n * (n * v - first));
    // Richardson's extrapolation, twice.
    (4.0 * (2.0 * d16 - d8) - (2.0 * d8 - d4)) / 3.0
}

/// The 1/N² coefficients are those of the exact bias and MSE, found by enumeration on mild laws.
#[test]
fn second_order_terms_are_those_of_the_exact_moments() {
    fn check<E>(law: &str, support: &[Point], estimator: E, groups: usize)
    where
        E: Predict + Reads + Estimator<<E::ErrorBar<f64> as Moments>::Channel>,
    {
        let ours = population(support, 0.125);
        let integrals = Integrals::new([ours.h]);
        let exact = [4, 8, 16].map(|n: usize| {
            let groups = groups.min(n);
            over_groups(support, groups, n / groups, ours.f, |sample| {
                let mut moments = estimator.error_bar(&integrals);
                for i in 0..n / groups {
                    for group in sample {
                        moments.add(Draw::new(support[group[i]].y, support[group[i]].x[0]));
                    }
                }
                estimator.estimate(&moments, &integrals).expect("enough draws").value
            })
        });
        let [bias, mse] = coefficients(&estimator, &ours);
        let what = |quantity: &str| format!("{law}: 1/N² coefficient of the {quantity} of {}", E::ID);
        if groups < 8 {
            assert_close(second_coefficient(mse.0, exact.map(|e| e.mse)), mse.1, 0.02 * mse.1.abs(), &what("MSE"));
        } else {
            // The coefficient changes with the number of groups, of which 4 draws make fewer.
            let eight = estimator.predict(&ours, 8, Order::Second).mse;
            let right = (eight - mse.0 / 8.0) * 64.0;
            let [d8, d16] = [(exact[1], 8.0), (exact[2], 16.0)].map(|(e, n)| n * (n * e.mse - mse.0));
            assert_close(2.0 * d16 - d8, right, 0.02 * right, &what("MSE"));
        }
        if bias == (0.0, 0.0) {
            assert_close(exact[2].bias, 0.0, 1e-15, &what("bias"));
        } else if groups == 8 {
            let right = estimator.predict(&ours, 8, Order::Second).bias * 64.0;
            let [d8, d16] = [(exact[1], 8.0), (exact[2], 16.0)].map(|(e, n)| n * n * e.bias);
            assert_close(2.0 * d16 - d8, right, 0.02 * right.abs(), &what("bias"));
        } else {
            assert_close(second_coefficient(bias.0, exact.map(|e| e.bias)), bias.1, 0.02 * bias.1.abs(), &what("bias"));
        }
    }
    // The laws whose 1/N² terms do not happen to vanish against the next ones.
    for name in ["skewed_h", "independent", "negative_correlation"] {
        let golden = seed();
        let law = golden.distributions.iter().find(|law| law.name == name).expect("a law of that name");
        let support = mild(&law.support, 0.01);
        check(name, &support, RatioOfMeans, 1);
        check(name, &support, Quenouille, 2);
        check(name, &support, Beale, 1);
        check(name, &support, Tin, 1);
        check(name, &support, Mickey, 8);
        check(name, &support, Jackknife, 8);
    }
}

/// The first-order bias and MSE of fitted and of given coefficients are the limits of N times the exact
/// ones, found by enumeration.
#[test]
fn first_order_terms_of_regressions_are_those_of_the_exact_moments() {
    fn limit(values: [f64; 3]) -> f64 {
        // Values at N, 2N and 4N; Richardson's extrapolation, twice.
        let [a, b] = [2.0 * values[1] - values[0], 2.0 * values[2] - values[1]];
        (4.0 * b - a) / 3.0
    }
    fn check<E, P>(law: &str, support: &[Point], estimator: E, predicted: P)
    where
        P: Predict,
        E: Estimator<<ratiocv_core::moments::Comoments<f64> as Moments>::Channel>,
    {
        let ours = population(support, 0.125);
        let integrals = Integrals::new([ours.h]);
        let exact = [12, 24, 48].map(|n: usize| {
            over_groups(support, 1, n, ours.f, |sample| {
                let mut moments = ratiocv_core::moments::Comoments::<f64>::default();
                for i in sample[0] {
                    moments.add(Draw::new(support[*i].y, support[*i].x[0]));
                }
                estimator.estimate(&moments, &integrals).expect("enough draws").value
            })
        });
        let n = [12.0, 24.0, 48.0];
        let right = predicted.predict(&ours, 1 << 20, Order::First);
        let scale = f64::from(1 << 20);
        let bias = limit(core::array::from_fn(|i| n[i] * exact[i].bias));
        let mse = limit(core::array::from_fn(|i| n[i] * exact[i].mse));
        let plain = Plain.predict(&ours, 1, Order::First).mse;
        assert_close(mse, scale * right.mse, 0.03 * scale * right.mse + 0.002 * plain, &format!("{law}: N·MSE"));
        let tolerance = 0.05 * (scale * right.bias).abs() + 0.008 * plain.sqrt();
        assert_close(bias, scale * right.bias, tolerance, &format!("{law}: N·bias"));
    }
    let regression = Regression { shrink: false, ..Regression::default() };
    let (difference, ratio) = (Difference { regression }, RegressionRatio { regression, ..RegressionRatio::default() });
    let optimal = OptimalDefensive { regression, ..<OptimalDefensive>::default() };
    for (name, spread) in [("skewed_h", 0.05), ("negative_correlation", 0.2), ("independent", 0.2)] {
        let golden = seed();
        let law = golden.distributions.iter().find(|law| law.name == name).expect("a law of that name");
        let support = mild(&law.support, spread);
        for alpha in [-0.5, 0.5, 2.0] {
            check(name, &support, ratio.fixed([alpha]), ratio.fixed([alpha]));
        }
        if name == "skewed_h" {
            // Too many samples miss the point that decides the slope: 48 draws are not yet many.
            continue;
        }
        check(name, &support, difference, difference);
        check(name, &support, ratio, ratio);
        let best = population(&support, 0.125);
        if (0.0..0.9).contains(&(best.f_c11 / best.f / best.c20)) {
            check(name, &support, optimal, optimal);
        }
    }
}

#[test]
fn predictions_of_choosers_are_those_of_what_they_choose() {
    for law in &seed().distributions {
        let ours = population(&law.support, 0.125);
        let (plain, ratio) =
            (Plain.predict(&ours, 100, Order::Second), RatioOfMeans.predict(&ours, 100, Order::Second));
        let difference = Difference::default().predict(&ours, 100, Order::Second);
        let least = plain.mse.min(ratio.mse).min(difference.mse);
        assert_eq!(Choose::default().predict(&ours, 100, Order::Second).mse, least);
        // The regression's least variance is that of the golden values, and its cost is that of 50 draws.
        let right = law.constants.as_ref().expect("constants").first_order["mse_best_difference_cv_K1"].0;
        let scale = 1e-13 * ours.ff_c02;
        let cross_fitted = CrossFitted(Difference::default());
        assert_close(difference.mse * 100.0 * 97.0 / 98.0, right, scale, &law.name);
        assert_close(
            cross_fitted.predict(&ours, 100, Order::Second).mse * 100.0 * 47.0 / 48.0,
            right,
            scale,
            &law.name,
        );
        assert_eq!(cross_fitted.predict(&ours, 100, Order::Second).bias, 0.0);
        let unbiased = CrossFitted(Choose::default()).predict(&ours, 100, Order::Second);
        assert!(unbiased.bias == 0.0 && unbiased.mse <= plain.mse && unbiased.mse <= difference.mse * 1.03);
        // Clamped, the optimal defensive ratio is the ratio or plain.
        let alpha = ours.f_c11 / ours.f / ours.c20;
        let optimal = <OptimalDefensive>::default().predict(&ours, 100, Order::First).mse;
        if alpha < 0.0 {
            assert_close(optimal, Plain.predict(&ours, 100, Order::First).mse, scale, &law.name);
        } else if alpha < 0.99 {
            assert_close(optimal * 100.0, right, scale, &law.name);
        } else {
            let weight = RatioOfMeans.defensive(0.01).unwrap();
            assert_close(optimal, weight.predict(&ours, 100, Order::First).mse, scale, &law.name);
        }
    }
}

/// Everything that predictions read.
type All = Blocked<f64, Joined<ComomentsBlock<f64>, [UnivariateBlock<RatioOf<f64>, 1>; 2], (), (), ThirdBlock<f64>>>;

/// A sample in which each point occurs in proportion to its probability has the law's moments, up to
/// the divisors.
#[test]
fn sample_moments_are_population_moments() {
    for law in seed().distributions.iter().filter(|law| law.name != "degenerate_h") {
        let right = population(&law.support, 0.125);
        let integrals = Integrals::new([right.h]);
        let ratios = Blocked::both(RatioVariance::default(), RatioVariance::defensive(0.125, &integrals).unwrap());
        let mut moments = All::with_ratios(ratios);
        let n = 32;
        for point in &law.support {
            for _ in 0..(point.p * f64::from(n)) as usize {
                moments.add(Draw::new(point.y, point.x[0]));
            }
        }
        assert_eq!(moments.count(), u64::from(n as u32));
        let ours = Population::from_sample(&moments.channel(0), moments.count(), right.h, 0.125);
        let unbias = f64::from(n) / f64::from(n - 1);
        let close = |ours: f64, right: f64, what: &str| assert_close(ours, right, 1e-13 * (1.0 + right.abs()), what);
        close(ours.f, right.f, "F");
        close(ours.c20, unbias * right.c20, "C20");
        close(ours.f_c11, unbias * right.f_c11, "F·C11");
        close(ours.ff_c02, unbias * right.ff_c02, "F²·C02");
        close(ours.c30, right.c30, "C30");
        close(ours.f_c21, right.f_c21, "F·C21");
        close(ours.ff_c12, right.ff_c12, "F²·C12");
        close(ours.ratio.mean, right.ratio.mean, "ρ");
        close(ours.ratio.variance, unbias * right.ratio.variance, "Var r");
        close(ours.defended.1.mean, right.defended.1.mean, "ρ′");
        close(ours.defended.1.variance, unbias * right.defended.1.variance, "Var r′");
    }
}

/// The noise of h̄ is not held against estimators that take it out: f = 2h has no error to predict.
#[test]
fn samples_of_proportional_draws_predict_no_error() {
    let integrals = Integrals::new([100.0]);
    let ratios = Blocked::both(RatioVariance::default(), RatioVariance::defensive(0.01, &integrals).unwrap());
    let mut moments = All::with_ratios(ratios);
    // h̄ = 99.5: half a per cent off.
    for i in 0..50 {
        let h = 99.5 + f64::from(i) - 24.5;
        moments.add(Draw::new(2.0 * h, h));
    }
    let population = Population::from_sample(&moments.channel(0), 50, 100.0, 0.01);
    for prediction in [
        RatioOfMeans.predict(&population, 50, Order::Second),
        Beale.predict(&population, 50, Order::Second),
        MeanOfRatios.predict(&population, 50, Order::Second),
        HartleyRoss.predict(&population, 50, Order::Second),
        Mickey.predict(&population, 50, Order::Second),
    ] {
        assert_close(prediction.mse, 0.0, 1e-10, "MSE");
        assert_close(prediction.bias, 0.0, 1e-10, "bias");
    }
    assert!(Plain.predict(&population, 50, Order::Second).mse > 10.0);
    let defended = RatioOfMeans.defensive(0.01).unwrap().predict(&population, 50, Order::Second).mse;
    let right = RatioOfMeans.defensive(0.01).unwrap().estimate(&moments, &integrals).unwrap().std_error;
    assert_close(defended.sqrt(), right, 0.03 * right, "defensive ratio");
}

#[test]
fn what_is_not_known_is_not_predicted() {
    let golden = seed();
    let ours = population(&golden.distributions[0].support, 0.125);
    // Moments of y/x′ were given for another weight.
    let other = HartleyRoss.defensive(0.25).unwrap().predict(&ours, 8, Order::Second);
    assert!(other.mse.is_nan() && other.bias == 0.0);
    assert!(RatioOfMeans.defensive(0.25).unwrap().predict(&ours, 8, Order::Second).mse.is_finite());
    assert!(HartleyRoss.predict(&ours, 1, Order::Second).mse.is_nan());
    assert!(Mickey.predict(&ours, 1, Order::Second).mse.is_nan());
    assert!(Jackknife.predict(&ours, 1, Order::Second).mse.is_nan());
    assert!(Difference::default().predict(&ours, 3, Order::Second).mse.is_nan());
    assert!(CrossFitted(Difference::default()).predict(&ours, 7, Order::Second).mse.is_nan());
}
