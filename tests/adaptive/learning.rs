//! What a grid learns, and what it keeps when there is nothing to learn.

use crate::support::generator;
use proptest::prelude::*;
use ratiocv_core::{Grid, Plain, Spectrum};
use ratiocv_tests::assert_close;

/// Two steps that bins can match: 3 : 1 at x = 1/4, 1 : 9 at y = 1/2.
fn steps(x: &[f64; 2]) -> f64 {
    (if x[0] < 0.25 { 3.0 } else { 1.0 }) * (if x[1] < 0.5 { 1.0 } else { 9.0 })
}

#[test]
fn a_product_of_steps_is_learned() {
    let mut grid = Grid::<2, 4>::uniform();
    // One round moves no edge. 100 000 draws: a standard error below 0.01 of any bin's share.
    grid.adapt(&steps, 1, 100_000, &mut generator(1));
    for x in [[0.1, 0.1], [0.1, 0.9], [0.9, 0.1], [0.9, 0.9]] {
        let right = steps(&x) / (1.5 * 5.0);
        assert_close(grid.at(x).pdf() / right, 1.0, 0.05, "density");
    }
}

#[test]
fn rounds_leave_a_part_in_a_hundred() {
    // Shares that are ratios of means: what earlier rounds learned is no longer noise. Two bins of
    // each dimension have a step inside and are a compromise; the places are far from those.
    let mut grid = Grid::<2, 64>::uniform();
    grid.adapt(&steps, 6, 20_000, &mut generator(2));
    for x in [[0.1, 0.1], [0.1, 0.9], [0.9, 0.1], [0.9, 0.9]] {
        let right = steps(&x) / (1.5 * 5.0);
        assert_close(grid.at(x).pdf() / right, 1.0, 0.03, "density");
    }
}

#[test]
fn what_a_grid_already_has_is_no_noise() {
    let mut grid = Grid::<2, 16, 2>::uniform();
    grid.adapt(&|x: &[f64; 2]| Spectrum([steps(x), x[0]]), 3, 10_000, &mut generator(3));
    // Each component's own density: whatever is drawn, every ratio is the same number.
    let mut again = grid;
    again.adapt(&|x: &[f64; 2]| Spectrum(grid.at(*x).densities.map(|g| 5.0 * g)), 1, 2_000, &mut generator(4));
    for x in [[0.1, 0.1], [0.1, 0.9], [0.6, 0.2], [0.99, 0.99]] {
        for component in 0..2 {
            // A few tickets of 2⁻³², of bins that have 2⁻¹⁵ at least.
            let ratio = again.at(x).densities[component] / grid.at(x).densities[component];
            assert_close(ratio, 1.0, 1e-4, "density");
        }
    }
}

#[test]
fn one_component_learns_the_norm_and_several_their_channels() {
    // Channels 1 and 2 live on either half, three times as strong on the left.
    let f = |x: &[f64; 1]| if x[0] < 0.5 { Spectrum([-3.0, 0.0]) } else { Spectrum([0.0, 1.0]) };
    let mut norm = Grid::<1, 4, 1>::uniform();
    norm.adapt(&f, 1, 10_000, &mut generator(5));
    assert_close(norm.at([0.2]).pdf(), 1.5, 0.05, "left");
    assert_close(norm.at([0.8]).pdf(), 0.5, 0.05, "right");
    let mut each = Grid::<1, 4, 2>::uniform();
    each.adapt(&f, 1, 10_000, &mut generator(5));
    let (left, right) = (each.at([0.2]).densities, each.at([0.8]).densities);
    // In bins of zeros 60 draws of doubt against 2187: up to 0.03 of their neighbours' density.
    assert_close(left[0], 2.0, 0.03, "first component, left");
    assert_close(left[1], 0.0, 0.03, "second component, left");
    assert_close(right[1], 2.0, 0.03, "second component, right");
}

#[test]
fn the_norm_of_two_channels_is_their_l2_norm() {
    // (3, 4) has the norm 5, not 7 or 4: against 1 on the right.
    let f = |x: &[f64; 1]| if x[0] < 0.5 { Spectrum([3.0, -4.0]) } else { Spectrum([1.0, 0.0]) };
    let mut grid = Grid::<1, 2>::uniform();
    grid.adapt(&f, 1, 100_000, &mut generator(6));
    assert_close(grid.at([0.2]).pdf() / grid.at([0.8]).pdf(), 5.0, 0.1, "ratio");
}

#[test]
fn a_peak_that_uniform_draws_hardly_meet_is_found() {
    // A millionth of the volume is within three standard deviations of the peak.
    let f = |x: &[f64; 4]| libm::exp(-1e4 * x.iter().map(|x| (x - 0.31) * (x - 0.31)).sum::<f64>());
    let mut grid = Grid::<4, 64>::uniform();
    grid.adapt(&f, 8, 20_000, &mut generator(7));
    // The normal density of variance 1/20 000 at its peak is 1e8/π².
    let right = 1e8 / (core::f64::consts::PI * core::f64::consts::PI);
    assert_close(grid.at([0.31; 4]).pdf() / right, 1.0, 0.3, "density at the peak");
    // And integrated with as few draws, of which none from the cube would have met it.
    let estimate = grid.problem(f).integrate(&Plain, 10_000, &mut generator(8)).unwrap();
    let exact = 1.0 / right;
    assert!(estimate.flags(0).is_empty() && estimate.std_error <= 0.01 * exact, "{estimate:?}");
    assert_close(estimate.value, exact, 5.0 * estimate.std_error, "integral");
}

#[test]
fn a_box_that_twenty_draws_hit_is_found() {
    // A thousandth of the volume: uniform draws have a relative standard deviation of 31.6.
    let f = |x: &[f64; 3]| f64::from(u8::from(x.iter().all(|x| (0.4..0.5).contains(x))));
    let mut grid = Grid::<3, 64>::uniform();
    grid.adapt(&f, 6, 20_000, &mut generator(13));
    // Were it found exactly, 1000; three dimensions lose a little each at the box's faces.
    let inside = grid.at([0.45; 3]).pdf();
    assert!((700.0..1100.0).contains(&inside), "{inside}");
}

#[test]
fn a_bin_of_zeros_counts_as_such() {
    // The right half is 0 in thousands of draws: next to nothing of the density may stay there.
    let mut grid = Grid::<1, 4>::uniform();
    grid.adapt(&|x: &[f64; 1]| f64::from(u8::from(x[0] < 0.5)), 1, 20_000, &mut generator(14));
    assert!(grid.at([0.7]).pdf() <= 0.01 && grid.at([0.9]).pdf() > 0.0);
}

#[test]
fn a_grid_takes_the_documented_memory() {
    assert_eq!(size_of::<Grid<4, 64, 3>>(), 4 * 64 * (24 + 16 * 3));
    assert_eq!(size_of::<Grid<1, 2>>(), 2 * (24 + 16));
}

#[test]
fn nothing_to_learn_leaves_the_grid_as_it_is() {
    let mut trained = Grid::<2, 16>::uniform();
    trained.adapt(&steps, 3, 10_000, &mut generator(8));
    let nothing: [fn(&[f64; 2]) -> f64; 4] =
        [|_| 0.0, |_| f64::NAN, |_| f64::INFINITY, |x| if x[0] < 0.5 { f64::NAN } else { f64::NEG_INFINITY }];
    for f in nothing {
        let mut grid = trained;
        grid.adapt(&f, 4, 1_000, &mut generator(9));
        assert_eq!(grid, trained);
    }
    for (rounds, draws) in [(0, 1_000), (3, 0), (3, 1), (3, 7)] {
        let mut grid = trained;
        grid.adapt(&steps, rounds, draws, &mut generator(9));
        assert_eq!(grid, trained, "{rounds} rounds of {draws}");
    }
}

#[test]
fn a_bad_channel_spoils_no_other() {
    let good = |x: &[f64; 2]| steps(x);
    let run = |bad: fn(&[f64; 2]) -> f64| {
        let mut grid = Grid::<2, 16, 2>::uniform();
        grid.adapt(&|x: &[f64; 2]| Spectrum([good(x), bad(x)]), 1, 20_000, &mut generator(10));
        grid
    };
    let alone = run(|_| 0.0);
    for bad in [run(|_| f64::NAN), run(|_| f64::INFINITY), run(|x| x[0] - 0.5)] {
        for x in [[0.1, 0.1], [0.1, 0.9], [0.6, 0.2]] {
            assert_eq!(bad.at(x).densities[0].to_bits(), alone.at(x).densities[0].to_bits());
        }
    }
    // A component that learned nothing stays uniform, over the edges that the other one asks for.
    let mut grid = Grid::<2, 16, 2>::uniform();
    grid.adapt(&|x: &[f64; 2]| Spectrum([good(x), 0.0]), 4, 20_000, &mut generator(10));
    assert!(grid.edges(0)[1] != 1.0 / 16.0);
    for x in [[0.1, 0.1], [0.1, 0.9], [0.6, 0.2]] {
        assert_close(grid.at(x).densities[1], 1.0, 1e-6, "the other component");
    }
}

#[test]
fn infinite_draws_teach_nothing_and_the_others_do() {
    // A pole at 0: infinite in the first bin's first hundredth.
    let f = |x: &[f64; 1]| if x[0] < 0.01 { f64::INFINITY } else { 1.0 + 2.0 * f64::from(u8::from(x[0] >= 0.5)) };
    let mut grid = Grid::<1, 2>::uniform();
    grid.adapt(&f, 1, 100_000, &mut generator(11));
    assert_close(grid.at([0.7]).pdf(), 1.5, 0.03, "density");
}

#[test]
fn the_same_seed_gives_the_same_bits_and_scale_does_not_matter() {
    let f = |scale: f64| {
        let mut grid = Grid::<2, 32, 2>::uniform();
        let f = |x: &[f64; 2]| Spectrum([scale * steps(x), scale * x[0], scale * x[1]]);
        grid.adapt(&f, 4, 5_000, &mut generator(12));
        grid
    };
    assert_eq!(f(1.0), f(1.0));
    for power in [-900, 900] {
        assert_eq!(f(libm::exp2(f64::from(power))), f(1.0), "2^{power}");
    }
}

#[test]
fn a_new_seed_gives_other_bits() {
    let grid = |seed| {
        let mut grid = Grid::<2, 32>::uniform();
        grid.adapt(&steps, 2, 5_000, &mut generator(seed));
        grid
    };
    assert!(grid(1) != grid(2));
}

proptest! {
    /// Whatever the integrand: edges increase, no density is 0 or infinite, and all integrates to 1.
    #[test]
    fn a_grid_stays_usable(
        values in prop::collection::vec(
            prop_oneof![
                4 => -4.0..8.0_f64,
                2 => Just(0.0),
                1 => Just(f64::NAN),
                1 => Just(f64::INFINITY),
                1 => (-300..300_i32).prop_map(|e| 10_f64.powi(e)),
            ],
            16,
        ),
        seed in any::<u64>(),
        rounds in 1..5_u32,
        draws in 0..3000_u64,
    ) {
        let mut grid = Grid::<1, 8, 2>::uniform();
        let f = |x: &[f64; 1]| {
            let place = (x[0] * 8.0) as usize;
            Spectrum([values[place], values[8 + place]])
        };
        grid.adapt(&f, rounds, draws, &mut generator(seed));
        let edges = *grid.edges(0);
        prop_assert_eq!(edges[0], 0.0);
        let mut integral = [0.0; 2];
        for bin in 0..8 {
            let upper = edges.get(bin + 1).copied().unwrap_or(1.0);
            prop_assert!(upper - edges[bin] >= libm::exp2(-40.0));
            for (component, density) in grid.at([edges[bin]]).densities.into_iter().enumerate() {
                prop_assert!(density > 0.0 && density < f64::INFINITY);
                integral[component] += density * (upper - edges[bin]);
            }
        }
        prop_assert!((integral[0] - 1.0).abs() <= 1e-15 * 8.0 && (integral[1] - 1.0).abs() <= 1e-15 * 8.0);
    }
}
