//! Run-time channels at memory bandwidth: `bandwidth [ROUNDS]`. Adds draws of 4096 and of 10^6 channels, in arrays
//! far larger than any cache, with `Slices`, and compares the time with that of a plain read of the same arrays in the
//! same round. The answers are checked against plain `f64` sums first.

use core::hint::black_box;
use ratiocv_core::moments::{Blocked, Comoments, Slices, Sums, Takes};
use ratiocv_core::{Draw, Plain, RatioOfMeans, Spectrum};
use std::time::Instant;

type Piece = Spectrum<f32, 16>;

/// Entries of f, and as many of h: 512 MiB in all, in round numbers.
const ENTRIES: usize = 1 << 26;

fn main() {
    let rounds = std::env::args().nth(1).map_or(15, |rounds| rounds.parse().expect("ROUNDS is a number"));
    println!("| channels | draws | plain read, GB/s | moments | of the read's bandwidth | bar | holds |");
    println!("|---|---|---|---|---|---|---|");
    for channels in [4096, 1_000_000] {
        measure(channels, rounds);
    }
}

/// A number that looks random enough (the finaliser of SplitMix64: Steele, Lea and Flood 2014).
fn number(i: usize) -> f32 {
    let mut x = (i as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (x >> 40) as f32 / (1 << 24) as f32
}

fn measure(channels: usize, rounds: usize) {
    // Full blocks, once the first four draws are in.
    let draws = ENTRIES / channels / 64 * 64;
    let entries = draws.max(64) * channels;
    let h: Vec<f32> = (0..entries).map(|i| 0.5 + number(i)).collect();
    let f: Vec<f32> = h.iter().enumerate().map(|(i, h)| h * (1.0 + 0.5 * number(i + entries))).collect();
    let draws = entries / channels;

    let mut sums = vec![Sums::<Piece>::default(); channels.div_ceil(16)];
    let mut comoments = vec![Comoments::<Piece>::default(); channels.div_ceil(16)];
    add(&mut sums, &f, &h, channels);
    add(&mut comoments, &f, &h, channels);
    check(&sums, &comoments, &f, &h, channels);

    // The first draws of a stream are blocks of one, and are not measured.
    let first = 4 * channels;
    sums.fill(Default::default());
    comoments.fill(Default::default());
    add(&mut sums, &f[..first], &h[..first], channels);
    add(&mut comoments, &f[..first], &h[..first], channels);

    let mut times: [Vec<f64>; 3] = Default::default();
    for _ in 0..rounds {
        times[0].push(seconds(|| black_box(read(black_box(&f)) + read(black_box(&h)))));
        times[1].push(seconds(|| add(&mut sums, &f, &h, channels)));
        times[2].push(seconds(|| add(&mut comoments, &f, &h, channels)));
    }
    let speed = (8 * entries) as f64 / median(times[0].clone()) / 1e9;
    for (which, name, bar) in [(1, "sums", 0.85), (2, "five co-moments", 0.75)] {
        let ratio = median(times[0].iter().zip(&times[which]).map(|(read, ours)| read / ours).collect());
        let holds = if ratio >= bar { "yes" } else { "no" };
        let (percent, bar) = (100.0 * ratio, 100.0 * bar);
        println!("| {channels} | {draws} | {speed:.1} | {name} | {percent:.0} % | {bar:.0} % | {holds} |");
    }
}

fn add<B>(memory: &mut [Blocked<Piece, B>], f: &[f32], h: &[f32], channels: usize)
where
    B: Takes<Draw<Piece>>,
{
    let mut moments = Slices::new(memory, channels).expect("memory for all channels");
    moments.add_batch(f, [h]).expect("whole rows");
}

/// The sum of all, by wide loads.
#[inline(never)]
fn read(entries: &[f32]) -> f32 {
    let mut sums = [0.0_f32; 128];
    for chunk in entries.as_chunks::<128>().0 {
        for (sum, x) in sums.iter_mut().zip(chunk) {
            *sum += x;
        }
    }
    sums.iter().sum()
}

fn seconds<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    black_box(work());
    start.elapsed().as_secs_f64()
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// Means and error bars of every channel against two passes in `f64`.
fn check(sums: &[Sums<Piece>], comoments: &[Comoments<Piece>], f: &[f32], h: &[f32], channels: usize) {
    let n = (f.len() / channels) as f64;
    let rows = || f.chunks_exact(channels).zip(h.chunks_exact(channels));
    let mut means = vec![[0.0_f64; 2]; channels];
    for (f, h) in rows() {
        for ((mean, f), h) in means.iter_mut().zip(f).zip(h) {
            mean[0] += f64::from(*f) / n;
            mean[1] += f64::from(*h) / n;
        }
    }
    let mut squares = vec![0.0_f64; channels];
    for (f, h) in rows() {
        for (((square, [mean_f, mean_h]), f), h) in squares.iter_mut().zip(&means).zip(f).zip(h) {
            let residual = f64::from(*f) - mean_f / mean_h * f64::from(*h);
            *square += residual * residual;
        }
    }
    let near = |what: &str, channel: usize, got: f64, right: f64, tolerance: f64| {
        assert!((got - right).abs() <= tolerance * right.abs(), "{what} of channel {channel}: {got}, not {right}");
    };
    let (mut sums, mut comoments) = (sums.to_vec(), comoments.to_vec());
    let sums = Slices::new(&mut sums, channels).expect("memory for all channels");
    let comoments = Slices::new(&mut comoments, channels).expect("memory for all channels");
    let (plain, ratio) = (|i: usize| means[i][0], |i: usize| means[i][0] / means[i][1]);
    let error = |i: usize| (squares[i] / (n * (n - 1.0))).sqrt();
    sums.estimate(&Plain, |_| [1.0], |i, it| near("plain", i, it.value, plain(i), 1e-6)).expect("draws");
    sums.estimate(&RatioOfMeans, |_| [1.0], |i, it| near("ratio", i, it.value, ratio(i), 1e-6)).expect("draws");
    let one = |i: usize, it: ratiocv_core::ChannelEstimate| {
        near("ratio with error bar", i, it.value, ratio(i), 1e-6);
        near("error bar", i, it.std_error, error(i), 1e-3);
    };
    comoments.estimate(&RatioOfMeans, |_| [1.0], one).expect("draws");
}
