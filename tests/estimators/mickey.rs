use crate::ladder;
use ratiocv_core::Mickey;

ladder::ladder! {
    Mickey,
    one draw 7.5,
    by hand {
        // Leave-one-out: 4 + ¼(15/7·2 + 14/5·0 + 2·1 + 7/6·1); the error is the ratio's.
        ladder::asymmetric(Mickey, 985.0 / 168.0, 1.870_829);
    },
    at 1e9 ladder::ratio_at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(Mickey);
}
