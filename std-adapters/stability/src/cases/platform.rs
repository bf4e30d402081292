//! H: the platform.

use super::both;
use crate::case::{Ask, Case};
use crate::method::number;
use crate::noise::noise;
use crate::probe::{Probe, Probes};
use ratiocv_core::moments::{Accumulate, Comoments, Merge};
use ratiocv_core::{ChannelEstimate, Draw, Estimator, Flags, Integrals, Lanes, RatioOfMeans, Scalar, Spectrum};

pub(super) fn cases() -> Vec<Case> {
    both(|precision| {
        let probe = |id, about, probes, right| Case::new(id, about, precision, Ask::Probe(probes), right).exact();
        let threads = precision.of(any_threads::<f32> as fn() -> ChannelEstimate, any_threads::<f64>);
        vec![
            probe("H1", "half of the least normal number is not flushed to 0", Probes::of::<Subnormal>(precision), 0.5),
            probe("H2", "a·a − b, where fusing them leaves a rest", Probes::of::<Unfused>(precision), 0.0)
                .naive(precision.of(fused_single, fused_double)),
            probe(
                "H3",
                "2.5·u + u of the least subnormal number u, in u: 4 if fused",
                Probes::of::<UnfusedSubnormal>(precision),
                3.0,
            ),
            probe("H4", "bits of x^½, eˣ and ln x, as a checksum", Probes::once("libm", functions), PINNED),
            probe(
                "H5",
                "chunks on 1, 2, 3, 8 threads, merged in one tree",
                Probes::once("Spectrum<_, 3>", threads),
                0.0,
            ),
        ]
    })
}

/// The first 32 bits of what `functions` gives, found on x86-64: every platform must find them.
const PINNED: f64 = 2_087_735_771.0;

/// Half of the least normal number, in units of it: the worst lane.
struct Subnormal;

impl Probe for Subnormal {
    fn on<V: Lanes>() -> ChannelEstimate {
        let normal =
            if V::Scalar::from_f64(1e-300).widen() == 0.0 { f64::from(f32::MIN_POSITIVE) } else { f64::MIN_POSITIVE };
        let half = V::splat(V::Scalar::from_f64(core::hint::black_box(normal))) * V::splat(V::Scalar::from_f64(0.5));
        let least = (0..V::LANES).map(|lane| half.get(lane).widen()).fold(f64::INFINITY, f64::min);
        number(least / normal, Flags::NONE)
    }
}

/// a·a − b for a = 1 + u and b = fl(a·a), u = 2⁻¹² (`f32`) or 2⁻²⁷: 0 unless fused.
struct Unfused;

impl Probe for Unfused {
    fn on<V: Lanes>() -> ChannelEstimate {
        let exponent = if V::Scalar::from_f64(1e-300).widen() == 0.0 { -12.0 } else { -27.0 };
        let u = libm::exp2(exponent);
        let (a, b) = core::hint::black_box((1.0 + u, 1.0 + 2.0 * u));
        let [a, b] = [a, b].map(|x| V::splat(V::Scalar::from_f64(x)));
        let rest = a * a - b;
        let worst = (0..V::LANES).map(|lane| rest.get(lane).widen().abs()).fold(0.0, f64::max);
        number(worst, Flags::NONE)
    }
}

/// (2.5·u + u)/u: 2.5·u is rounded to 2u, for ties go to even; 3.5·u would be to 4u.
struct UnfusedSubnormal;

impl Probe for UnfusedSubnormal {
    fn on<V: Lanes>() -> ChannelEstimate {
        let single = V::Scalar::from_f64(1e-300).widen() == 0.0;
        let least = core::hint::black_box(if single { f64::from(f32::from_bits(1)) } else { f64::from_bits(1) });
        let (times, u) = (V::splat(V::Scalar::from_f64(2.5)), V::splat(V::Scalar::from_f64(least)));
        let sum = times * u + u;
        let worst = (0..V::LANES).map(|lane| sum.get(lane).widen() / least).fold(3.0, |worst: f64, here| {
            if (here - 3.0).abs() > (worst - 3.0).abs() || here.is_nan() { here } else { worst }
        });
        number(worst, Flags::NONE)
    }
}

fn fused_single() -> f64 {
    let u = libm::exp2(-12.0);
    f64::from(libm::fmaf(1.0 + u as f32, 1.0 + u as f32, -(1.0 + 2.0 * u as f32)))
}

fn fused_double() -> f64 {
    let u = libm::exp2(-27.0);
    libm::fma(1.0 + u, 1.0 + u, -(1.0 + 2.0 * u))
}

/// A checksum (FNV-1a) of what the functions of the value path give for 4096 numbers.
fn functions() -> ChannelEstimate {
    let mut digest = 0xcbf2_9ce4_8422_2325_u64;
    for i in 0..4096 {
        let x = 100.0 * noise(4, i) + 1e-3;
        for y in [libm::pow(x, 0.5 + noise(5, i)), libm::exp(x), libm::log(x)] {
            digest = (digest ^ y.to_bits()).wrapping_mul(0x100_0000_01b3);
        }
    }
    number((digest >> 32) as f64, Flags::NONE)
}

/// How many channels have other bits than on one thread.
fn any_threads<S: Scalar>() -> ChannelEstimate {
    type Rgb<S> = Spectrum<S, 3>;
    let chunk = |c: usize| {
        let mut moments = Comoments::<Rgb<S>>::default();
        for i in 0..1000 {
            let x =
                |k: usize| Rgb::<S>::from_fn(|lane| S::from_f64(0.5 + noise(60 + k as u64, (c * 1000 + i) * 3 + lane)));
            moments.add(Draw::new(x(0), x(1)));
        }
        moments
    };
    let estimate = |threads: usize| {
        let mut chunks = vec![Comoments::<Rgb<S>>::default(); 16];
        std::thread::scope(|scope| {
            // Thread t takes every `threads`th chunk, from the end.
            for (t, mut mine) in split(&mut chunks, threads).into_iter().enumerate() {
                scope.spawn(move || {
                    mine.iter_mut().enumerate().rev().for_each(|(i, out)| **out = chunk(i * threads + t))
                });
            }
        });
        while chunks.len() > 1 {
            let merge = |pair: &[Comoments<Rgb<S>>]| {
                let mut first = pair[0];
                first.merge(&pair[1]);
                first
            };
            chunks = chunks.chunks(2).map(merge).collect();
        }
        RatioOfMeans.estimate_anyway(&chunks[0], &Integrals::ONE)
    };
    let right = estimate(1);
    let mut differ = 0;
    for threads in [2, 3, 8] {
        let ours = estimate(threads);
        differ += (0..3).filter(|i| ours.channel(*i) != right.channel(*i)).count();
    }
    number(differ as f64, Flags::NONE)
}

/// Part t has the chunks t, t + `parts`, ….
fn split<T>(chunks: &mut [T], parts: usize) -> Vec<Vec<&mut T>> {
    let mut split: Vec<Vec<&mut T>> = (0..parts).map(|_| Vec::new()).collect();
    chunks.iter_mut().enumerate().for_each(|(i, chunk)| split[i % parts].push(chunk));
    split
}
