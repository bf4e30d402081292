use crate::ladder;
use ratiocv_core::Beale;

#[test]
fn a_empty() {
    ladder::empty(Beale);
}

#[test]
fn b_one_draw() {
    ladder::one_draw(Beale, 7.5);
}

#[test]
fn c_constant() {
    ladder::constant(Beale);
    ladder::proportional(Beale);
}

#[test]
fn d_asymmetric_by_hand() {
    // 3·(8 + 1/12)/(4 + 1/6); the coefficient of the error is 1.94: Σ(e − ē)² = 38 − 2c + 2c².
    ladder::asymmetric(Beale, 5.82, ((38.0 - 2.0 * 1.94 + 2.0 * 1.94 * 1.94) / 12.0_f64).sqrt());
}

#[test]
fn e_offset() {
    ladder::offset(Beale, |draws, integral| {
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
    ladder::split_everywhere(Beale);
    ladder::value_tier(Beale);
}

#[test]
fn g_hardly_numbers() {
    ladder::hardly_numbers(Beale);
}

#[test]
fn h_near_zero_denominator() {
    ladder::near_zero_denominator(Beale);
}
