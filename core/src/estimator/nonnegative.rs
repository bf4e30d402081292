//! Weights that must not be negative.

use crate::planted::planted;

/// Which of `K` weights are not 0 in the best fit without negative weights; `fit` gives the best weights, of
/// any sign, that are 0 but for those named.
///
/// Principal pivoting (Murty 1974): of the weights with the wrong sign the last one changes sides; one that
/// is left out is judged by the sign that it would come in with. Leaving out negative weights alone, the
/// most negative first, misses the minimum where one that went should come back. Ends for auxiliaries that
/// are independent; dependent ones could go round, so that the steps are bounded, and what is negative then
/// is left out.
pub(super) fn nonnegative<const K: usize>(fit: impl Fn(&[bool; K]) -> [f64; K]) -> [bool; K] {
    let with = |mut among: [bool; K], k: usize| {
        among[k] = planted!("nonnegative_return": true, false);
        among
    };
    let mut among = [true; K];
    for _ in 0..1_u32 << K.min(10) {
        let weights = fit(&among);
        let is_wrong = |k: &usize| if among[*k] { weights[*k] < 0.0 } else { fit(&with(among, *k))[*k] > 0.0 };
        let Some(wrong) = (0..K).rev().find(is_wrong) else { return among };
        among[wrong] = !among[wrong];
    }
    while let Some(negative) = (0..K).find(|k| fit(&among)[*k] < 0.0) {
        among[negative] = false;
    }
    among
}

#[cfg(test)]
mod tests {
    use super::nonnegative;
    use crate::solve::solve;

    #[test]
    fn one_that_was_left_out_comes_back() {
        // b = a·x with x = (−1, −0.6), or the other way round: both are negative, yet the one that is the more
        // so is the best alone, 1/5.
        for (a, b, best) in [
            ([[1.0, -2.0], [-2.0, 5.0]], [0.2, -1.0], [true, false]),
            ([[5.0, -2.0], [-2.0, 1.0]], [-1.0, 0.2], [false, true]),
        ] {
            let fit = |among: &[bool; 2]| solve(&a, &b, &among.map(|taken| f64::from(u8::from(taken))), 1e-14).x;
            assert!(fit(&[true; 2]).iter().all(|x| *x < 0.0));
            assert_eq!(nonnegative(fit), best);
        }
    }

    #[test]
    fn steps_are_bounded() {
        // No fit at all: what is out wants in, what is in wants out.
        let contrary = |among: &[bool; 3]| among.map(|taken| if taken { -1.0 } else { 1.0 });
        assert_eq!(nonnegative(contrary), [false; 3]);
    }
}
