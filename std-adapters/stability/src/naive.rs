//! The textbook formulas, in the precision of the draws, as one would write them down.

use crate::case::{Ask, Precision};
use crate::draws::Draws;
use crate::method::{Method, Several};
use ratiocv_core::Scalar;

/// What the formula makes of `ask`; NaN for a probe.
pub(crate) fn naive(ask: &Ask, precision: Precision) -> f64 {
    precision.of(of::<f32> as fn(&Ask) -> f64, of::<f64>)(ask)
}

fn of<S: Scalar>(ask: &Ask) -> f64 {
    match ask {
        Ask::One { method, draws, then, integral } => {
            let mut sums = Sums::<S>::default();
            for part in [Some(draws), then.as_ref()].into_iter().flatten() {
                sums.add_all(part, |draw| [draw.f, draw.h[0]]);
            }
            one(*method, &sums, &pairs(draws, then.as_ref()), S::from_f64(*integral)).widen()
        }
        Ask::Two { method, draws, integrals } => two::<S>(*method, draws, *integrals).widen(),
        Ask::Five { which, draws } => five::<S>(draws)[*which].widen(),
        Ask::Probe(_) => f64::NAN,
    }
}

/// Raw sums of f and h; doublings double them.
#[derive(Clone, Copy)]
struct Sums<S> {
    n: S,
    f: S,
    h: S,
    ff: S,
    fh: S,
    hh: S,
    abs_h: S,
    ratios: S,
}

impl<S: Scalar> Default for Sums<S> {
    fn default() -> Self {
        let zero = S::ZERO;
        Self { n: zero, f: zero, h: zero, ff: zero, fh: zero, hh: zero, abs_h: zero, ratios: zero }
    }
}

impl<S: Scalar> Sums<S> {
    fn add(&mut self, f: S, h: S) {
        self.n = self.n + S::ONE;
        self.f = self.f + f;
        self.h = self.h + h;
        self.ff = self.ff + f * f;
        self.fh = self.fh + f * h;
        self.hh = self.hh + h * h;
        self.abs_h = self.abs_h + h.abs();
        self.ratios = self.ratios + f / h;
    }

    fn add_all(&mut self, draws: &Draws, each: impl Fn(ratiocv_core::Draw<f64>) -> [f64; 2]) {
        // Up to a limit, what is doubled is added as often: that is where counters stick.
        let spelt_out = if draws.total() <= 1 << 25 { 1_usize << draws.doublings } else { 1 };
        for _ in 0..spelt_out {
            for i in 0..draws.count {
                let [f, h] = each(draws.get(i)).map(S::from_f64);
                self.add(f, h);
            }
        }
        if spelt_out == 1 && draws.doublings > 0 {
            let times = S::from_f64(libm::exp2(f64::from(draws.doublings)));
            let Self { n, f, h, ff, fh, hh, abs_h, ratios } = *self;
            *self = Self {
                n: n * times,
                f: f * times,
                h: h * times,
                ff: ff * times,
                fh: fh * times,
                hh: hh * times,
                abs_h: abs_h * times,
                ratios: ratios * times,
            };
        }
    }
}

/// The draws themselves, for formulas that need them again; few of them.
fn pairs<S: Scalar>(draws: &Draws, then: Option<&Draws>) -> Vec<[S; 2]> {
    let some = |draws: &Draws| (0..draws.count.min(1 << 16)).map(|i| draws.get(i)).collect::<Vec<_>>();
    let all = some(draws).into_iter().chain(then.map(some).unwrap_or_default());
    all.map(|draw| [draw.f, draw.h[0]].map(S::from_f64)).collect()
}

fn number<S: Scalar>(x: f64) -> S {
    S::from_f64(x)
}

fn power<S: Scalar>(base: S, exponent: S) -> S {
    S::from_f64(libm::pow(base.widen(), exponent.widen()))
}

fn one<S: Scalar>(method: Method, sums: &Sums<S>, pairs: &[[S; 2]], integral: S) -> S {
    let Sums { n, f, h, ff, fh, hh, .. } = *sums;
    let (mean_f, mean_h) = (f / n, h / n);
    let ratio = f / h;
    let less = n - S::ONE;
    let (c_hh, c_fh) = ((hh - h * h / n) / less, (fh - f * h / n) / less);
    let beta = c_fh / c_hh;
    let alpha = beta * mean_h / mean_f;
    let part = |keep: &dyn Fn(usize) -> bool| {
        let kept = pairs.iter().enumerate().filter(|(i, _)| keep(*i));
        kept.fold([S::ZERO; 3], |[n, f, h], (_, pair)| [n + S::ONE, f + pair[0], h + pair[1]])
    };
    match method {
        Method::Plain => mean_f,
        Method::Ratio | Method::RatioUnlessIll => ratio * integral,
        Method::Quenouille => {
            let halves = [0, 1].map(|parity| part(&|i| i % 2 == parity));
            let half = number::<S>(0.5);
            halves.iter().fold((S::ONE + S::ONE) * ratio, |sum, [_, f, h]| sum - half * (*f / *h)) * integral
        }
        Method::Beale => (mean_f * mean_h + c_fh / n) / (mean_h * mean_h + c_hh / n) * integral,
        Method::Tin => {
            let curvature = c_fh / (mean_f * mean_h) - c_hh / (mean_h * mean_h);
            ratio * (S::ONE + curvature / n) * integral
        }
        Method::Jackknife => {
            let left = (0..pairs.len()).map(|out| (f - pairs[out][0]) / (h - pairs[out][1]));
            (n * ratio - less * left.fold(S::ZERO, |sum, ratio| sum + ratio) / n) * integral
        }
        Method::MeanOfRatios => sums.ratios / n * integral,
        Method::HartleyRoss => {
            let mean = sums.ratios / n;
            mean * integral + n / less * (mean_f - mean * mean_h)
        }
        Method::Mickey => (0..pairs.len()).fold(mean_f, |value, out| {
            let [own_f, own_h] = pairs[out];
            value - (f - own_f) / (h - own_h) * (own_h - integral) / n
        }),
        Method::Difference => mean_f + beta * (integral - mean_h),
        Method::RegressionRatio | Method::FreeRatio => mean_f * power(integral / mean_h, alpha),
        Method::Power(alpha) => mean_f * power(integral / mean_h, number(alpha)),
        Method::OptimalDefensive => {
            let [floor, rest] = [number::<S>(0.01), number(0.99)];
            f / (floor * n * integral + rest * h) * integral
        }
        Method::Choose => ratio * integral,
        Method::Alpha => alpha,
        Method::Variance(less) => (ff - f * f / n) / (n - number(less)),
        Method::Residual => {
            let c_ff = ff - f * f / n;
            let two = S::ONE + S::ONE;
            let residual = c_ff - two * ratio * (c_fh * less) + ratio * ratio * (c_hh * less);
            let roundoff = S::epsilon() / two;
            residual / c_ff / roundoff / roundoff
        }
        Method::Condition => sums.abs_h / h.abs(),
    }
}

fn two<S: Scalar>(method: Several, draws: &Draws<2>, integrals: [f64; 2]) -> S {
    let n = number::<S>(draws.count as f64);
    let [one, other] = integrals.map(S::from_f64);
    let rows: Vec<[S; 3]> =
        (0..draws.count).map(|i| draws.get(i)).map(|d| [d.f, d.h[0], d.h[1]].map(S::from_f64)).collect();
    let sum = |of: &dyn Fn(&[S; 3]) -> S| rows.iter().fold(S::ZERO, |sum, row| sum + of(row));
    let mean: [S; 3] = core::array::from_fn(|i| sum(&|row| row[i]) / n);
    let c = |i: usize, j: usize| sum(&|row| row[i] * row[j]) - n * mean[i] * mean[j];
    let determinant = c(1, 1) * c(2, 2) - c(1, 2) * c(1, 2);
    let beta =
        [(c(0, 1) * c(2, 2) - c(0, 2) * c(1, 2)) / determinant, (c(0, 2) * c(1, 1) - c(0, 1) * c(1, 2)) / determinant];
    // Of u_k = h_k/H_k and y/F: the supplement's Lemma 12 (Lu et al. 2025) for two.
    let u = |row: &[S; 3]| [row[1] / one, row[2] / other];
    let value = mean[0];
    let top = sum(&|row| (u(row)[1] - u(row)[0]) * (row[0] / value - u(row)[0]));
    let second = top / sum(&|row| (u(row)[1] - u(row)[0]) * (u(row)[1] - u(row)[0]));
    let mixture = |a: [S; 2]| mean[0] * (a[0] + a[1]) / (a[0] * mean[1] / one + a[1] * mean[2] / other);
    match method {
        Several::Difference => mean[0] + beta[0] * (one - mean[1]) + beta[1] * (other - mean[2]),
        Several::Beta(which) => beta[which],
        Several::Weight(which) => [S::ONE - second, second][which],
        Several::RandomMixture | Several::OptimalDefensive => mixture([S::ONE - second, second]),
        Several::Mixture(weights) => mixture(weights.map(S::from_f64)),
    }
}

/// Normal equations of raw powers, by Gauss's elimination without pivots; the intercept last.
fn five<S: Scalar>(draws: &Draws<5>) -> [S; 6] {
    let mut a = [[S::ZERO; 7]; 6];
    for i in 0..draws.count {
        let draw = draws.get(i);
        let row: [S; 7] = core::array::from_fn(|k| match k {
            5 => S::ONE,
            6 => S::from_f64(draw.f),
            k => S::from_f64(draw.h[k]),
        });
        for (j, line) in a.iter_mut().enumerate() {
            for (entry, x) in line.iter_mut().zip(row) {
                *entry = *entry + row[j] * x;
            }
        }
    }
    for pivot in 0..6 {
        for other in (0..6).filter(|other| *other != pivot) {
            let (line, above) = (a[other], a[pivot]);
            let factor = line[pivot] / above[pivot];
            a[other] = core::array::from_fn(|column| line[column] - factor * above[column]);
        }
    }
    core::array::from_fn(|k| a[k][6] / a[k][k])
}
