use crate::ladder;
use ratiocv_core::MeanOfRatios;

ladder::ladder! {
    MeanOfRatios,
    one draw 7.5,
    by hand {
        // r = 1, 2/3, 2, 9/2: 3·49/24; Σ(r − r̄)² = 9.020833, 3·√(9.020833/3/4).
        ladder::asymmetric(MeanOfRatios, 6.125, 2.601_081);
    },
    at 1e9 |draws, integral| {
        let n = draws.len() as f64;
        let r = |d: &(f64, f64)| d.0 / d.1 - 1.0;
        let mean = draws.iter().map(r).sum::<f64>() / n;
        let error = (draws.iter().map(|d| (r(d) - mean).powi(2)).sum::<f64>() / (n - 1.0) / n).sqrt();
        (integral * (1.0 + mean), integral * error)
    }
}

#[test]
fn proportional() {
    ladder::proportional(MeanOfRatios);
}
