use crate::ladder::{self, CORRELATED, run};
use ratiocv_core::{Dependent, Mickey, RandomMixture, RatioOfMeans, Regression};

const REGRESSION: Regression = Regression { dependent: Dependent::MinimumNorm, shrink: true };
const MIXTURE: RandomMixture = RandomMixture { estimator: RatioOfMeans, regression: REGRESSION };
const OF_MICKEY: RandomMixture<Mickey> = RandomMixture { estimator: Mickey, regression: REGRESSION };

// With one auxiliary there is nothing to mix: the ratio of means.
ladder::ladder! {
    MIXTURE,
    one draw 7.5,
    by hand {
        ladder::asymmetric(MIXTURE, 6.0, 1.870_829);
    },
    at 1e9 ladder::ratio_at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(MIXTURE);
}

#[test]
fn of_one_it_is_its_estimator() {
    for draws in [&CORRELATED[..], &ladder::ASYMMETRIC[..]] {
        let (ours, right) = (run(OF_MICKEY, draws, 4.0), run(Mickey, draws, 4.0));
        assert!((ours.value - right.value).abs() <= 1e-15 * right.value, "{ours:?} should be {right:?}");
        assert!((ours.std_error - right.std_error).abs() <= 1e-15 * right.value);
    }
}
