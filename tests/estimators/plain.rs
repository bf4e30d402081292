use crate::ladder::{self, run};
use ratiocv_core::Plain;

#[test]
fn a_empty() {
    ladder::empty(Plain);
}

#[test]
fn b_one_draw() {
    ladder::one_draw(Plain, 5.0);
}

#[test]
fn c_constant() {
    ladder::constant(Plain);
}

#[test]
fn d_asymmetric_by_hand() {
    // 4 ± √(38/3/4). No defensive form: h is not read.
    let plain = run(Plain, &ladder::ASYMMETRIC, ladder::INTEGRAL);
    assert_eq!(plain.value, 4.0);
    assert!((plain.std_error - (38.0_f64 / 12.0).sqrt()).abs() <= 1e-15);
}

#[test]
fn e_offset() {
    ladder::offset(Plain, |draws, _| {
        let n = draws.len() as f64;
        // Deviations from 1e9, exact.
        let (f, h) = draws.iter().fold((0.0, 0.0), |(f, h), d| (f + (d.0 - 1e9) / n, h + (d.1 - 1e9) / n));
        let c = 0.0;
        let square = |d: &(f64, f64)| (d.0 - 1e9 - f - c * (d.1 - 1e9 - h)).powi(2);
        let error = (draws.iter().map(square).sum::<f64>() / (n - 1.0) / n).sqrt();
        (1e9 + f, error)
    });
}

#[test]
fn f_split_at_every_index() {
    ladder::split_everywhere(Plain);
    ladder::value_tier(Plain);
}

#[test]
fn g_hardly_numbers() {
    ladder::hardly_numbers(Plain);
}

#[test]
fn h_near_zero_denominator() {
    ladder::near_zero_denominator(Plain);
}
