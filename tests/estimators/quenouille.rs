use crate::ladder;
use ratiocv_core::Quenouille;

#[test]
fn a_empty() {
    ladder::empty(Quenouille);
}

#[test]
fn b_one_draw() {
    ladder::one_draw(Quenouille, 7.5);
}

#[test]
fn c_constant() {
    ladder::constant(Quenouille);
    ladder::proportional(Quenouille);
}

#[test]
fn d_asymmetric_by_hand() {
    // 3·[2·2 − ½(5/3 + 11/5)]; the error is the ratio's.
    ladder::asymmetric(Quenouille, 6.2, 1.870_829);
}

#[test]
fn e_offset() {
    ladder::offset(Quenouille, |draws, integral| {
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
    ladder::split_everywhere(Quenouille);
    ladder::value_tier(Quenouille);
}

#[test]
fn g_hardly_numbers() {
    ladder::hardly_numbers(Quenouille);
}

#[test]
fn h_near_zero_denominator() {
    ladder::near_zero_denominator(Quenouille);
}
