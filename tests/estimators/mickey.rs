use crate::ladder;
use ratiocv_core::Mickey;

#[test]
fn a_empty() {
    ladder::empty(Mickey);
}

#[test]
fn b_one_draw() {
    ladder::one_draw(Mickey, 7.5);
}

#[test]
fn c_constant() {
    ladder::constant(Mickey);
    ladder::proportional(Mickey);
}

#[test]
fn d_asymmetric_by_hand() {
    // Leave-one-out: 4 + ¼(15/7·2 + 14/5·0 + 2·1 + 7/6·1); the error is the ratio's.
    ladder::asymmetric(Mickey, 985.0 / 168.0, 1.870_829);
}

#[test]
fn e_offset() {
    ladder::offset(Mickey, |draws, integral| {
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
    ladder::split_everywhere(Mickey);
    ladder::value_tier(Mickey);
}

#[test]
fn g_hardly_numbers() {
    ladder::hardly_numbers(Mickey);
}

#[test]
fn h_near_zero_denominator() {
    ladder::near_zero_denominator(Mickey);
}
