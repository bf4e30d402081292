use crate::ladder;
use ratiocv_core::Beale;

ladder::ladder! {
    Beale,
    one draw 7.5,
    by hand {
        // 3·(8 + 1/12)/(4 + 1/6); the coefficient of the error is 1.94: Σ(e − ē)² = 38 − 2c + 2c².
        ladder::asymmetric(Beale, 5.82, ((38.0 - 2.0 * 1.94 + 2.0 * 1.94 * 1.94) / 12.0_f64).sqrt());
    },
    at 1e9 ladder::ratio_at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(Beale);
}
