use crate::fitted;
use crate::ladder::{self, CORRELATED, INTEGRAL_OF_CORRELATED, run};
use ratiocv_core::moments::{Accumulate, Comoments};
use ratiocv_core::{Choice, Choose, Dependent, Draw, Flags, Integrals, Regression, Single};

const CHOOSE: Choose = Choose { regression: Regression { dependent: Dependent::MinimumNorm, shrink: true } };

fn choice(draws: &[(f64, f64)], integral: f64) -> Choice {
    let moments = ratiocv_tests::samples::filled(Comoments::<f64>::default(), draws.iter().copied());
    let Single(choice) = CHOOSE.choices(&moments, &Integrals::new([integral]));
    choice
}

ladder::ladder! {
    CHOOSE,
    one draw 5.0,
    by hand {
        // Plain 38; the ratio about 12/5: 2 + 9·0.4² = 3.44; the difference 73/36·(4 − 2)/(4 − 2 − 1) = 4.06:
        // the ratio, 6/2.5·4, though its coefficient leaves more than the fitted one.
        ladder::by_hand(CHOOSE, &CORRELATED, INTEGRAL_OF_CORRELATED, 9.6, (3.44_f64 / 12.0).sqrt());
        assert_eq!(choice(&CORRELATED, INTEGRAL_OF_CORRELATED), Choice::Ratio(0));
        ladder::defended(CHOOSE, &CORRELATED, INTEGRAL_OF_CORRELATED);
        // f 9/2 up, the ratio's coefficient is 10.5/2.5: 2 + 9·2.2². Now the difference.
        let up = CORRELATED.map(|(f, h)| (f + 4.5, h));
        assert_eq!(choice(&up, 4.0), Choice::Difference);
        ladder::by_hand(CHOOSE, &up, 4.0, 107.0 / 12.0 + 4.5, (73.0_f64 / 144.0).sqrt());
        assert_eq!(choice(&ladder::ASYMMETRIC, ladder::INTEGRAL), Choice::Plain);
        ladder::by_hand(CHOOSE, &ladder::ASYMMETRIC, ladder::INTEGRAL, 4.0, (38.0_f64 / 12.0).sqrt());
    },
    at 1e9 fitted::difference_at_1e9
}

#[test]
fn proportional() {
    ladder::proportional(CHOOSE);
}

#[test]
fn below_four_draws_it_is_plain() {
    assert_eq!(choice(&CORRELATED[..3], 4.0), Choice::Plain);
    let three = run(CHOOSE, &CORRELATED[..3], 4.0);
    assert!((three.value - 13.0 / 3.0).abs() <= 1e-15 && three.std_error > 0.0);
}

/// Two auxiliaries: the better ratio, or both of them in the difference; ties go to the earlier.
#[test]
fn among_several_auxiliaries() {
    let choices = |f: &dyn Fn(f64, f64) -> f64| {
        let mut moments = Comoments::<f64, 2>::default();
        for i in 0..64 {
            let (a, b) = (1.0 + f64::from(i % 8), 2.0 + f64::from(i / 8));
            moments.add(Draw { f: f(a, b), h: [a, b] });
        }
        let Single(choice) = CHOOSE.choices(&moments, &Integrals::new([4.5, 5.5]));
        choice
    };
    assert_eq!(choices(&|a, _| 3.0 * a), Choice::Ratio(0));
    assert_eq!(choices(&|_, b| 3.0 * b), Choice::Ratio(1));
    assert_eq!(choices(&|a, b| a + 2.0 * b), Choice::Difference);
    assert_eq!(choices(&|_, _| 7.0), Choice::Plain);
    let twice = ratiocv_tests::samples::filled(Comoments::<f64>::default(), CORRELATED);
    let Single(first) = CHOOSE.choices(&twice, &Integrals::new([4.0]));
    let mut same = Comoments::<f64, 2>::default();
    CORRELATED.iter().for_each(|(f, h)| same.add(Draw { f: *f, h: [*h, *h] }));
    assert_eq!(
        (first, CHOOSE.choices(&same, &Integrals::new([4.0, 4.0]))),
        (Choice::Ratio(0), Single(Choice::Ratio(0)))
    );
}

#[test]
fn an_infinite_spread_is_plain() {
    let far = run(CHOOSE, &[(1e200, 1.0), (-1e200, 2.0), (3e200, 3.0), (1e200, 4.0)], 2.0);
    assert!(far.value == 1e200 && far.flags.contains(Flags::OVERFLOW) && far.std_error.is_nan(), "{far:?}");
}

/// A ratio that divides by little is said to, a difference with the same draws is not.
#[test]
fn a_chosen_ratio_says_that_its_denominator_is_ill() {
    let h = [1.0, -0.5, 1.5, -1.0, 0.75, 0.25];
    let ratio = run(CHOOSE, &h.map(|h| (2.0 * h, h)), 0.25);
    assert!((ratio.value - 0.5).abs() <= 1e-15 && ratio.flags.contains(Flags::DENOM_ILL), "{ratio:?}");
    let difference = run(CHOOSE, &h.map(|h| (2.0 * h + 1.0, h)), 0.25);
    assert!((difference.value - 1.5).abs() <= 1e-14 && !difference.flags.contains(Flags::DENOM_ILL), "{difference:?}");
}
