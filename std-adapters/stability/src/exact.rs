//! Exact answers on rounded input, by whole numbers.

/// Mean and Σ(x − x̄)²/(n − `less`) of `xs`, right to the last digit or so.
///
/// Every number is a multiple of a power of two, and what they differ by is counted in it: sums are exact in 128
/// bits for a few thousand numbers that are of the same sign and size.
pub fn mean_and_variance(xs: &[f64], less: f64) -> (f64, f64) {
    // The finest unit that any of them needs.
    let mut unit = 1.0;
    while xs.iter().any(|x| libm::fmod(x / unit, 1.0) != 0.0) {
        unit /= 2.0;
    }
    let first = (xs[0] / unit) as i128;
    let deviations = || xs.iter().map(|x| (x / unit) as i128 - first);
    let (n, sum, squares) =
        deviations().fold((0_i128, 0_i128, 0_i128), |(n, sum, squares), d| (n + 1, sum + d, squares + d * d));
    let about = n * squares - sum * sum;
    let count = n as f64;
    let mean = (n * first + sum) as f64 / count * unit;
    (mean, about as f64 / count / (count - less) * unit * unit)
}

/// The largest over the smallest eigenvalue of the correlations of `columns`, by Jacobi's rotations.
pub fn condition<const K: usize>(rows: &[[f64; K]]) -> f64 {
    let n = rows.len() as f64;
    let mean: [f64; K] = core::array::from_fn(|k| rows.iter().map(|row| row[k]).sum::<f64>() / n);
    let product = |i: usize, j: usize| rows.iter().map(|row| (row[i] - mean[i]) * (row[j] - mean[j])).sum::<f64>();
    let mut a: [[f64; K]; K] = core::array::from_fn(|i| {
        core::array::from_fn(|j| product(i, j) / libm::sqrt(product(i, i)) / libm::sqrt(product(j, j)))
    });
    for _ in 0..30 {
        for p in 0..K {
            for q in p + 1..K {
                let angle = 0.5 * libm::atan2(2.0 * a[p][q], a[q][q] - a[p][p]);
                let (s, c) = (libm::sin(angle), libm::cos(angle));
                for row in &mut a {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                let (above, below) = (a[p], a[q]);
                for k in 0..K {
                    (a[p][k], a[q][k]) = (c * above[k] - s * below[k], s * above[k] + c * below[k]);
                }
            }
        }
    }
    let eigenvalues = || (0..K).map(|k| a[k][k].abs());
    eigenvalues().fold(0.0, f64::max) / eigenvalues().fold(f64::INFINITY, f64::min)
}
