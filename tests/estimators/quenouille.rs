use crate::ladder;
use ratiocv_core::Quenouille;

ladder::ladder! {
    Quenouille,
    one draw 7.5,
    by hand {
        // 3·[2·2 − ½(5/3 + 11/5)]; the error is the ratio's.
        ladder::asymmetric(Quenouille, 6.2, 1.870_829);
    },
    at 1e9 ladder::ratio_at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(Quenouille);
}
