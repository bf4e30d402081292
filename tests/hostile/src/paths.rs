//! Products over paths.

use crate::bytes::{Bytes, Reach};
use crate::exact::Exact;
use ratiocv_core::moments::{Accumulate, Merge};
use ratiocv_core::{Draw, Flags, Integrals, PathProduct, ScaledSums, Spectrum};

type V = Spectrum<f32, 2>;

/// Products of steps, the first channel of any finite numbers, the second hostile or not: exact but for a rounding per
/// step, 0 or infinite only out of range; H = 0 counts as the factor 1; sums and ratios of paths beyond the range of
/// `f64` close to exact ones or flagged; no channel touches another.
pub fn paths(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let split = bytes.below(4);
    let reach = if split == 0 { Reach::Moderate } else { Reach::Finite };
    let mut paths = vec![];
    for _ in 0..=bytes.below(4) {
        let steps: Vec<[f64; 4]> = (0..bytes.below(24))
            .map(|_| core::array::from_fn(|i| bytes.number::<f32>(if i == 3 { Reach::Any } else { reach })))
            .collect();
        paths.push(steps);
    }
    let (mut sums, mut later) = (ScaledSums::<V>::default(), ScaledSums::<V>::default());
    let (mut alone, mut f_sum, mut h_sum) = (ScaledSums::<f32>::default(), vec![], vec![]);
    for (i, steps) in paths.iter().enumerate() {
        let (path, single) = (product(steps), product_alone(steps));
        let (f, h, trivial) = exact(steps);
        let draw = path.draw();
        let error = (2 * steps.len() + 2) as f64 * f64::EPSILON;
        is_rounded(draw.f[0], &f, error, "f");
        is_quotient(draw.h[0][0], &h, error, "h");
        assert_eq!((path.trivial(0), single.trivial(0)), (trivial, trivial), "factors of 1");
        assert_eq!(single.draw().f.to_bits(), draw.f[0].to_bits(), "the other channel changed f");
        assert_eq!(single.draw().h[0].to_bits(), draw.h[0][0].to_bits(), "the other channel changed h");
        if i < split {
            sums.add(path)
        } else {
            later.add(path)
        }
        alone.add(single);
        f_sum.push(f);
        h_sum.push(h);
    }
    sums.merge(&later);
    assert_eq!(sums.count(), paths.len() as u64);
    let (ours, single) = (sums.ratio_of_means().channel(0), alone.ratio_of_means().channel(0));
    // Merged, so that the sums were taken in another order.
    let steps = paths.iter().map(Vec::len).max().unwrap_or_default();
    let error = (4 * steps + 2 * paths.len() + 8) as f64 * f64::EPSILON;
    ratio_is(&f_sum, &h_sum, ours.value, ours.flags, error);
    ratio_is(&f_sum, &h_sum, single.value, single.flags, error);
}

fn product(steps: &[[f64; 4]]) -> PathProduct<V> {
    let mut path = PathProduct::default();
    for [f, h, integral, other] in steps {
        let pair = |x: &f64| Spectrum([*x as f32, *other as f32]);
        path.extend(Draw::new(pair(f), pair(h)), &Integrals::new([Spectrum([*integral, *other])]));
    }
    path
}

fn product_alone(steps: &[[f64; 4]]) -> PathProduct<f32> {
    let mut path = PathProduct::default();
    for [f, h, integral, _] in steps {
        path.extend(Draw::new(*f as f32, *h as f32), &Integrals::new([*integral]));
    }
    path
}

/// A quotient of exact numbers.
type Quotient = (Exact, Exact);

/// Πf, Πh/H and how many H are 0.
fn exact(steps: &[[f64; 4]]) -> (Exact, Quotient, u32) {
    let one = Exact::new(1.0);
    let (mut f, mut over, mut under, mut trivial) = (one.clone(), one.clone(), one, 0);
    for [f_step, h, integral, _] in steps {
        f = &f * &Exact::new(*f_step);
        if *integral == 0.0 {
            trivial += 1;
        } else {
            over = &over * &Exact::new(*h);
            under = &under * &Exact::new(*integral);
        }
    }
    (f, (over, under), trivial)
}

fn is_rounded(ours: f32, right: &Exact, error: f64, what: &str) {
    is_quotient(ours, &(right.clone(), Exact::new(1.0)), error, what);
}

/// Panics unless `ours` is the quotient, rounded to `f32` after an error of `error`.
fn is_quotient(ours: f32, (over, under): &Quotient, error: f64, what: &str) {
    let right = over.over(under);
    if ours.is_infinite() {
        assert!(right.abs() > f64::from(f32::MAX) * (1.0 - 1e-6), "{what}: {ours} for {right:e}");
        return;
    }
    let off = (f64::from(ours) - right).abs();
    let allowed = (f64::from(f32::EPSILON) + error) * right.abs() + f64::from(f32::from_bits(1));
    assert!(off <= allowed, "{what}: {ours:e} for {right:e}");
}

/// Panics unless `value` is Σf/Σh as far as the digits of the sums go, or flagged.
fn ratio_is(f: &[Exact], h: &[Quotient], value: f64, flags: Flags, error: f64) {
    // On one denominator.
    let common = h.iter().fold(Exact::new(1.0), |all, (_, under)| &all * under);
    let others = |i: usize| {
        h.iter().enumerate().filter(|(j, _)| *j != i).fold(Exact::new(1.0), |all, (_, (_, under))| &all * under)
    };
    let h: Vec<Exact> = h.iter().enumerate().map(|(i, (over, _))| over * &others(i)).collect();
    let (f_sum, h_sum) = (Exact::sum(f.iter().cloned()), Exact::sum(h.iter().cloned()));
    let size = |terms: &[Exact]| Exact::sum(terms.iter().map(Exact::abs));
    if h_sum.is_zero() {
        let why = Flags::DENOM_ZERO | Flags::NO_SUPPORT | Flags::NONFINITE | Flags::LOW_ESS;
        let cancelled = h.len() > 1 && !size(&h).is_zero();
        assert!((flags & why) != Flags::NONE || cancelled, "no flag says that Σh is 0: {value} {flags}");
        return;
    }
    let condition = |sum: &Exact, terms: &[Exact]| size(terms).over(&sum.abs());
    let of_h = condition(&h_sum, &h);
    if of_h * error > 0.01 {
        return;
    }
    let right = (&f_sum * &common).over(&h_sum);
    let of_f = (&size(f) * &common).over(&h_sum).abs();
    let allowed = 2.0 * error * (of_f + of_h * right.abs()) + 5e-324;
    if flags.fell_back() {
        assert!(flags.contains(Flags::NONFINITE), "{value:e} {flags} for {right:e}");
        // Also where what cancels left rounding that is beyond it.
        assert!(right.abs() + allowed > f64::MAX / 4.0, "{value} {flags} for {right:e}");
        return;
    }
    if right.abs() > f64::MAX / 2.0 {
        return;
    }
    let off = (value - right).abs();
    assert!(off <= allowed, "{value:e} {flags} for {right:e}");
}
