//! What a random number and a draw of `peaks-4d` cost, one by one and many at a time: `sampling [SECONDS]`.
//!
//! Every row is the quickest of many windows of some 10 µs, spread over the run, so that rows are comparable
//! on a machine with other work. Cycles are those of a chain of dependent multiplications, four to a step.

use core::array::from_fn;
use core::hint::black_box;
use core::time::Duration;
use rand_core::Rng;
use rand_pcg::Pcg64;
use ratiocv_core::moments::{Accumulate, BLOCK, Comoments, Moments};
use ratiocv_core::{Draw, Estimator, Integrals, RatioOfMeans, Spectrum, unit_interval};
use ratiocv_report::problems::{Peaks, PeaksBlock, Rows, Solved, Source};
use ratiocv_simd::Xoshiro16;
use ratiocv_simd::functions::Elementary;
use std::time::Instant;

/// Numbers, or draws, in a window.
const N: usize = 4 * BLOCK;

/// Steps that wait for each other: an exclusive or, one cycle, and a multiplication, three.
#[inline(never)]
fn chain() -> u64 {
    (0..N).fold(black_box(1), |x, _| (x ^ 0x55).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

#[inline(never)]
fn one_by_one<T: Default + Copy>(numbers: &mut [T], mut next: impl FnMut() -> T) {
    numbers.iter_mut().for_each(|number| *number = next());
}

#[inline(never)]
fn words(rng: &mut Xoshiro16, numbers: &mut [u64]) {
    rng.fill(numbers);
}

#[inline(never)]
fn uniforms(rng: &mut Xoshiro16, numbers: &mut [f64]) {
    rng.fill_unit(numbers);
}

/// f/g and h/g of one block, from five uniform numbers each.
type FAndH<T> = [Rows<T, 3, BLOCK>; 2];

#[inline(never)]
fn draws<T: Elementary>(block: &PeaksBlock<T>, rng: &mut Xoshiro16) -> FAndH<T> {
    let [mut f, mut h] = [[[T::ZERO; BLOCK]; 3]; 2];
    block.draws(&T::unit_intervals(rng), &mut f, &mut h);
    [f, h]
}

/// Σf, Σh, Σf², Σfh and Σh² of each channel.
type Sums = [[f64; 5]; 3];

#[inline(never)]
fn add<T: Elementary>(sums: &mut Sums, [f, h]: &FAndH<T>) {
    for (sums, (f, h)) in sums.iter_mut().zip(f.iter().zip(h)) {
        let mut parts = [[T::ZERO; 16]; 5];
        for (f, h) in f.as_chunks::<16>().0.iter().zip(h.as_chunks::<16>().0) {
            for i in 0..16 {
                let terms = [f[i], h[i], f[i] * f[i], f[i] * h[i], h[i] * h[i]];
                for (parts, term) in parts.iter_mut().zip(terms) {
                    parts[i] = parts[i] + term;
                }
            }
        }
        for (sum, parts) in sums.iter_mut().zip(parts) {
            *sum += parts.into_iter().map(T::widen).sum::<f64>();
        }
    }
}

/// The same draws in the accumulator of an estimator with error bars.
#[inline(never)]
fn accumulate(moments: &mut Comoments<Spectrum<f32, 3>>, [f, h]: &FAndH<f32>) {
    let draws: [_; BLOCK] = from_fn(|i| Draw::new(Spectrum(from_fn(|k| f[k][i])), Spectrum(from_fn(|k| h[k][i]))));
    moments.add_batch(&draws);
}

/// Its mean ratios must be F, to five standard errors.
fn check(moments: &Comoments<Spectrum<f64, 3>>) {
    let estimate = RatioOfMeans.estimate(moments, &Integrals::new([Spectrum([1.0; 3])])).expect("draws");
    for k in 0..3 {
        let error = estimate.value[k] - Peaks.exact()[k];
        assert!(error.abs() <= 5.0 * estimate.std_error[k], "peak {k}: {error} off");
    }
}

fn checks() {
    let (mut rng, mut same) = (Xoshiro16::stream(1, 0), Xoshiro16::stream(1, 0));
    let mut numbers = [0; 1000];
    rng.fill(&mut numbers);
    assert!(numbers.iter().all(|number| *number == same.next_u64()));
    for all in [true, false] {
        let mut moments = Comoments::default();
        if all {
            Peaks.source().accumulate(&mut moments, 1 << 16, &mut rng);
        } else {
            Peaks.one_by_one().accumulate(&mut moments, 1 << 16, &mut rng);
        }
        check(&moments);
    }
    let (mut f64s, mut f32s) = (Sums::default(), Sums::default());
    for _ in 0..1 << 14 {
        add(&mut f64s, &draws(&Peaks.block::<f64>(), &mut rng));
        add(&mut f32s, &draws(&Peaks.block::<f32>(), &mut rng));
    }
    for sums in [f64s, f32s] {
        for (k, sums) in sums.iter().enumerate() {
            // About 2⁻¹⁰/√3 of noise: eight standard errors.
            assert!((sums[0] / sums[1] / Peaks.exact()[k] - 1.0).abs() <= 0.005, "peak {k}: {sums:?}");
        }
    }
}

/// What is measured, with a name; each has a generator and room for results of its own.
type Row = (&'static str, Box<dyn FnMut()>);

fn rows() -> Vec<Row> {
    let (pcg, lanes) = (|| Pcg64::new(1, 2), || Xoshiro16::stream(1, 2));
    let (mut a, mut b, mut c, mut d, mut e) = (pcg(), lanes(), lanes(), pcg(), lanes());
    vec![
        ("chain of 4 cycles", Box::new(|| _ = black_box(chain()))),
        filled("u64: Pcg64", move |numbers| one_by_one(numbers, || a.next_u64())),
        filled("u64: Xoshiro16, one by one", move |numbers| one_by_one(numbers, || b.next_u64())),
        filled("u64: Xoshiro16", move |numbers| words(&mut c, numbers)),
        filled("[0, 1): Pcg64", move |numbers| one_by_one(numbers, || unit_interval(&mut d))),
        filled("[0, 1): Xoshiro16", move |numbers| uniforms(&mut e, numbers)),
        ("peaks-4d one by one, Pcg64, Comoments<f64>", accumulated(false, pcg())),
        ("peaks-4d in blocks, Pcg64, Comoments<f64>", accumulated(true, pcg())),
        ("peaks-4d in blocks, Xoshiro16, Comoments<f64>", accumulated(true, lanes())),
        ("peaks-4d in blocks, Xoshiro16, f64, five sums", summed::<f64>(lanes())),
        ("peaks-4d in blocks, Xoshiro16, f32, five sums", summed::<f32>(lanes())),
        ("peaks-4d in blocks, Xoshiro16, Comoments<f32>", coarse(lanes())),
    ]
}

/// Room for numbers, filled by `fill`.
fn filled<T: Default + Copy + 'static>(name: &'static str, mut fill: impl FnMut(&mut [T]) + 'static) -> Row {
    let mut numbers = [T::default(); N];
    (name, Box::new(move || fill(black_box(&mut numbers))))
}

/// The report's own way, in blocks or one by one.
fn accumulated(blocks: bool, mut rng: impl Rng + 'static) -> Box<dyn FnMut()> {
    let mut moments = Comoments::default();
    Box::new(move || {
        if blocks {
            Peaks.source().accumulate(&mut moments, N as u64, &mut rng);
        } else {
            Peaks.one_by_one().accumulate(&mut moments, N as u64, &mut rng);
        }
        black_box(moments.count());
    })
}

fn summed<T: Elementary>(mut rng: Xoshiro16) -> Box<dyn FnMut()> {
    let (block, mut sums) = (Peaks.block::<T>(), Sums::default());
    Box::new(move || {
        for _ in 0..N / BLOCK {
            add(&mut sums, &draws(&block, &mut rng));
        }
        black_box(&sums);
    })
}

fn coarse(mut rng: Xoshiro16) -> Box<dyn FnMut()> {
    let (block, mut moments) = (Peaks.block::<f32>(), Comoments::default());
    Box::new(move || {
        for _ in 0..N / BLOCK {
            accumulate(&mut moments, &draws(&block, &mut rng));
        }
        black_box(moments.count());
    })
}

fn main() {
    checks();
    let seconds: f64 = std::env::args().nth(1).map_or(10.0, |argument| argument.parse().expect("SECONDS is a number"));
    let mut rows = rows();
    let mut best = vec![f64::INFINITY; rows.len()];
    let start = Instant::now();
    while start.elapsed().as_secs_f64() < seconds {
        for ((_, run), best) in rows.iter_mut().zip(&mut best) {
            // The first window warms the caches.
            for _ in 0..3 {
                let start = Instant::now();
                run();
                *best = best.min(start.elapsed().as_secs_f64() * 1e9 / N as f64);
            }
        }
        std::thread::sleep(Duration::from_micros(200));
    }
    let cycle = best[0] / 4.0;
    println!("{:.2} GHz; of each number or draw:", 1.0 / cycle);
    for ((name, _), best) in rows.iter().zip(best) {
        println!("{name:46} {best:7.2} ns {:7.1} cycles {:8.1} M/s", best / cycle, 1e3 / best);
    }
}
