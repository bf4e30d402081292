//! Long runs: no counter, mean or sum of squares drifts, however many draws there are and however they are merged.
//!
//! Draws are `f32` and whole multiples of 2⁻²⁴, so that their sums and sums of products are known exactly, as
//! integers: what is compared with has no rounding of its own.

use ratiocv_core::Draw;
use ratiocv_core::moments::{Accumulate, Comoments, HasComoments, HasMeans, Merge, Moments, Sums};

/// What rounding of `f32` sums within blocks may leave in means and mean squares: 4·10⁻⁹ is the most that is seen.
const ROUNDING: f64 = 2e-8;

/// Units in 1.
const UNIT: i128 = 1 << 24;

/// Exact sums, in units of 2⁻²⁴ and 2⁻⁴⁸: no run below is near the end of an `i128`.
#[derive(Clone, Copy, Default)]
struct Exact {
    count: i128,
    f: i128,
    h: i128,
    ff: i128,
    fh: i128,
    hh: i128,
}

impl Exact {
    fn add(&mut self, f: i128, h: i128) {
        self.append(Self { count: 1, f, h, ff: f * f, fh: f * h, hh: h * h });
    }

    fn append(&mut self, other: Self) {
        self.count += other.count;
        self.f += other.f;
        self.h += other.h;
        self.ff += other.ff;
        self.fh += other.fh;
        self.hh += other.hh;
    }

    fn times(self, n: i128) -> Self {
        let Self { count, f, h, ff, fh, hh } = self;
        Self { count: n * count, f: n * f, h: n * h, ff: n * ff, fh: n * fh, hh: n * hh }
    }

    /// Means of f and h, and the mean squares and product of deviations from them.
    fn right(&self) -> [f64; 5] {
        let (n, unit) = (self.count, UNIT as f64);
        // n²·variance is an integer; what is whole in the mean of squares leaves no digits behind.
        let product = |ab: i128, a: i128, b: i128| {
            let (whole, rest) = (a / n, a % n);
            ((ab - whole * b) as f64 - rest as f64 * (b as f64 / n as f64)) / n as f64 / unit / unit
        };
        [
            self.f as f64 / n as f64 / unit,
            self.h as f64 / n as f64 / unit,
            product(self.ff, self.f, self.f),
            product(self.fh, self.f, self.h),
            product(self.hh, self.h, self.h),
        ]
    }
}

/// SplitMix64 (Steele, Lea, Flood 2014), for whole numbers.
struct Stream(u64);

impl Stream {
    /// f in [0, 1), h half of f and half of its own: both of 24 bits.
    fn next(&mut self) -> (i128, i128) {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        let (f, own) = (z >> 40, (z >> 8) & 0xff_ffff);
        (i128::from(f), i128::from(f / 2 + own / 2))
    }

    fn fill(&mut self, draws: &mut [Draw<f32>], exact: &mut Exact) {
        for draw in draws {
            let (f, h) = self.next();
            exact.add(f, h);
            *draw = Draw::new(f as f32 / UNIT as f32, h as f32 / UNIT as f32);
        }
    }
}

/// Means of f and h, and the mean squares and product of deviations.
fn ours(moments: &Comoments<f32>) -> [f64; 5] {
    let (n, channel) = (moments.count() as f64, moments.closed().channel(0));
    let (means, spread) = (channel.means(moments.count()), channel.comoments());
    [means.f, means.h[0], spread.ff() / n, spread.fh(0) / n, spread.hh[0][0] / n]
}

/// The largest distance from what is right, of numbers that are all about ½ or below.
#[track_caller]
fn check(moments: &Comoments<f32>, exact: &Exact, allowed: f64) -> f64 {
    assert_eq!(i128::from(moments.count()), exact.count);
    let (ours, right) = (ours(moments), exact.right());
    let worst = ours.iter().zip(&right).map(|(ours, right)| (ours - right).abs()).fold(0.0, f64::max);
    let sound = ours.iter().all(|x| x.is_finite());
    assert!(sound && worst <= allowed, "{} draws: {ours:?} should be {right:?}; {worst:e}", exact.count);
    worst
}

/// A part of 2¹⁶ draws.
fn part(seed: u64) -> (Comoments<f32>, Sums<f32>, Exact) {
    let (mut moments, mut sums, mut exact) = (Comoments::default(), Sums::default(), Exact::default());
    let mut draws = vec![Draw::ZERO; 1 << 16];
    Stream(seed).fill(&mut draws, &mut exact);
    moments.add_batch(&draws);
    sums.add_batch(&draws);
    (moments, sums, exact)
}

/// Parts that are alike have nothing to round but the turn to their joint slope.
#[test]
fn doubling_to_2_to_the_33_draws_changes_no_mean() {
    let (mut all, mut sums, exact) = part(1);
    let (first, first_sums) = (ours(&all), sums.closed().channel(0).means(sums.count()));
    for doublings in 1..=17 {
        let (half, half_sums) = (all, sums);
        all.merge(&half);
        sums.merge(&half_sums);
        assert_eq!((all.count(), sums.count()), (1 << (16 + doublings), 1 << (16 + doublings)));
        assert_eq!(sums.closed().channel(0).means(sums.count()), first_sums);
        let now = ours(&all);
        assert_eq!(now[..2], first[..2]);
        for (now, first) in now.iter().zip(&first) {
            assert!((now - first).abs() <= 4.0 * f64::EPSILON * first, "{now} was {first}");
        }
    }
    assert_eq!(all.count(), 1 << 33);
    check(&all, &exact.times(1 << 17), ROUNDING);
}

/// 2¹⁷ parts of 2¹⁶ draws one after another: the last is merged into 130 000 times as many. What is off is what the
/// worst part was off, by the rounding of `f32` sums: nothing is added.
#[test]
fn merging_part_after_part_to_2_to_the_33_draws_does_not_drift() {
    let parts: Vec<_> = (0..16).map(|seed| part(100 + seed)).collect();
    let (mut all, mut sums, mut exact) = (Comoments::<f32>::default(), Sums::<f32>::default(), Exact::default());
    let of_parts = parts.iter().map(|(moments, _, exact)| check(moments, exact, ROUNDING)).fold(0.0, f64::max);
    for i in 0..1_usize << 17 {
        // No two rounds in the same order.
        let (moments, of_sums, of_part) = &parts[(i + i / 16 * 5) % 16];
        all.merge(moments);
        sums.merge(of_sums);
        exact.append(*of_part);
        if i.is_power_of_two() {
            check(&all, &exact, of_parts);
        }
    }
    assert_eq!((all.count(), sums.count()), (1 << 33, 1 << 33));
    let off = check(&all, &exact, of_parts);
    let means = sums.closed().channel(0).means(sums.count());
    let right = exact.right();
    let sound = (means.f - right[0]).abs() <= of_parts && (means.h[0] - right[1]).abs() <= of_parts;
    assert!(sound, "{means:?} {right:?}");
    println!("{off:.1e} off, the worst part {of_parts:.1e}");
}

/// Single draws merged into 2³³ of them and before them: none is lost, each has its weight.
#[test]
fn single_draws_beside_2_to_the_33() {
    let (mut many, _, of_part) = part(7);
    for _ in 0..17 {
        let half = many;
        many.merge(&half);
    }
    for before in [false, true] {
        let (mut all, mut exact) = (many, of_part.times(1 << 17));
        for i in 0..10_000 {
            let (f, h) = (UNIT * (1 << 20) + i * UNIT, UNIT * (1 << 19));
            exact.add(f, h);
            let mut one = Comoments::<f32>::default();
            one.add(Draw::new((f / UNIT) as f32, (h / UNIT) as f32));
            if before {
                one.merge(&all);
                all = one;
            } else {
                all.merge(&one);
            }
        }
        let (ours, right) = (ours(&all), exact.right());
        assert_eq!(i128::from(all.count()), exact.count);
        for (ours, right) in ours.iter().zip(&right) {
            assert!((ours - right).abs() <= 1e-9 * right.abs(), "{ours} should be {right}");
        }
    }
}

/// `batches` batches of 4096 `f32` draws into one accumulator; how far off it was at the most.
fn soak(batches: u64) -> f64 {
    let (mut moments, mut exact, mut stream) = (Comoments::<f32>::default(), Exact::default(), Stream(5));
    let mut draws = [Draw::ZERO; 4096];
    let mut worst = 0.0_f64;
    for batch in 1..=batches {
        stream.fill(&mut draws, &mut exact);
        moments.add_batch(&draws);
        if batch.is_power_of_two() {
            let off = check(&moments, &exact, ROUNDING);
            println!("{:11} draws: {off:.1e} off", moments.count());
            worst = worst.max(off);
        }
    }
    worst.max(check(&moments, &exact, ROUNDING))
}

#[test]
fn sixteen_million_draws() {
    soak(1 << 12);
}

/// `cargo test --release -p ratiocv-tests --test long_runs -- --ignored --nocapture`
#[test]
#[ignore = "10⁹ draws"]
fn a_thousand_million_draws() {
    println!("at most {:.1e} off", soak(1_000_000_000_u64.div_ceil(4096)));
}
