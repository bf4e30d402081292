use crate::ladder;
use ratiocv_core::HartleyRoss;

#[test]
fn a_empty() {
    ladder::empty(HartleyRoss);
}

#[test]
fn b_one_draw() {
    ladder::one_draw(HartleyRoss, 7.5);
}

#[test]
fn c_constant() {
    ladder::constant(HartleyRoss);
    ladder::proportional(HartleyRoss);
}

#[test]
fn d_asymmetric_by_hand() {
    // 49/8 + 4/3·(4 − 49/12); Σ(e − ē)² = 38 − 2c + 2c² with c = 49/24.
    ladder::asymmetric(HartleyRoss, 433.0 / 72.0, 1.876_466);
}

#[test]
fn e_offset() {
    ladder::offset(HartleyRoss, |draws, integral| {
        let n = draws.len() as f64;
        // Deviations from 1e9, exact.
        let (f, h) = draws.iter().fold((0.0, 0.0), |(f, h), d| (f + (d.0 - 1e9) / n, h + (d.1 - 1e9) / n));
        let c = (1e9 + f) / (1e9 + h);
        let square = |d: &(f64, f64)| (d.0 - 1e9 - f - c * (d.1 - 1e9 - h)).powi(2);
        let error = (draws.iter().map(square).sum::<f64>() / (n - 1.0) / n).sqrt();
        ((1e9 + f) / (1e9 + h) * integral, error)
    });
}

#[test]
fn f_split_at_every_index() {
    ladder::split_everywhere(HartleyRoss);
    ladder::value_tier(HartleyRoss);
}

#[test]
fn g_hardly_numbers() {
    ladder::hardly_numbers(HartleyRoss);
}

#[test]
fn h_near_zero_denominator() {
    ladder::near_zero_denominator(HartleyRoss);
}
