//! Coefficients of several auxiliaries against a rational oracle.

use crate::bytes::{Bytes, Reach, draws};
use crate::exact::{Exact, determinant, without};
use crate::truth::Truth;
use ratiocv_core::moments::{Accumulate, Comoments, HasComoments, Moments};
use ratiocv_core::{Dependent, Difference, Draw, Estimator, Fit, Flags, Integrals, Regression};

/// The least-squares coefficients of up to three auxiliaries: those of Cramer's rule in rational arithmetic where the
/// auxiliaries are independent, as far as the condition allows; where they are not, one of the solutions, and RANK as
/// far as the digits of the moments go.
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
    let spread = moments.closed().channel(0).comoments();
    let about = entries[0].clone().about(steepest);
    for i in 0..K {
        for j in 0..=i {
            entries[i + 1].products_are::<f64>(&entries[j + 1], spread.hh[i][j], "products of two auxiliaries");
        }
        entries[i + 1].products_are::<f64>(&about, spread.fh(i), "products with f");
    }
    let constant = |k: usize| matrix[k][k].is_zero();
    for k in (0..K).filter(|k| constant(*k)) {
        assert_eq!(beta[k], 0.0, "the coefficient of a constant");
    }
    let varying: Vec<usize> = (0..K).filter(|k| !constant(*k)).collect();
    let block: Vec<Vec<Exact>> =
        varying.iter().map(|i| varying.iter().map(|j| matrix[*i][*j].clone()).collect()).collect();
    if varying.is_empty() {
        return;
    }
    let size = |x: &Exact| libm::sqrt(x.over(&entries[0].count));
    let sizes: [f64; K] = core::array::from_fn(|k| size(&matrix[k][k]));
    let size_f = size(&entries[0].products(&entries[0]));
    // By how much the moments that are solved are off, in units of their sizes.
    let off = |ours: f64, right: &Exact, sizes: f64| {
        (&(&Exact::new(ours) * &entries[0].count) - right).abs().over(&entries[0].count) / sizes
    };
    let pairs = || varying.iter().flat_map(|i| varying.iter().map(|j| (*i, *j)));
    let eta = pairs().map(|(i, j)| off(spread.hh[i][j], &matrix[i][j], sizes[i] * sizes[j])).fold(0.0_f64, f64::max);
    let eta_f = varying.iter().map(|k| off(spread.fh(*k), &right[*k], sizes[*k] * size_f)).fold(0.0, f64::max);
    let reached = size_f + varying.iter().map(|k| beta[*k].abs() * sizes[*k]).sum::<f64>();
    // Three roundings in each of three steps on numbers that pivoting keeps below (1 + 2)².
    let noise = eta.max(eta_f) + 81.0 * f64::EPSILON / 2.0;
    if determinant(&block).is_zero() {
        let told = is_told(varying.len(), eta) || has_copies(&points, &varying);
        assert!(!told || flags.contains(Flags::RANK), "dependent, moments off by {eta:e}, and no RANK: {beta:?}");
        // Of the many solutions it is one: the normal equations hold. Of an unknown that was dropped with a share of
        // at most the tolerance, Σ(x − x̂)(f − f̂) is at most √share·‖x‖·‖f‖ (Cauchy and Schwarz); the others' are
        // off by what the moments are, and by rounding.
        for i in &varying {
            let ours = Exact::sum((0..K).map(|j| &matrix[*i][j] * &Exact::new(beta[j])));
            let off = (&ours - &right[*i]).abs().over(&entries[0].count);
            let allowed = sizes[*i] * (libm::sqrt(TOLERANCE + 4.0 * eta) * size_f + noise * reached);
            assert!(
                off <= allowed,
                "equation {i} of {beta:?} {flags} is off by {off:e}, allowed {allowed:e}; sizes {sizes:?}, {size_f}; η {eta:e} {eta_f:e}"
            );
        }
    } else if varying.len() == K && least > 1e-6 {
        assert!(!flags.contains(Flags::RANK), "independent auxiliaries, share {least:e}, and RANK: {beta:?}");
        for k in 0..K {
            // Cramer's rule.
            let replaced: Vec<Vec<Exact>> = (0..K)
                .map(|i| (0..K).map(|j| if j == k { right[i].clone() } else { matrix[i][j].clone() }).collect())
                .collect();
            let oracle = determinant(&replaced).over(&whole);
            // Each equation is off by noise·reached, and coefficient k by the inverse's row k times that. With every size
            // 1 the diagonal of the inverse is 1/share, and no entry is above the mean of its two on the diagonal
            // (geometric: Cauchy and Schwarz).
            let allowed = K as f64 * noise * reached / libm::sqrt(share(k) * least) / sizes[k];
            let off = (beta[k] - oracle).abs();
            assert!(off <= allowed, "coefficient {k} is {} and should be {oracle}, allowed {allowed:e}", beta[k]);
        }
    }
}

/// The share of its own variance that an auxiliary must have left, in units of which nothing else is known: what
/// `Regression` asks of the moments of `f64` draws.
const TOLERANCE: f64 = 64.0 * f64::EPSILON;

/// Whether `count` exactly dependent auxiliaries must be found to be, from second moments that are off by at most `eta`
/// in units of their sizes.
///
/// After the pivots before the last two, what is left of these is off by φ ≤ 4η + 3u, u the unit roundoff: of two
/// columns with coefficients of at most 1 each, (1 + 1)²η, and three roundings. With all there are two that is 4η for
/// the last alone. Of three, the second pivot is above the tolerance τ, or both are dropped, and is the larger one, so
/// that the coefficient of the last in it is exactly at most c, c² = (τ + φ)/(τ − φ), and the last share, the least of
/// all combinations, is at most that one's, (1 + c)²φ, and rounding.
fn is_told(count: usize, eta: f64) -> bool {
    let unit = f64::EPSILON / 2.0;
    let left = 4.0 * eta + 3.0 * unit;
    match count {
        1 => false,
        2 => left + unit <= TOLERANCE,
        _ if left >= TOLERANCE => false,
        _ => {
            let c = libm::sqrt((TOLERANCE + left) / (TOLERANCE - left));
            (1.0 + c) * (1.0 + c) * left + 4.0 * unit <= TOLERANCE
        }
    }
}

/// Whether one auxiliary is another one, or its negative: their moments are the same to the bit.
fn has_copies<const N: usize>(points: &[[f64; N]], varying: &[usize]) -> bool {
    let copies = |i: usize, j: usize| {
        let is = |sign: f64| points.iter().all(|point| point[i + 1] == sign * point[j + 1]);
        is(1.0) || is(-1.0)
    };
    varying.iter().any(|i| varying.iter().any(|j| i < j && copies(*i, *j)))
}
