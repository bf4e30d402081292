//! The density is the one that is drawn from, and integrates to 1 exactly.

use crate::support::{Words, generator};
use rand_core::Rng;
use ratiocv_core::{Auxiliary, ComponentDensities, Grid, Proposal, Spectrum};
use ratiocv_tests::assert_close;

/// A grid with uneven edges and probabilities: three components in one dimension.
fn uneven() -> Grid<1, 16, 3> {
    let mut grid = Grid::uniform();
    let f =
        |x: &[f64; 1]| Spectrum([1.0 + x[0], libm::exp(-9.0 * x[0]), libm::exp(-300.0 * (x[0] - 0.6) * (x[0] - 0.6))]);
    grid.adapt(&f, 3, 20_000, &mut generator(1));
    assert!(grid.edges(0)[1] != 1.0 / 16.0);
    grid
}

/// Each bin's beginning and end.
fn bins<const D: usize, const B: usize, const C: usize>(grid: &Grid<D, B, C>, dimension: usize) -> [(f64, f64); B] {
    let edges = grid.edges(dimension);
    core::array::from_fn(|bin| (edges[bin], edges.get(bin + 1).copied().unwrap_or(1.0)))
}

#[test]
fn it_integrates_to_one() {
    let grid = uneven();
    for component in 0..3 {
        // Whole multiples of 2⁻³²: density times width is off by one rounding each, then exact.
        let mass = |(lower, upper): (f64, f64)| {
            let mass = grid.at([lower]).densities[component] * (upper - lower);
            let tickets = mass * 4_294_967_296.0;
            assert_close(tickets, tickets.round(), 1e-5, "tickets");
            assert!(tickets.round() >= 1.0);
            tickets.round()
        };
        assert_eq!(bins(&grid, 0).into_iter().map(mass).sum::<f64>(), 4_294_967_296.0);
    }
}

#[test]
fn in_two_dimensions_it_is_a_product_and_integrates_to_one() {
    let mut grid = Grid::<2, 8, 2>::uniform();
    let f = |x: &[f64; 2]| Spectrum([x[0] * x[1] * x[1], (1.0 - x[0]) * (2.0 - x[1])]);
    grid.adapt(&f, 3, 20_000, &mut generator(2));
    for component in 0..2 {
        let mut sum = 0.0;
        for (left, right) in bins(&grid, 0) {
            for (bottom, top) in bins(&grid, 1) {
                sum += grid.at([left, bottom]).densities[component] * (right - left) * (top - bottom);
            }
        }
        assert_close(sum, 1.0, 1e-14, "integral");
    }
}

#[test]
fn positions_have_the_density_it_states() {
    let grid = uneven();
    // Every component, and for each the tickets in steps of 2¹⁶ from the middle of the first step.
    const STEPS: u64 = 1 << 16;
    let mut words = Words::new(|i| {
        let (step, component) = (i / 2 % STEPS, i / 2 / STEPS);
        // The middle of the component's third of the words; the middle of a step, and of a bin.
        if i % 2 == 0 { (2 * component + 1) * (u64::MAX / 6) } else { (2 * step + 1) << 47 | 1 << 31 }
    });
    for component in 0..3 {
        let mut counts = [0.0; 16];
        for _ in 0..STEPS {
            let point = grid.sample(&mut words);
            let bin = grid.edges(0).partition_point(|edge| *edge <= point.x[0]) - 1;
            counts[bin] += 1.0;
            assert_eq!(point, grid.at(point.x), "the draw's densities are those at its position");
        }
        for (bin, (lower, upper)) in bins(&grid, 0).into_iter().enumerate() {
            let expected = grid.at([lower]).densities[component] * (upper - lower) * STEPS as f64;
            // A bin's tickets lie in at most 16 runs, each of which is counted to within one step.
            assert_close(counts[bin], expected, 16.0, "draws in a bin");
        }
    }
}

#[test]
fn places_in_a_bin_are_equidistant() {
    let grid = uneven();
    // One component, one ticket, 64 places.
    let mut words = Words::new(|i| if i % 2 == 0 { 0 } else { (i / 2) << 26 });
    let places: Vec<f64> = (0..64).map(|_| grid.sample(&mut words).x[0]).collect();
    let bin = bins(&grid, 0).into_iter().find(|(lower, upper)| (lower..upper).contains(&&places[0])).unwrap();
    for (i, x) in places.iter().enumerate() {
        assert_close(*x, bin.0 + (bin.1 - bin.0) * (i as f64 / 64.0), 1e-10, "place");
    }
}

#[test]
fn no_word_leads_out_of_the_unit_interval() {
    let grid = uneven();
    for word in [0, u64::from(u32::MAX), u64::MAX, u64::MAX << 32, 1 << 63] {
        let x = grid.sample(&mut Words::new(|_| word)).x[0];
        assert!((0.0..1.0).contains(&x), "{word:x}: {x}");
    }
}

#[test]
fn the_pdf_is_the_mean_of_the_components_and_the_auxiliary_is_the_channels_own() {
    let point = uneven().at([0.7]);
    let [a, b, c] = point.densities;
    assert_close(point.pdf(), (a + b + c) / 3.0, 1e-15, "pdf");
    assert_eq!(Auxiliary::<_, Spectrum<f64, 3>>::value(&ComponentDensities, &point), Spectrum([a, b, c]));
    // Six channels, two to a component; and five, as evenly as they go.
    let six = Auxiliary::<_, Spectrum<f64, 6>>::value(&ComponentDensities, &point);
    assert_eq!(six, Spectrum([a, a, b, b, c, c]));
    let five = Auxiliary::<_, Spectrum<f64, 5>>::value(&ComponentDensities, &point);
    assert_eq!(five, Spectrum([a, a, b, b, c]));
    assert_eq!(Auxiliary::<ratiocv_core::GridPoint<1, 3>, f64>::integral(&ComponentDensities), 1.0);
}

#[test]
fn outside_it_is_zero() {
    let grid = Grid::<2, 4>::uniform();
    for x in [[-1e-9, 0.5], [0.5, 1.0 + 1e-9], [f64::NAN, 0.5], [0.5, f64::INFINITY]] {
        assert_eq!(grid.at(x).pdf(), 0.0, "{x:?}");
    }
    assert_eq!((grid.at([0.0, 0.0]).pdf(), grid.at([1.0, 1.0]).pdf()), (1.0, 1.0));
}

#[test]
fn the_uniform_grid_is_the_identity() {
    let grid = Grid::<2, 32>::uniform();
    let (mut ours, mut words) = (generator(3), generator(3));
    for _ in 0..1000 {
        let point = grid.sample(&mut ours);
        assert_eq!(point.pdf(), 1.0);
        for x in point.x {
            // Five bits for the bin, 32 for the place: the number that they spell.
            let word = words.next_u64();
            let spelt = ((word >> 59) as f64 + ((word as u32) as f64 + 0.5) / 4_294_967_296.0) / 32.0;
            assert_eq!(x, spelt);
        }
    }
}
