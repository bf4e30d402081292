use crate::ladder;
use ratiocv_core::Tin;

ladder::ladder! {
    Tin,
    one draw 7.5,
    by hand {
        // 3·[2 + (1/12 − 1/3)/4].
        ladder::asymmetric(Tin, 5.8125, 1.870_829);
    },
    at 1e9 ladder::ratio_at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(Tin);
}
