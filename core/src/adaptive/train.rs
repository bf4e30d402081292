//! How a grid learns: the marginals of ‖f‖, each bin's a ratio of means.
//!
//! The product of the marginals of a function is the product density that is nearest to it in
//! Kullback–Leibler divergence. A bin's share of |f_c| is p·mean(y)/mean(x) over the draws that fell
//! there, with y = |f_c|/g, x = g_c/g and p the share of g_c, which is known: a ratio control
//! variate. So what the grid already knows is not noise: once g_c ∝ |f_c|, nothing moves.

use crate::adaptive::axis::Axis;
use crate::adaptive::grid::Grid;
use crate::adaptive::point::{GridPoint, component_of};
use crate::lanes::Lanes;
use crate::planted::planted;
use crate::problem::Integrand;
use crate::sampling::l2_norm;
use core::array::from_fn;
use rand_core::Rng;

/// Effective draws that a bin's share rests on, its neighbours' if its own are too few: a relative
/// error of a fifth, which the next round repairs. But no more than a quarter of all there are.
const ENOUGH_FOR_A_BIN: f64 = 30.0;

/// Effective draws that a round should have in all.
const ENOUGH: f64 = 100.0;

/// One draw in so many is a pilot's, which chooses what the others are to learn.
const PILOT: u64 = 8;

/// The pilot tries |f|, √|f|, … by so many square roots at most.
const ROOTS: usize = 8;

impl<const D: usize, const B: usize, const C: usize> Grid<D, B, C> {
    /// Learns `integrand` in `rounds` rounds of `draws` draws each.
    ///
    /// Each round draws from the grid as it is, estimates the marginals of the L2 norm of each
    /// component's group of channels, and makes them its bins' probabilities; between rounds the edges
    /// move. Channels j of M belong to component ⌊jC/M⌋. Where the effective sample size (Σy)²/Σy²
    /// (Kish 1965) is small, because the integrand is a peak that uniform draws hardly meet, a round
    /// learns |f|^½, |f|^¼, … instead, which point to it from further away; where that of a bin is
    /// small, the bin is taken together with its neighbours. 4 to 6 rounds of 10 000 to 100 000 draws
    /// are usual.
    ///
    /// The draws are not used for an estimate: the first rounds' would have to count for less, and
    /// weights that depend on the draws, such as inverse variances, make it biased.
    ///
    /// A draw where the norm is not finite teaches its component nothing. A component whose channels
    /// were 0 or not finite in every draw keeps its density, as an average over the bins that the
    /// others ask for; 0 draws change nothing. The integrand times a power of two gives the same bits.
    /// For a product |f_c| the density tends to it, up to the width of the bins. Where no product
    /// resembles f, as for a ridge along a diagonal, there is nothing to gain, and the noise of the
    /// grid costs about a twentieth. Needs 24·B·C·D bytes of stack.
    ///
    /// ```
    /// use rand_core::SeedableRng;
    /// use ratiocv_core::Grid;
    /// let mut rng = rand_pcg::Pcg64::seed_from_u64(1);
    /// let mut grid = Grid::<1, 16>::uniform();
    /// grid.adapt(&|x: &[f64; 1]| if x[0] < 0.25 { 3.0 } else { 1.0 }, 4, 10_000, &mut rng);
    /// assert!((grid.at([0.2]).pdf() - 2.0).abs() < 0.05);
    /// assert!((grid.at([0.8]).pdf() - 2.0 / 3.0).abs() < 0.02);
    /// ```
    pub fn adapt<F: Integrand<[f64; D]>, R: Rng + ?Sized>(
        &mut self,
        integrand: &F,
        rounds: u32,
        draws: u64,
        rng: &mut R,
    ) {
        for round in 0..rounds {
            let learned = self.train(integrand, draws, rng);
            if learned && round + 1 < rounds {
                self.axes.iter_mut().for_each(Axis::refine);
            }
        }
    }

    /// One round; whether there was something to learn.
    fn train<F: Integrand<[f64; D]>, R: Rng + ?Sized>(&mut self, integrand: &F, draws: u64, rng: &mut R) -> bool {
        let pilot = draws / PILOT;
        let targets = self.targets(integrand, pilot, rng);
        let mut cells = [[[Cell::default(); B]; D]; C];
        for _ in pilot..draws {
            let (point, bins) = self.draw(rng);
            let norms = norms(integrand, &point);
            for (component, cells) in cells.iter_mut().enumerate() {
                let cell = Cell::of(targets[component].of(norms[component]), &point, component);
                for (cells, bin) in cells.iter_mut().zip(bins) {
                    cells[bin].add(&cell);
                }
            }
        }
        let mut learned = false;
        for (component, cells) in cells.iter().enumerate() {
            // Every dimension has the same draws.
            let all = Cell::sum(&cells[0]);
            if all.effective() > 0.0 {
                learned = true;
                let enough = ENOUGH_FOR_A_BIN.min(all.effective() / 4.0);
                // As many draws as have `enough` effective ones among them.
                let doubt = planted!("train_doubt": enough, 1e9) * all.x / all.effective();
                for (axis, cells) in self.axes.iter_mut().zip(cells) {
                    axis.reweigh(component, &from_fn(|bin| ratio_about(cells, bin, enough, doubt)));
                }
            }
        }
        learned
    }

    /// What each component should learn, by `draws` draws.
    fn targets<F: Integrand<[f64; D]>, R: Rng + ?Sized>(&self, integrand: &F, draws: u64, rng: &mut R) -> [Target; C] {
        let mut units = [0.0; C];
        let mut cells = [[Cell::default(); ROOTS + 1]; C];
        for _ in 0..draws {
            let (point, _) = self.draw(rng);
            let norms = norms(integrand, &point);
            for (component, unit) in units.iter_mut().enumerate() {
                if *unit == 0.0 && norms[component].is_finite() {
                    *unit = norms[component];
                }
                for (roots, cell) in cells[component].iter_mut().enumerate() {
                    cell.add(&Cell::of(Target { unit: *unit, roots }.of(norms[component]), &point, component));
                }
            }
        }
        from_fn(|component| {
            let enough = |cell: &Cell| cell.effective() * PILOT as f64 >= ENOUGH;
            let roots = cells[component].iter().position(enough).unwrap_or(ROOTS);
            Target { unit: units[component], roots: planted!("train_roots": roots, 0) }
        })
    }
}

/// The L2 norm of f over the channels of each component.
fn norms<F: Integrand<[f64; D]>, const D: usize, const C: usize>(integrand: &F, point: &GridPoint<D, C>) -> [f64; C] {
    const { assert!(C <= F::Value::LANES, "a grid needs no more components than the integrand has channels") };
    let f = integrand.value(&point.x).widen();
    from_fn(|component| {
        let its_own = |channel| component_of::<C>(channel, F::Value::LANES) == component;
        l2_norm(<F::Value as Lanes>::Wide::from_fn(|channel| if its_own(channel) { f.get(channel) } else { 0.0 }))
    })
}

/// A function to be learned: the norm in units of `unit`, and so many square roots of it.
#[derive(Clone, Copy, Debug)]
struct Target {
    unit: f64,
    roots: usize,
}

impl Target {
    fn of(&self, norm: f64) -> f64 {
        if norm == 0.0 { 0.0 } else { (0..self.roots).fold(norm / self.unit, |norm, _| libm::sqrt(norm)) }
    }
}

/// Sums over draws.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    /// Σy.
    y: f64,
    /// Σy².
    yy: f64,
    /// Σx.
    x: f64,
}

impl Cell {
    /// One draw, of a target's value there; nothing, if that is not finite.
    fn of<const D: usize, const C: usize>(value: f64, point: &GridPoint<D, C>, component: usize) -> Self {
        let y = value / point.pdf();
        let x = planted!("train_x": point.densities[component] / point.pdf(), 1.0);
        if y.is_finite() { Self { y, yy: y * y, x } } else { Self::default() }
    }

    fn add(&mut self, other: &Self) {
        self.y += other.y;
        self.yy += other.yy;
        self.x += other.x;
    }

    fn sum(cells: &[Self]) -> Self {
        let mut sum = Self::default();
        cells.iter().for_each(|cell| sum.add(cell));
        sum
    }

    /// The effective number of draws; 0 where y is 0, or its squares are out of range.
    fn effective(&self) -> f64 {
        let effective = self.y / self.yy * self.y;
        if effective.is_finite() { effective } else { 0.0 }
    }
}

/// Σy/Σx of `bin`, with `doubt` draws added that are like those of as many neighbours as it takes for
/// `enough` effective draws: its own Σy/Σx if it has them, almost 0 if it has many draws and all are 0.
fn ratio_about<const B: usize>(cells: &[Cell; B], bin: usize, enough: f64, doubt: f64) -> f64 {
    let mut about = cells[bin];
    for reach in 1..B {
        if about.effective() >= enough {
            break;
        }
        for neighbour in [bin.checked_sub(reach), bin.checked_add(reach)].into_iter().flatten() {
            about.add(cells.get(neighbour).unwrap_or(&Cell::default()));
        }
    }
    (cells[bin].y + doubt * (about.y / about.x)) / (cells[bin].x + doubt)
}
