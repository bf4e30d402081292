//! Small symmetric systems, one per lane: the normal equations of a regression on `K` auxiliaries.

use crate::filled::filled;
use crate::lanes::Lanes;
use crate::planted::planted;

/// a·x = b as far as `a` has a rank.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solution<W, const K: usize> {
    /// The solution; 0 for unknowns that were dropped.
    pub(crate) x: [W; K],
    /// 1 for each unknown that is determined, 0 for those that were dropped.
    pub(crate) determined: [W; K],
    /// The eliminated system: what a dropped unknown adds to the others.
    rest: [[W; K]; K],
}

/// Solves a·x = b for a symmetric, positive semidefinite `a`, in the unknowns that are `wanted` (1; 0
/// for those to be left at 0).
///
/// Gauss–Jordan elimination with the pivots on the diagonal, the next pivot always the unknown with the
/// largest *share* of its own variance left: a ratio, so that the scales of the unknowns do not
/// matter. Unknowns whose share is at most `tolerance`, a linear combination of the others, are dropped.
/// Each lane has its own order of pivots, by selection, without branches. For `K` = 1 it is b/a.
///
/// Lanes with entries that are not finite have a solution that is not finite, or drop everything.
#[inline(always)]
pub(crate) fn solve<W: Lanes<Scalar = f64>, const K: usize>(
    a: &[[W; K]; K],
    b: &[W; K],
    wanted: &[W; K],
    tolerance: f64,
) -> Solution<W, K> {
    let (mut rest, mut x, mut free, mut determined) = (*a, *b, *wanted, [W::ZERO; K]);
    if K == 1 {
        // No order to find, nothing to eliminate.
        let determined = filled(W::ZERO, |k| wanted[k].only(W::ZERO.lt(a[k][k])));
        let over = |k: usize| (b[k] / a[k][k]).only(W::equal(determined[k], W::ONE));
        return Solution { x: filled(W::ZERO, over), determined, rest };
    }
    for _ in 0..K {
        let (mut largest, mut chosen) = (W::splat(tolerance), W::splat(-1.0));
        for k in 0..K {
            let share = (rest[k][k] / a[k][k]).only(W::equal(free[k], W::ONE));
            let better = largest.lt(share);
            largest = W::select(better, share, largest);
            chosen = W::select(better, W::splat(k as f64), chosen);
        }
        let is_chosen: [W::Mask; K] = filled(W::ZERO.lt(W::ZERO), |k| W::equal(chosen, W::splat(k as f64)));
        let pick = |of: &dyn Fn(usize) -> W, otherwise: W| {
            (0..K).fold(otherwise, |picked, k| W::select(is_chosen[k], of(k), picked))
        };
        // Where no pivot is left, a row of zeros is subtracted.
        // Of columns that are eliminated rounding leaves a rest, which a small pivot would make a large one.
        let left = |j: usize| planted!("solve_left_over": W::equal(determined[j], W::ONE), W::ZERO.lt(W::ZERO));
        let row: [W; K] = filled(W::ZERO, |j| pick(&|k| rest[k][j], W::ZERO).except(left(j)));
        let (pivot, right) = (pick(&|k| rest[k][k], W::ONE), pick(&|k| x[k], W::ZERO));
        for i in 0..K {
            let factor = (pick(&|k| rest[i][k], W::ZERO) / pivot).except(is_chosen[i]);
            for j in 0..K {
                rest[i][j] = rest[i][j] - factor * row[j];
            }
            x[i] = x[i] - planted!("solve_right_side": factor, factor * factor) * right;
            free[i] = free[i].except(is_chosen[i]);
            determined[i] = W::select(is_chosen[i], W::ONE, determined[i]);
        }
    }
    let x = filled(W::ZERO, |k| (x[k] / rest[k][k]).only(W::equal(determined[k], W::ONE)));
    Solution { x, determined, rest }
}

impl<W: Lanes<Scalar = f64>, const K: usize> Solution<W, K> {
    /// Of all solutions, which differ where unknowns were dropped, the one of least Σx²: that of the
    /// pseudoinverse, where all unknowns were wanted.
    pub(crate) fn of_minimum_norm(&self) -> [W; K] {
        // x_p = c_p − Σ_q t_pq·x_q for dropped q; Σ_p x_p² + Σ_q x_q² is least where (1 + tᵀt)x_q = tᵀc.
        let is_determined = |k: usize| W::equal(self.determined[k], W::ONE);
        let t =
            |p: usize, q: usize| (self.rest[p][q] / self.rest[p][p]).only(is_determined(p)).except(is_determined(q));
        let products = |one: &dyn Fn(usize) -> W, other: &dyn Fn(usize) -> W| {
            (0..K).fold(W::ZERO, |sum, p| sum + one(p) * other(p))
        };
        let unit = |i: usize, j: usize| if i == j { W::ONE } else { W::ZERO };
        let normal = filled([W::ZERO; K], |i| filled(W::ZERO, |j| unit(i, j) + products(&|p| t(p, i), &|p| t(p, j))));
        let right = filled(W::ZERO, |q| products(&|p| t(p, q), &|p| self.x[p]));
        let dropped = solve(&normal, &right, &[W::ONE; K], 0.0).x;
        filled(W::ZERO, |k| {
            let moved = (0..K).fold(self.x[k], |x, q| x - t(k, q) * dropped[q]);
            W::select(is_determined(k), planted!("minimum_norm": moved, self.x[k]), dropped[k])
        })
    }

    /// 1 where an unknown that was wanted is not determined.
    pub(crate) fn lacks_rank(&self, wanted: &[W; K]) -> W {
        (0..K).fold(W::ZERO, |lacks, k| W::select(W::equal(wanted[k], self.determined[k]), lacks, W::ONE))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::Spectrum;

    const ALL: [f64; 3] = [1.0; 3];

    #[test]
    fn a_regular_system_is_solved_whatever_its_scales() {
        // a = lᵀl with integer l; x = (1, −2, 3).
        let a = [[14.0, 8.0, 3.0], [8.0, 5.0, 2.0], [3.0, 2.0, 1.0]];
        let b = [14.0 - 16.0 + 9.0, 8.0 - 10.0 + 6.0, 3.0 - 4.0 + 3.0];
        for scale in [[1.0, 1.0, 1.0], [1e-100, 1.0, 1e120], [1e30, 1e-60, 1e10]] {
            let scaled = core::array::from_fn(|i| core::array::from_fn(|j| scale[i] * a[i][j] * scale[j]));
            let right = core::array::from_fn(|i| scale[i] * b[i]);
            let solution = solve(&scaled, &right, &ALL, 1e-14);
            for (k, expected) in [1.0, -2.0, 3.0].into_iter().enumerate() {
                let x = solution.x[k] * scale[k];
                assert!((x - expected).abs() <= 1e-13, "{x} for {expected}");
            }
            assert_eq!(solution.determined, ALL);
            assert_eq!(solution.lacks_rank(&ALL), 0.0);
        }
    }

    /// Found by fuzzing: the second pivot is 1e-13 of the variance, and the rest of the first column, times 1e13,
    /// changed the first pivot by 0.2 percent.
    #[test]
    fn a_small_pivot_does_not_change_the_others() {
        let a: [[f64; 2]; 2] = [[87500007445322.22, 87500009066408.75], [87500009066408.75, 87500010687501.72]];
        let b = [74999986382810.11, 74999997875010.38];
        let x = solve(&a, &b, &[1.0; 2], 1e-14).x;
        assert!(x[1] > 1e6, "{x:?}");
        for i in 0..2 {
            let off = (a[i][0] * x[0] + a[i][1] * x[1] - b[i]).abs();
            assert!(off <= 1e-15 * a[i][1] * x[1], "equation {i} is off by {off:e}: {x:?}");
        }
    }

    #[test]
    fn what_depends_on_the_others_is_dropped_or_shared() {
        // The third is the sum of the first two.
        let a = [[2.0, 1.0, 3.0], [1.0, 3.0, 4.0], [3.0, 4.0, 7.0]];
        let b = [4.0, 7.0, 11.0]; // x = (1, 2, 0) + z(1, 1, −1)
        let solution = solve(&a, &b, &ALL, 1e-14);
        assert_eq!(solution.determined.iter().sum::<f64>(), 2.0);
        assert_eq!(solution.lacks_rank(&ALL), 1.0);
        // Least norm: z = −1.
        for (x, expected) in solution.of_minimum_norm().into_iter().zip([0.0, 1.0, 1.0]) {
            assert!((x - expected).abs() <= 1e-14, "{x} for {expected}");
        }
        let twice = solve(&[[1.0, 1.0], [1.0, 1.0]], &[3.0, 3.0], &[1.0; 2], 1e-14);
        assert_eq!(twice.of_minimum_norm(), [1.5, 1.5]);
    }

    #[test]
    fn nothing_to_solve_gives_zero() {
        let nothing = solve(&[[0.0; 2]; 2], &[0.0; 2], &[1.0; 2], 1e-14);
        assert_eq!((nothing.x, nothing.determined), ([0.0; 2], [0.0; 2]));
        assert_eq!(nothing.of_minimum_norm(), [0.0; 2]);
        let unwanted = solve(&[[2.0, 0.5], [0.5, 1.0]], &[1.0, 2.0], &[0.0, 1.0], 1e-14);
        assert_eq!((unwanted.x, unwanted.determined), ([0.0, 2.0], [0.0, 1.0]));
        assert_eq!(solve(&[[4.0]], &[2.0], &[1.0], 1e-14).x, [0.5]);
        assert_eq!(solve(&[[0.0]], &[2.0], &[1.0], 1e-14).x, [0.0]);
    }

    #[test]
    fn each_lane_is_solved_as_if_it_were_alone() {
        type Lanes4 = Spectrum<f64, 4>;
        let system = |lane: usize, i: usize, j: usize| {
            let l = [[1.0, 0.0, 0.0], [0.3 * lane as f64, 1.0, 0.0], [0.5, lane as f64 - 1.0, (lane % 2) as f64]];
            (0..3).map(|k| l[i][k] * l[j][k] * 10.0_f64.powi(lane as i32 * (i + j) as i32)).sum::<f64>()
        };
        let right = |lane: usize, i: usize| 1.0 + (lane * 3 + i) as f64 % 5.0;
        let a = core::array::from_fn(|i| core::array::from_fn(|j| Lanes4::from_fn(|lane| system(lane, i, j))));
        let b = core::array::from_fn(|i| Lanes4::from_fn(|lane| right(lane, i)));
        let packed = solve::<Lanes4, 3>(&a, &b, &[Lanes4::ONE; 3], 1e-14);
        let least = packed.of_minimum_norm();
        for lane in 0..4 {
            let a = core::array::from_fn(|i| core::array::from_fn(|j| system(lane, i, j)));
            let alone = solve(&a, &core::array::from_fn(|i| right(lane, i)), &ALL, 1e-14);
            for (k, alone_least) in alone.of_minimum_norm().into_iter().enumerate() {
                assert_eq!(packed.x[k].get(lane).to_bits(), alone.x[k].to_bits());
                assert_eq!(least[k].get(lane).to_bits(), alone_least.to_bits());
            }
            assert_eq!(packed.lacks_rank(&[Lanes4::ONE; 3]).get(lane), if lane % 2 == 0 { 1.0 } else { 0.0 });
        }
    }
}
