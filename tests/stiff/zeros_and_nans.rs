//! F: bad draws, zero signs, lanes.

use crate::cases::{ratio, run};
use ratiocv_core::moments::{Accumulate, Comoments, Moments, RatioVariance};
use ratiocv_core::{
    Draw, Estimator, Flags, HartleyRoss, Integrals, Lanes, MeanOfRatios, Problem, Proposal, RatioOfMeans, Reads,
    Spectrum, WithIntegral,
};
use ratiocv_tests::samples::Noise;

#[test]
fn f1_one_nan_in_a_million_is_known_in_its_channel_alone() {
    type Four = Spectrum<f32, 4>;
    let estimate = |bad: bool| {
        let mut noise = Noise(1);
        let mut moments = Comoments::<Four>::default();
        for i in 0..1_000_000 {
            let mut draw = noise.draws::<Four>(1)[0];
            if bad && i == 123_456 {
                draw.f[3] = f32::NAN;
            }
            moments.add(draw);
        }
        RatioOfMeans.estimate(&moments, &Integrals::ONE).unwrap()
    };
    let (dirty, clean) = (estimate(true), estimate(false));
    assert!(dirty.flags(3).contains(Flags::NONFINITE) && dirty.value[3].is_nan());
    for channel in 0..3 {
        assert_eq!(dirty.channel(channel), clean.channel(channel));
    }
}

#[test]
fn f2_f3_nothing_non_finite_becomes_a_number_silently() {
    let mut draws = vec![(1.0, 1.0); 10];
    draws[9].0 = f64::NAN;
    let poisoned = ratio(&draws, 1.0);
    assert!(poisoned.value.is_nan() && poisoned.flags.contains(Flags::NONFINITE));
    let inf = f64::INFINITY;
    for (f, h) in [(inf, 1.0), (1.0, inf), (inf, inf)] {
        for case in [
            ratio(&[(f, h), (1.0, 1.0)], 1.0),
            run(HartleyRoss, &[(f, h), (1.0, 1.0)], 1.0),
            run(MeanOfRatios, &[(f, h), (1.0, 1.0)], 1.0),
        ] {
            assert!(case.flags.contains(Flags::NONFINITE), "f={f} h={h}: {case:?}");
            assert!(if f == 1.0 { case.value == 1.0 } else { case.value.is_nan() }, "f={f} h={h}: {case:?}");
        }
    }
}

/// A proposal that returns one point with one pdf.
struct At(f64);

impl Proposal for At {
    type Point = f64;
    fn sample<R: rand_core::Rng + ?Sized>(&self, _: &mut R) -> f64 {
        0.5
    }
    fn pdf(&self, _: &f64) -> f64 {
        self.0
    }
}

/// A generator that nobody may call.
struct Void;

impl rand_core::TryRng for Void {
    type Error = core::convert::Infallible;
    fn try_next_u32(&mut self) -> Result<u32, Self::Error> {
        panic!("no random number is needed here")
    }
    fn try_next_u64(&mut self) -> Result<u64, Self::Error> {
        panic!("no random number is needed here")
    }
    fn try_fill_bytes(&mut self, _: &mut [u8]) -> Result<(), Self::Error> {
        panic!("no random number is needed here")
    }
}

#[test]
fn f4_f5_pdfs_of_zero_and_of_almost_zero() {
    let draw = |f: f32, h: f32, pdf: f64| {
        Problem::new(move |_: &f64| f)
            .auxiliary(WithIntegral::new(move |_: &f64| h, 1.0))
            .proposal(At(pdf))
            .draw(&mut Void)
    };
    assert_eq!(draw(0.0, 0.0, 0.0), Draw::new(0.0, 0.0));
    let unsound = draw(1.0, 0.0, 0.0);
    assert!(unsound.f.is_infinite() && unsound.h == [0.0]);
    let least = f32::from_bits(1);
    assert_eq!(draw(least, 2.0 * least, f64::from(least)), Draw::new(1.0, 2.0));
}

#[test]
fn f6_what_is_not_selected_leaves_no_trace() {
    // Channel 0: f = h = 0, whose f/h is 0/0; channel 1 is innocent.
    let mut moments = RatioVariance::<Spectrum<f64, 2>>::default();
    moments.add_batch(&[Draw::new(Spectrum([0.0, 1.0]), Spectrum([0.0, 2.0])); 100]);
    let ratio = |channel| ratiocv_core::moments::HasRatioMean::ratio(&moments.channel(channel), 0.0, 1.0).unwrap();
    assert_eq!([ratio(0).mean, ratio(1).mean], [0.0, 0.5]);
}

#[test]
fn f7_zeros_come_out_positive() {
    for count in [1, 2, 3, 64, 200] {
        let zero = ratio(&vec![(-0.0, 1.0); count], 1.0);
        assert_eq!(zero.value.to_bits(), 0);
    }
    // A mean that is −0 beside draws that are not.
    let cancelled = ratio(&[(-1.0, 1.0), (1.0, 1.0)], -1.0);
    assert_eq!(cancelled.value.to_bits(), 0);
}

/// Draw by draw, every channel of any number of channels is, to the bit, a scalar run.
#[test]
fn f9_any_number_of_channels_is_the_scalar_path() {
    fn check<const M: usize>(counts: &[usize]) {
        let mut noise = Noise(M as u64);
        for count in counts {
            let draws = noise.draws::<Spectrum<f32, M>>(*count);
            let estimator = HartleyRoss.defensive(0.01).unwrap();
            let integrals = Integrals::<Spectrum<f32, M>>::ONE;
            let mut moments = estimator.error_bar(&integrals);
            draws.iter().for_each(|draw| moments.add(*draw));
            let together = estimator.estimate_anyway(&moments, &integrals);
            for channel in (0..M).step_by(M.div_ceil(8)) {
                let mut alone = estimator.error_bar::<f32>(&Integrals::ONE);
                draws.iter().for_each(|d| alone.add(Draw::new(d.f.get(channel), d.h[0].get(channel))));
                let alone = estimator.estimate_anyway(&alone, &Integrals::ONE).channel(0);
                let ours = together.channel(channel);
                assert_eq!(ours.value.to_bits(), alone.value.to_bits(), "{M} channels, {count} draws");
                assert_eq!(ours.std_error.to_bits(), alone.std_error.to_bits(), "{M} channels, {count} draws");
                assert_eq!(ours.flags, alone.flags);
            }
        }
    }
    let counts: Vec<usize> = (0..=140).collect();
    check::<1>(&counts);
    check::<3>(&counts);
    check::<7>(&counts);
    check::<8>(&counts);
    check::<9>(&counts);
    check::<15>(&counts);
    check::<16>(&counts);
    check::<17>(&counts);
    check::<31>(&counts);
    check::<1000>(&[1, 64, 100]);
    // No channel at all is no error.
    let mut none = Comoments::<Spectrum<f32, 0>>::default();
    none.add(Draw::ZERO);
    assert!(RatioOfMeans.estimate(&none, &Integrals::ONE).is_ok());
}

/// In batches too, nested lanes give the bits of flat ones: the order of summation depends on the
/// number of channels alone.
#[test]
fn f9_batches_do_not_depend_on_how_lanes_are_packed() {
    let draws = Noise(9).draws::<Spectrum<f32, 24>>(1000);
    let mut flat = Comoments::default();
    flat.add_batch(&draws);
    type Nested = Spectrum<Spectrum<f32, 8>, 3>;
    let nest = |x: Spectrum<f32, 24>| Nested::from_fn(|i| x.get(i));
    let mut nested = Comoments::default();
    nested.add_batch(&draws.iter().map(|d| Draw::new(nest(d.f), nest(d.h[0]))).collect::<Vec<_>>());
    let flat = RatioOfMeans.estimate(&flat, &Integrals::ONE).unwrap();
    let nested = RatioOfMeans.estimate(&nested, &Integrals::ONE).unwrap();
    for channel in 0..24 {
        assert_eq!(flat.channel(channel), nested.channel(channel));
    }
}
