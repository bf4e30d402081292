use crate::ladder::{self, run};
use ratiocv_core::Plain;

ladder::ladder! {
    Plain,
    one draw 5.0,
    by hand {
        // 4 ± √(38/3/4). No defensive form: h is not read.
        let plain = run(Plain, &ladder::ASYMMETRIC, ladder::INTEGRAL);
        assert_eq!(plain.value, 4.0);
        assert!((plain.std_error - (38.0_f64 / 12.0).sqrt()).abs() <= 1e-15);
    },
    at 1e9 |draws, _| (1e9 + ladder::mean_deviations(draws).0, ladder::residual_error(draws, 0.0))
}
