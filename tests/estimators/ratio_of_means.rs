use crate::ladder;
use ratiocv_core::RatioOfMeans;

ladder::ladder! {
    RatioOfMeans,
    one draw 7.5,
    by hand {
        // 3·4/2; e = f − 2h = −1, −4, 0, 5, Σe² = 42, √(42/3/4).
        ladder::asymmetric(RatioOfMeans, 6.0, 1.870_829);
    },
    at 1e9 ladder::ratio_at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(RatioOfMeans);
}
