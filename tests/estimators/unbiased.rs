//! Exactly unbiased: coefficients from the other fold, by enumeration of all samples.

use ratiocv_core::moments::{Accumulate, Moments};
use ratiocv_core::{
    Choose, CrossFitted, Difference, Draw, Estimator, Integrals, Mickey, OptimalDefensive, Reads, Regression,
};
use ratiocv_tests::enumerate::{Exact, multisets};
use ratiocv_tests::golden::{Law, seed};
use ratiocv_tests::sum::Sum;

/// Bias and MSE over all samples of `n` draws, even- and odd-numbered ones: no draw's place in its fold matters,
/// so that folds are enumerated as multisets.
fn exactly<E>(estimator: &E, law: &Law, n: usize) -> Exact
where
    E: Reads + Estimator<<E::ErrorBar<f64> as Moments>::Channel>,
{
    let integrals = Integrals::new([law.h.first()]);
    let (mut value, mut bias, mut mse) = (Sum::default(), Sum::default(), Sum::default());
    let folds = [multisets(&law.support, n.div_ceil(2)), multisets(&law.support, n / 2)].map(|kinds| {
        let listed = |(counts, p): (Vec<usize>, f64)| {
            (counts.iter().enumerate().flat_map(|(i, count)| vec![i; *count]).collect::<Vec<_>>(), p)
        };
        kinds.into_iter().map(listed).collect::<Vec<_>>()
    });
    for (even, p) in &folds[0] {
        for (odd, q) in &folds[1] {
            let mut moments = estimator.error_bar(&integrals);
            for i in 0..n {
                let point = &law.support[if i % 2 == 0 { even[i / 2] } else { odd[i / 2] }];
                moments.add(Draw::new(point.y, point.x[0]));
            }
            let estimate = estimator.estimate(&moments, &integrals).expect("enough draws").value;
            value.add(p * q * estimate);
            bias.add(p * q * (estimate - law.f));
            mse.add(p * q * (estimate - law.f) * (estimate - law.f));
        }
    }
    Exact { expectation: value.value(), bias: bias.value(), mse: mse.value() }
}

fn unbiased<E>(estimator: E, name: &str) -> f64
where
    E: Reads + Estimator<<E::ErrorBar<f64> as Moments>::Channel>,
{
    let mut worst = 0.0_f64;
    for law in &seed().distributions {
        for n in [2, 3, 4, 5, 6, 8] {
            let Exact { bias, mse, .. } = exactly(&estimator, law, n);
            let off = bias.abs() / (law.f.abs() + mse.sqrt());
            assert!(off <= 1e-13, "{name}, {}, N = {n}: bias {bias:e}, MSE {mse:e}", law.name);
            worst = worst.max(off);
        }
    }
    println!("{name}: worst bias {worst:e} of |F| + RMSE");
    worst
}

const UNSHRUNK: Regression = Regression { shrink: false, dependent: ratiocv_core::Dependent::MinimumNorm };

#[test]
fn cross_fitted_difference() {
    unbiased(CrossFitted(Difference::default()), "shrunk");
    unbiased(CrossFitted(Difference { regression: UNSHRUNK }), "unshrunk");
}

#[test]
fn cross_fitted_optimal_defensive_mickey() {
    unbiased(CrossFitted(OptimalDefensive::of(Mickey)), "shrunk");
    unbiased(CrossFitted(OptimalDefensive { regression: UNSHRUNK, ..OptimalDefensive::of(Mickey) }), "unshrunk");
}

#[test]
fn cross_fitted_choose() {
    unbiased(CrossFitted(Choose::default()), "choose");
}

/// The same estimators are not, with coefficients from the draws they serve: this test can fail.
#[test]
fn without_folds_they_are_biased() {
    let biased = |estimator: &Difference, law: &Law| {
        let exact = exactly(estimator, law, 6);
        exact.bias.abs() / (law.f.abs() + exact.mse.sqrt())
    };
    let worst = seed().distributions.iter().map(|law| biased(&Difference::default(), law)).fold(0.0, f64::max);
    assert!(worst >= 1e-3, "{worst}");
}

/// Shrinkage is what makes cross-fitting bearable at 8 draws.
#[test]
fn unshrunk_coefficients_of_four_draws_do_harm() {
    for law in &seed().distributions {
        let mse = |regression: Regression| exactly(&CrossFitted(Difference { regression }), law, 8).mse;
        let (shrunk, unshrunk) = (mse(Regression::default()), mse(UNSHRUNK));
        assert!(shrunk <= unshrunk * (1.0 + 1e-4), "{}: MSE {shrunk:e} shrunk, {unshrunk:e} not", law.name);
    }
}
