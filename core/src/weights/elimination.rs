//! Small linear systems that may be singular.

/// One equation in 2`K` unknowns, which come in two kinds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Equation<const K: usize> {
    pub(super) left: [[f64; K]; 2],
    pub(super) right: f64,
}

/// Far above what rounding leaves of a pivot that should be 0, at most 5·10⁻¹⁴ of the largest after
/// 10⁵ draws (tests/weights/constants.rs), and far below the noise of such a pilot.
const TOLERANCE: f64 = 1e-10;

/// Solves 2`K` equations whose coefficients are of size 1, by Gauss–Jordan elimination with complete
/// pivoting (Golub, Van Loan, *Matrix Computations*, §3.4.8), and says whether the rank was full.
///
/// If it was not, the unknowns that depend on others are 0.
pub(super) fn solve<const K: usize>(mut system: [[Equation<K>; K]; 2]) -> ([[f64; K]; 2], bool) {
    let rows = system.as_flattened_mut();
    let mut solution = [[0.0; K]; 2];
    let mut column_of = [[usize::MAX; K]; 2];
    let mut rank = 0;
    let mut largest = 0.0;
    while rank < rows.len() {
        let (mut pivot, mut at) = (0.0, (rank, 0));
        for (r, row) in rows.iter().enumerate().skip(rank) {
            for (c, entry) in row.left.as_flattened().iter().enumerate() {
                if entry.abs() > pivot {
                    (pivot, at) = (entry.abs(), (r, c));
                }
            }
        }
        largest = if rank == 0 { pivot } else { largest };
        if pivot <= TOLERANCE * largest {
            break;
        }
        rows.swap(rank, at.0);
        let column = at.1;
        let chosen = rows[rank];
        let divisor = chosen.left.as_flattened()[column];
        for (r, row) in rows.iter_mut().enumerate() {
            let factor = row.left.as_flattened()[column] / divisor;
            if r == rank || factor == 0.0 {
                continue;
            }
            for (entry, above) in row.left.as_flattened_mut().iter_mut().zip(chosen.left.as_flattened()) {
                *entry -= factor * above;
            }
            row.left.as_flattened_mut()[column] = 0.0;
            row.right -= factor * chosen.right;
        }
        column_of.as_flattened_mut()[rank] = column;
        rank += 1;
    }
    for (row, column) in rows.iter().zip(column_of.as_flattened()).take(rank) {
        solution.as_flattened_mut()[*column] = row.right / row.left.as_flattened()[*column];
    }
    (solution, rank == rows.len())
}

#[cfg(test)]
mod tests {
    use super::{Equation, solve};

    fn system(left: [[f64; 4]; 4], right: [f64; 4]) -> [[Equation<2>; 2]; 2] {
        let row = |i: usize| Equation { left: [[left[i][0], left[i][1]], [left[i][2], left[i][3]]], right: right[i] };
        [[row(0), row(1)], [row(2), row(3)]]
    }

    #[test]
    fn regular_systems_are_solved() {
        // Times (1, −2, 3, 0.5), by hand; the first pivot is not on the diagonal.
        let left = [[0.0, 1.0, 0.0, 0.0], [1.0, 1.0, 1.0, 2.0], [0.5, 0.0, -1.0, 0.0], [0.0, 0.25, 0.0, 1.0]];
        let (solution, full) = solve(system(left, [-2.0, 3.0, -2.5, 0.0]));
        assert!(full);
        for (ours, right) in solution.as_flattened().iter().zip([1.0, -2.0, 3.0, 0.5]) {
            assert!((ours - right).abs() <= 1e-15, "{solution:?}");
        }
    }

    #[test]
    fn what_depends_on_others_is_zero() {
        let left = [[1.0, 0.5, 1.0, 0.0], [0.5, 1.0, 0.5, 0.0], [1.0, 0.5, 1.0, 0.0], [0.0; 4]];
        let (solution, full) = solve(system(left, [2.0, 2.5, 2.0, 0.0]));
        assert_eq!((solution, full), ([[1.0, 2.0], [0.0, 0.0]], false));
        assert_eq!(solve(system([[0.0; 4]; 4], [1.0; 4])), ([[0.0; 2]; 2], false));
        let (solution, full) = solve(system([[f64::NAN; 4]; 4], [1.0; 4]));
        assert_eq!((solution, full), ([[0.0; 2]; 2], false));
    }
}
