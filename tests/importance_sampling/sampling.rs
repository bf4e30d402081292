//! What the samplers do beyond their variances: exact densities, error bars on continuous problems,
//! isolation of channels, reproducibility.

use crate::scripted::{PART, first_and_last, played};
use rand_core::SeedableRng;
use rand_pcg::Pcg64;
use ratiocv_core::moments::{Accumulate, Moments, Variance};
use ratiocv_core::sampling::{Accepted, Discrete, Partial, PiecewiseConstant, RandomMixture, Strata, in_channel};
use ratiocv_core::{
    Draw, Error, Estimate, Estimator, Flags, Integrals, Plain, Problem, Proposal, RatioOfMeans, Spectrum, Uniform,
    WithIntegral,
};

type Rgb = Spectrum<f64, 3>;

/// Three channels of integrals 2, ½ and 0.
fn f(channel: usize, x: f64) -> f64 {
    [6.0 * x * x, 1.0 - x, x - 0.5][channel]
}

fn table(channel: usize) -> PiecewiseConstant<32> {
    let middle = |i: usize| (i as f64 + 0.5) / 32.0;
    PiecewiseConstant::new(&core::array::from_fn(|i| f(channel, middle(i)).abs())).expect("a table")
}

/// |z| ≤ 5 in three channels fails once in 600 000 seeds; the seeds are fixed.
#[track_caller]
fn check(estimate: &Estimate<Rgb>) {
    for (channel, right) in [2.0, 0.5, 0.0].into_iter().enumerate() {
        let (off, error) = ((estimate.value[channel] - right).abs(), estimate.std_error[channel]);
        assert!(off <= 5.0 * error && error <= 0.03, "channel {channel}: off by {off:e} ± {error:e}");
    }
}

fn mixture() -> RandomMixture<PiecewiseConstant<32>, 3> {
    RandomMixture::new(Discrete::new(&[2.0, 0.5, 0.25]).expect("weights"), core::array::from_fn(table))
}

#[test]
fn continuous_problems_come_out_right() {
    let mut rng = Pcg64::seed_from_u64(11);
    let values: [Rgb; 32] = core::array::from_fn(|i| Spectrum([0, 1, 2].map(|j| f(j, (i as f64 + 0.5) / 32.0))));
    let vector = Problem::new(|x: &f64| Spectrum([0, 1, 2].map(|j| f(j, *x))))
        .proposal(PiecewiseConstant::by_norm(&values).expect("norms"));
    check(&vector.integrate(&Plain, 10_000, &mut rng).expect("draws"));

    let mixed = Problem::new(|(k, x): &(usize, f64)| in_channel::<Rgb>(*k, f(*k, *x))).proposal(mixture());
    check(&mixed.integrate(&Plain, 40_000, &mut rng).expect("draws"));

    let partial = Problem::new(|(x, accepted): &(f64, Accepted<Rgb>)| accepted.value(|j| f(j, *x)))
        .proposal(Partial::new(Uniform, |x: &f64| Spectrum([0.1 + 0.9 * x, 1.0, 0.5])));
    check(&partial.integrate(&Plain, 20_000, &mut rng).expect("draws"));

    let strata = Strata::<Rgb, 2>::new(|channel| usize::from(channel > 0)).expect("strata");
    let draws = strata.neyman(10_000, Spectrum([1.0, 0.5, 0.5])).expect("variances");
    assert_eq!(draws, [5000, 5000]);
    check(&strata.integrate(|x: &f64, j| f(j, *x), &[table(0), table(1)], &draws, &mut rng).expect("draws"));
}

#[test]
fn every_random_number_chooses_what_the_probabilities_say() {
    let choice = Discrete::new(&[0.3, 0.0, 1e-300, 0.7, 0.0, 1e-5, 0.0]).expect("weights");
    for index in 0..7 {
        let Some(ends) = first_and_last(&choice, index) else {
            assert!([1, 4, 6].contains(&index));
            continue;
        };
        for u in ends {
            assert_eq!(played(&[u], |rng| choice.sample(rng)), index, "{u}");
        }
    }
    assert_eq!(choice.pdf(&2), PART); // 1e-300 is not starved
    assert_eq!([7, 8, usize::MAX].map(|index| choice.pdf(&index)), [0.0; 3]);
}

#[test]
fn points_stay_in_their_bins_and_the_density_is_that_of_the_bin() {
    let density = PiecewiseConstant::<49>::new(&core::array::from_fn(|i| (i % 5) as f64)).expect("weights");
    let bins = Discrete::<49>::new(&core::array::from_fn(|i| (i % 5) as f64)).expect("weights");
    let mut carried = 0;
    for bin in 0..49 {
        let Some([first, last]) = first_and_last(&bins, bin) else { continue };
        for (u, v) in [(first, 0.0), (last, 0.5), (first, 1.0 - PART)] {
            let x = played(&[u, v], |rng| density.sample(rng));
            assert_eq!(density.pdf(&x), 49.0 * bins.pdf(&bin), "bin {bin} at {v}");
            assert!((0.0..1.0).contains(&x));
            carried += u32::from((bin as f64 + v) / 49.0 == (bin as f64 + 1.0) / 49.0);
        }
    }
    assert!(carried >= 10, "{carried}"); // plain rounding would have carried these into the next bin
}

#[test]
fn a_bad_probability_of_acceptance_spoils_its_own_channel_alone() {
    let draw = |bad: f64| {
        let accepted = Accepted::<Rgb>::roll(Spectrum([0.5, bad, 1.0]), &mut Pcg64::seed_from_u64(3));
        accepted.value(|channel| [1.0, 2.0, 3.0][channel])
    };
    let good = draw(0.25);
    for bad in [f64::NAN, -0.1, 1.0 + f64::EPSILON, f64::INFINITY, f64::NEG_INFINITY] {
        let spoilt = draw(bad);
        assert!(spoilt[1].is_nan(), "{bad}");
        assert_eq!([spoilt[0], spoilt[2]].map(f64::to_bits), [good[0], good[2]].map(f64::to_bits));
        let mut moments = Variance::<Rgb, 0>::default();
        moments.add(Draw { f: spoilt, h: [] });
        let estimate = Plain.estimate(&moments, &Integrals::NONE).expect("a draw");
        assert!(estimate.flags(1).contains(Flags::NONFINITE));
        assert!(!estimate.flags(0).contains(Flags::NONFINITE) && !estimate.flags(2).contains(Flags::NONFINITE));
    }
}

#[test]
fn acceptance_is_as_frequent_as_it_is_divided_by() {
    let value = |a: f64, u: f64| played(&[u], |rng| Accepted::<f64>::roll(a, rng)).value(|_| 1.0);
    // Far below 2⁻⁵³ it happens for one number in 2⁵³, and weighs as much.
    assert_eq!([value(1e-30, 0.0), value(1e-30, PART)], [1.0 / PART, 0.0]);
    // Between two multiples the larger one counts.
    assert_eq!([value(1.25 * PART, PART), value(1.25 * PART, 2.0 * PART)], [0.5 / PART, 0.0]);
    assert_eq!([value(0.75, 0.75 - PART), value(0.75, 0.75)], [4.0 / 3.0, 0.0]);
    assert_eq!([value(0.0, 0.0), value(1.0, 1.0 - PART)], [0.0, 1.0]);
}

#[test]
fn rejected_channels_are_not_evaluated_and_count_as_draws() {
    let accepted = Accepted::<Rgb>::roll(Spectrum([0.0, 1.0, 0.0]), &mut Pcg64::seed_from_u64(1));
    let mut calls = Vec::new();
    accepted.value(|channel| {
        calls.push(channel);
        1.0
    });
    assert_eq!(calls, [1]);

    let strata = Strata::<Rgb, 2>::new(|channel| channel % 2).expect("strata");
    calls.clear();
    strata.value(0, |channel| {
        calls.push(channel);
        1.0
    });
    assert_eq!(calls, [0, 2]);

    // A constant 1, accepted once in four: the mean over accepted draws alone would be 4.
    let problem = Problem::new(|(_, accepted): &(f64, Accepted<f64>)| accepted.value(|_| 1.0))
        .proposal(Partial::new(Uniform, |_: &f64| 0.25));
    let mut moments = Variance::<f64, 0>::default();
    problem.accumulate(&mut moments, 10_000, &mut Pcg64::seed_from_u64(2));
    assert_eq!(moments.count(), 10_000);
    let estimate = Plain.estimate(&moments, &Integrals::NONE).expect("draws");
    // σ = √3; |z| ≤ 5 fails once in 1.7 million seeds; this one is fixed.
    assert!((estimate.value - 1.0).abs() <= 5.0 * 0.03_f64.sqrt() * 0.1);
}

#[test]
fn strata_are_read_by_their_own_channels() {
    let strata = Strata::<Rgb, 3>::new(|channel| [2, 0, 2][channel]).expect("strata");
    assert_eq!(strata.channels(2).collect::<Vec<_>>(), [0, 2]);
    assert_eq!(strata.channels(1).count(), 0);
    let part = |base: f64| {
        let mut part = Variance::<Rgb, 0>::default();
        part.add(Draw { f: Spectrum([base, base + 1.0, base + 2.0]), h: [] });
        part.add(Draw { f: Spectrum([base, base + 2.0, base + 4.0]), h: [] });
        part
    };
    // Nobody reads stratum 1, so that it may be empty.
    let parts = [part(10.0), Variance::default(), part(30.0)];
    let estimate = strata.estimate(&Plain, &parts, &Integrals::NONE).expect("draws");
    assert_eq!(estimate.value, Spectrum([30.0, 11.5, 33.0]));
    assert_eq!(estimate.std_error, Spectrum([0.0, 0.5, 1.0]));
    assert_eq!([0, 1, 2].map(|channel| estimate.flags(channel)), [Flags::NONE; 3]);
    let none = strata.estimate(&Plain, &[Variance::<Rgb, 0>::default(); 3], &Integrals::NONE).unwrap_err();
    assert_eq!(none, Error::TooFewDraws { estimator: "mc", needed: 1, got: 0 });
    let outside = Strata::<Rgb, 3>::new(|channel| channel + 1).unwrap_err();
    assert_eq!(outside, Error::NoSuchStratum { channel: 2, stratum: 3, strata: 3 });
    assert!(outside.to_string().starts_with("channel 2 is in stratum 3 of 3: "));
    let few = strata.proportional(2).unwrap_err();
    assert_eq!(few.to_string(), "2 draws for 3 strata: give every stratum at least one, or join strata");
    let negative = strata.neyman(9, Spectrum([1.0, 2.0, -3.0])).unwrap_err();
    assert_eq!(negative, Error::TableEntry { what: "variance", index: 2, value: -3.0 });
    assert_eq!(strata.neyman(9, Spectrum([0.0; 3])), Err(Error::TableOfZeros { what: "variance" }));
    // √(9 + 16) : √25 : nothing, of 9.
    assert_eq!(strata.neyman(9, Spectrum([9e300, 25e300, 16e300])), Ok([4, 1, 4]));
}

#[test]
fn strata_are_integrated_one_after_the_other() {
    let strata = Strata::<Rgb, 2>::new(|channel| usize::from(channel == 1)).expect("strata");
    let (g, draws) = ([table(0), table(1)], [100, 77]);
    let ours = strata.integrate(|x: &f64, j| f(j, *x), &g, &draws, &mut Pcg64::seed_from_u64(8)).expect("draws");
    let mut rng = Pcg64::seed_from_u64(8);
    for (k, g) in g.iter().enumerate() {
        let part = Problem::new(|x: &f64| Spectrum([0, 1, 2].map(|j| f(j, *x))))
            .proposal(g)
            .integrate(&Plain, draws[k], &mut rng)
            .expect("draws");
        for channel in strata.channels(k) {
            assert_eq!(ours.channel(channel), part.channel(channel));
        }
    }
}

#[test]
fn auxiliaries_go_with_any_of_them() {
    // f = 2h: whatever was rejected, the ratio is exact.
    let problem = Problem::new(|(x, accepted): &(f64, Accepted<f64>)| accepted.value(|_| 2.0 * x))
        .auxiliary(WithIntegral::new(|(x, accepted): &(f64, Accepted<f64>)| accepted.value(|_| *x), 0.5))
        .proposal(Partial::new(Uniform, |_: &f64| 0.5));
    let estimate = problem.integrate(&RatioOfMeans, 100, &mut Pcg64::seed_from_u64(5)).expect("draws");
    assert!((estimate.value - 1.0).abs() <= 1e-15);
}

#[test]
fn the_same_seed_gives_the_same_bits_on_any_number_of_threads() {
    let problem = Problem::new(|(k, x): &(usize, f64)| in_channel::<Rgb>(*k, f(*k, *x))).proposal(mixture());
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let estimate = pool.install(|| ratiocv_threads::integrate(&problem, &Plain, 20_000, 9)).expect("draws");
        [0, 1, 2].map(|channel| (estimate.value[channel].to_bits(), estimate.std_error[channel].to_bits()))
    };
    assert_eq!(on(1), on(3));
}
