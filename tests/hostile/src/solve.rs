//! Coefficients of several auxiliaries against a rational oracle.

use crate::bytes::{Bytes, Reach, draws};
use crate::exact::{Exact, determinant, without};
use crate::truth::Truth;
use ratiocv_core::moments::{Accumulate, Comoments, HasComoments, Moments};
use ratiocv_core::{Dependent, Difference, Draw, Estimator, Fit, Flags, Integrals, Regression};

/// The least-squares coefficients of up to three auxiliaries: those of Cramer's rule in rational arithmetic where the
/// auxiliaries are independent, as far as the condition allows; where they are not, one of the solutions.
pub fn solve(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    match bytes.byte() % 3 {
        0 => of::<1, 2>(&mut bytes),
        1 => of::<2, 3>(&mut bytes),
        _ => of::<3, 4>(&mut bytes),
    }
}

fn of<const K: usize, const N: usize>(bytes: &mut Bytes<'_>) {
    let points = bytes.points::<f64, N>(Reach::Moderate, 40);
    let draws: Vec<Draw<f64, K>> = draws(&points);
    let entries: [Truth; N] =
        core::array::from_fn(|i| Truth::new(&points.iter().map(|point| point[i]).collect::<Vec<_>>()));
    let (mut moments, mut steepest) = (Comoments::<f64, K>::default(), 0.0_f64);
    for draw in &draws {
        moments.add(*draw);
        let slope = moments.closed().channel(0).comoments().slope;
        let reached: f64 = (0..K).map(|k| slope[k].abs() * entries[k + 1].range).sum();
        steepest = steepest.max(reached);
    }
    let n = draws.len() as f64;
    let matrix: Vec<Vec<Exact>> =
        (0..K).map(|i| (0..K).map(|j| entries[i + 1].products(&entries[j + 1])).collect()).collect();
    let right: Vec<Exact> = (0..K).map(|i| entries[0].products(&entries[i + 1])).collect();
    let whole = determinant(&matrix);
    // The share of each auxiliary that the others do not explain.
    let share = |k: usize| {
        let rest: Vec<Vec<Exact>> = without(&matrix, k).iter().map(|row| without(row, k)).collect();
        whole.over(&(&determinant(&rest) * &matrix[k][k]))
    };
    let least = (0..K).map(share).fold(1.0, |least: f64, share| if share < least { share } else { least });

    let regression = Regression { shrink: false, dependent: Dependent::MinimumNorm };
    let difference = Difference { regression };
    let beta = difference.learn(&moments, &Integrals::ONE).coefficients;
    let flags = difference.estimate_anyway(&moments, &Integrals::ONE).flags(0);
    let unsolved = flags.contains(Flags::RANK) || flags.contains(Flags::ALPHA);
    assert!(beta.iter().all(|beta| beta.is_finite()), "{beta:?}");
    if draws.len() < 2 {
        assert!(unsolved && beta == [0.0; K], "{beta:?} {flags} of one draw");
        return;
    }
    let constant = |k: usize| matrix[k][k].is_zero();
    for k in (0..K).filter(|k| constant(*k)) {
        assert_eq!(beta[k], 0.0, "the coefficient of a constant");
    }
    // What rounding of the moments may do to a normal equation, relative to n·range².
    let rounding = 3000.0 * (n + 8.0) * f64::EPSILON;
    if whole.is_zero() || (0..K).any(constant) {
        let varying: Vec<usize> = (0..K).filter(|k| !constant(*k)).collect();
        let rows = |all: &[usize]| -> Vec<Vec<Exact>> {
            all.iter().map(|i| all.iter().map(|j| matrix[*i][*j].clone()).collect()).collect()
        };
        // Of the many solutions it is one: the normal equations hold, to six digits, since rounding may leave a share of
        // an auxiliary that has none.
        let size = entries[0].range + steepest + (0..K).map(|j| beta[j].abs() * entries[j + 1].range).sum::<f64>();
        // Where scales are far apart the shares of dependent auxiliaries lose digits.
        let ranges = || varying.iter().map(|k| entries[k + 1].range);
        let alike = ranges().fold(0.0, f64::max) <= 100.0 * ranges().fold(f64::INFINITY, f64::min);
        // Nor may two be nearly dependent, and not quite.
        let clear = |i: &usize, j: &usize| {
            let share = determinant(&rows(&[*i, *j])).over(&(&matrix[*i][*i] * &matrix[*j][*j]));
            i == j || share == 0.0 || share > 1e-6
        };
        let clear = varying.iter().all(|i| varying.iter().all(|j| clear(i, j)));
        for i in (0..K).filter(|_| alike && clear) {
            let ours = Exact::sum((0..K).map(|j| &matrix[i][j] * &Exact::new(beta[j])));
            let off = (&ours - &right[i]).abs().over(&entries[0].count);
            let allowed = 1e-6 * n * entries[i + 1].range * size;
            assert!(off <= allowed, "equation {i} of {beta:?} is off by {off:e}, allowed {allowed:e}");
        }
    } else if least > 1e-6 {
        assert!(!flags.contains(Flags::RANK), "independent auxiliaries, share {least:e}, and RANK: {beta:?}");
        for k in 0..K {
            // Cramer's rule.
            let replaced: Vec<Vec<Exact>> = (0..K)
                .map(|i| (0..K).map(|j| if j == k { right[i].clone() } else { matrix[i][j].clone() }).collect())
                .collect();
            let oracle = determinant(&replaced).over(&whole);
            let range = |i: usize| entries[i].range;
            let size = range(0) + steepest + (0..K).map(|j| beta[j].abs() * range(j + 1)).sum::<f64>();
            // Squares against the square of the range: at least 1/(2n).
            let spread = matrix[k][k].over(&(&entries[0].count * &Exact::new(range(k + 1) * range(k + 1) * n)));
            let allowed = rounding / (least * spread * spread.min(1.0)) * size / range(k + 1) / n;
            let off = (beta[k] - oracle).abs();
            assert!(off <= allowed, "coefficient {k} is {} and should be {oracle}, allowed {allowed:e}", beta[k]);
        }
    }
}
