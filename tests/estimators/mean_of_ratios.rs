use crate::ladder;
use ratiocv_core::MeanOfRatios;

#[test]
fn a_empty() {
    ladder::empty(MeanOfRatios);
}

#[test]
fn b_one_draw() {
    ladder::one_draw(MeanOfRatios, 7.5);
}

#[test]
fn c_constant() {
    ladder::constant(MeanOfRatios);
    ladder::proportional(MeanOfRatios);
}

#[test]
fn d_asymmetric_by_hand() {
    // r = 1, 2/3, 2, 9/2: 3·49/24; Σ(r − r̄)² = 9.020833, 3·√(9.020833/3/4).
    ladder::asymmetric(MeanOfRatios, 6.125, 2.601_081);
}

#[test]
fn e_offset() {
    ladder::offset(MeanOfRatios, |draws, integral| {
        let n = draws.len() as f64;
        // Deviations from 1e9, exact.
        let (f, h) = draws.iter().fold((0.0, 0.0), |(f, h), d| (f + (d.0 - 1e9) / n, h + (d.1 - 1e9) / n));
        let _ = (f, h);
        let r = |d: &(f64, f64)| d.0 / d.1 - 1.0;
        let mean = draws.iter().map(r).sum::<f64>() / n;
        let error = (draws.iter().map(|d| (r(d) - mean).powi(2)).sum::<f64>() / (n - 1.0) / n).sqrt();
        (integral * (1.0 + mean), integral * error)
    });
}

#[test]
fn f_split_at_every_index() {
    ladder::split_everywhere(MeanOfRatios);
    ladder::value_tier(MeanOfRatios);
}

#[test]
fn g_hardly_numbers() {
    ladder::hardly_numbers(MeanOfRatios);
}

#[test]
fn h_near_zero_denominator() {
    ladder::near_zero_denominator(MeanOfRatios);
}
