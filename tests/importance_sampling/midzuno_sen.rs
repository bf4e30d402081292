//! The Midzuno–Sen draw: golden values by exact enumeration, and what else is promised of it.

use crate::scripted::{PART, Scripted, first_and_last, played};
use core::cell::Cell;
use ratiocv_core::moments::{Moments, Sums};
use ratiocv_core::sampling::{Discrete, PiecewiseConstant};
use ratiocv_core::{Error, Estimator, Flags, Problem, Proposal, RatioOfMeans, Spectrum, Uniform, WithIntegral};
use ratiocv_tests::assert_close;
use ratiocv_tests::enumerate::{Exact, over_groups};
use ratiocv_tests::golden::{Law, beyond};

/// The exact moments of the ratio of means of `n` draws, the first of them from x/H, by way of random
/// numbers that make the proposals choose each point.
fn exact<const B: usize>(law: &Law, n: usize) -> Exact {
    let h = law.h.first();
    let points = || law.support.iter();
    let table = |of: &dyn Fn(&ratiocv_tests::golden::Point) -> f64| -> [f64; B] {
        points().map(of).collect::<Vec<_>>().try_into().expect("as many points")
    };
    let p = Discrete::new(&table(&|point| point.p)).expect("probabilities");
    let first = Discrete::new(&table(&|point| point.p * point.x[0])).expect("x/H");
    let problem = Problem::new(|i: &usize| law.support[*i].y * law.support[*i].p)
        .auxiliary(WithIntegral::new(|i: &usize| law.support[*i].x[0] / h * law.support[*i].p, 1.0))
        .proposal(p);
    let (mut expectation, mut bias, mut mse) = (0.0, 0.0, 0.0);
    for start in 0..B {
        let Some([begin, _]) = first_and_last(&first, start) else { continue };
        let rest = over_groups(&law.support, 1, n - 1, law.f, |groups| {
            let next = |i: &usize| first_and_last(&p, *i).expect("a probability")[0];
            let script: Vec<f64> = core::iter::once(begin).chain(groups[0].iter().map(next)).collect();
            played(&script, |rng: &mut Scripted<'_>| {
                let mut moments = Sums::<f64>::default();
                problem.accumulate_midzuno_sen(&[first], &mut moments, n as u64, rng).expect("one first");
                assert_eq!(moments.count(), n as u64);
                RatioOfMeans.estimate(&moments, &problem.integrals()).expect("draws").value
            })
        });
        // The law's own probability: that of a choice is its nearest multiple of 2⁻⁵³.
        let weight = law.support[start].p * law.support[start].x[0] / h;
        assert_close(first.pdf(&start), weight, 2.0 * PART, "the first draw");
        expectation += weight * rest.expectation;
        bias += weight * rest.bias;
        mse += weight * rest.mse;
    }
    Exact { expectation, bias, mse }
}

#[test]
fn moments_are_the_golden_ones() {
    let (mut compared, mut worst) = (0, 0.0_f64);
    for law in &beyond().distributions {
        for record in law.results.iter().filter(|record| record.id == "midzuno") {
            let ours = match law.support.len() {
                4 => exact::<4>(law, record.n),
                5 => exact::<5>(law, record.n),
                other => panic!("{other} points"),
            };
            let (right, mse) = (record.expectation.expect("a mean"), record.mse.expect("an MSE"));
            let (what, scale) = (format!("{} N={}", law.name, record.n), law.f.abs() + mse.sqrt());
            assert_eq!(record.bias, Some(0.0), "{what}");
            assert_close(ours.expectation, right, 1e-12 * scale, &what);
            assert_close(ours.bias, 0.0, 1e-12 * scale, &what);
            assert_close(ours.mse, mse, 1e-12 * (mse + law.f * law.f), &what);
            worst = worst.max(ours.bias.abs() / scale).max((ours.mse - mse).abs() / (mse + law.f * law.f));
            compared += 1;
        }
    }
    println!("worst {worst:e} of {compared}");
    assert_eq!(compared, 6 * 3);
}

/// Two channels with auxiliaries of their own over three points.
const F: [[f64; 3]; 2] = [[1.0, 4.0, 2.0], [5.0, 1.0, -1.0]];
const H: [[f64; 3]; 2] = [[1.0, 2.0, 1.0], [0.5, 0.5, 3.0]];

/// E\[estimate\] − F in both channels, of two draws with the first from `firsts`.
fn bias(firsts: &[Discrete<3>]) -> [f64; 2] {
    let g = Discrete::new(&[0.5, 0.25, 0.25]).expect("weights");
    let pair = |of: [[f64; 3]; 2], i: usize| Spectrum([of[0][i], of[1][i]]);
    let problem = Problem::new(move |i: &usize| pair(F, *i))
        .auxiliary(WithIntegral::new(move |i: &usize| pair(H, *i), Spectrum([4.0, 4.0])))
        .proposal(g);
    let mut bias = [-7.0, -5.0];
    // All points of up to two first draws and one other.
    for outcome in 0..27 {
        let points = [outcome % 3, outcome / 3 % 3, outcome / 9];
        if firsts.len() == 1 && points[1] > 0 {
            continue;
        }
        let chosen = firsts.iter().zip(points).chain(core::iter::once((&g, points[2])));
        let (mut script, mut weight) = (Vec::new(), 1.0);
        for (choice, point) in chosen {
            script.push(first_and_last(choice, point).expect("a probability")[1]);
            weight *= choice.pdf(&point);
        }
        let mut moments = Sums::<Spectrum<f64, 2>>::default();
        played(&script, |rng: &mut Scripted<'_>| problem.accumulate_midzuno_sen(firsts, &mut moments, 2, rng))
            .expect("one first or two");
        let value = RatioOfMeans.estimate(&moments, &problem.integrals()).expect("draws").value;
        bias.iter_mut().enumerate().for_each(|(j, bias)| *bias += weight * value[j]);
    }
    bias
}

#[test]
fn one_first_draw_serves_its_channel_and_one_for_each_serves_all() {
    let own = H.map(|h| Discrete::new(&h).expect("h/H"));
    let [first, second] = bias(&own[..1]);
    assert!(first.abs() <= 1e-14 && second.abs() >= 0.1, "{first} {second}");
    let [first, second] = bias(&own);
    assert!(first.abs() <= 1e-14 && second.abs() <= 1e-14, "{first} {second}");
}

#[test]
fn counts_lengths_and_flags() {
    let problem = Problem::new(|x: &f64| Spectrum([*x, 1.0, 2.0]))
        .auxiliary(WithIntegral::new(|_: &f64| Spectrum([1.0; 3]), Spectrum([1.0; 3])))
        .proposal(Uniform);
    for firsts in [0, 2, 4] {
        let mut moments = Sums::default();
        let error = problem.accumulate_midzuno_sen(&[Uniform; 4][..firsts], &mut moments, 5, &mut Scripted(&[]));
        assert_eq!(error, Err(Error::LengthMismatch { what: "firsts", expected: 3, got: firsts }));
        assert_eq!(moments.count(), 0);
    }
    let mut moments = Sums::default();
    assert_eq!(problem.accumulate_midzuno_sen(&[Uniform], &mut moments, 0, &mut Scripted(&[])), Ok(()));
    assert_eq!(moments.count(), 0);
    let none = problem.integrate_midzuno_sen(&[Uniform], 0, &mut Scripted(&[])).unwrap_err();
    assert_eq!(none, Error::TooFewDraws { estimator: "ratio", needed: 1, got: 0 });
    let one = problem.integrate_midzuno_sen(&[Uniform], 1, &mut Scripted(&[0.25])).expect("a draw");
    assert_eq!((one.value, one.flags(0)), (Spectrum([0.25, 1.0, 2.0]), Flags::ONE_SAMPLE));

    // Constant f over an h of its own: the first draw falls where g has no density, and says so.
    let calls = Cell::new(0);
    let counted = |x: &f64| {
        calls.set(calls.get() + 1);
        1.0 + 0.0 * x
    };
    let gap = Problem::new(counted)
        .auxiliary(WithIntegral::new(|_: &f64| 1.0, 1.0))
        .proposal(PiecewiseConstant::new(&[1.0, 0.0]).expect("weights"));
    let estimate = gap.integrate_midzuno_sen(&[Uniform], 3, &mut Scripted(&[0.75, 0.0, 0.5, 0.0, 0.5])).expect("draws");
    assert_eq!(calls.get(), 3);
    assert!(estimate.value.is_nan() && estimate.flags(0).contains(Flags::NONFINITE));
}
