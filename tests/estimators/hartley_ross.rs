use crate::ladder;
use ratiocv_core::HartleyRoss;

ladder::ladder! {
    HartleyRoss,
    one draw 7.5,
    by hand {
        // 49/8 + 4/3·(4 − 49/12); Σ(e − ē)² = 38 − 2c + 2c² with c = 49/24.
        ladder::asymmetric(HartleyRoss, 433.0 / 72.0, 1.876_466);
    },
    at 1e9 ladder::ratio_at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(HartleyRoss);
}
