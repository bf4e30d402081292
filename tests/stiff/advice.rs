//! Flags that leave the value alone: what they must say, and when they must be silent.

use crate::cases::{moments, ratio};
use ratiocv_core::moments::{Accumulate, Blocked, ComomentsBlock, ExtremesBlock, Joined};
use ratiocv_core::{Draw, Error, Estimator, Flags, Integrals, Plain, RatioOfMeans};
use ratiocv_tests::samples::Noise;

/// Co-moments with tails: the diagnostic tier.
type Diagnostic = Blocked<f64, Joined<ComomentsBlock<f64>, (), (), ExtremesBlock<f64>>>;

/// h uniform on [0, 2): H = 1.
fn uniform(seed: u64, count: usize) -> Vec<(f64, f64)> {
    let mut noise = Noise(seed);
    (0..count).map(|_| 2.0 * noise.next_unit()).map(|h| (1.0 + h, h)).collect()
}

#[test]
fn an_auxiliary_that_is_off_is_noticed_and_a_sound_one_is_not_accused() {
    // 3 % off at 100 000 draws is 16 standard errors.
    assert!(ratio(&uniform(1, 100_000), 1.03).flags.contains(Flags::AUX_MISMATCH));
    assert!(ratio(&[(1.0, 0.5), (2.0, 0.5), (3.0, 0.5)], 1.0).flags.contains(Flags::AUX_MISMATCH));
    // A sound auxiliary, at every small N: by chance once in 5e8 samples, were h normal. Here
    // 5 × 2000 samples.
    for count in [2, 3, 5, 16, 100] {
        for seed in 0..2000 {
            let flags = RatioOfMeans.estimate(&moments(uniform(seed, count)), &Integrals::ONE).unwrap().flags(0);
            assert!(!flags.contains(Flags::AUX_MISMATCH), "{count} draws, seed {seed}: {flags}");
        }
    }
    // Six standard errors allowed three draws would be too few: |t| > 6 has p = 0.027 with 2 degrees
    // of freedom.
    let six = ratio(&[(1.0, 0.9), (1.0, 1.0), (1.0, 1.1)], 1.0 + 7.0 * (0.01_f64 / 3.0).sqrt());
    assert!(!six.flags.contains(Flags::AUX_MISMATCH));
}

#[test]
fn a_denominator_made_of_few_draws_is_noticed() {
    // One draw in a thousand carries nearly all of Σh: ESS = (Σh)²/Σh² ≈ 1.
    let draws: Vec<_> = (0..1000).map(|i| if i == 500 { 1e6 } else { 1.0 }).map(|h| (h, h)).collect();
    assert!(ratio(&draws, 1001.0).flags.contains(Flags::LOW_ESS));
    assert!(!ratio(&uniform(2, 1000), 1.0).flags.contains(Flags::LOW_ESS));
}

#[test]
fn heavy_tails_are_noticed_by_the_diagnostic_tier() {
    // Pareto f with α = 1.5: mean 3, no variance.
    let n = 1_000_000;
    let mut heavy = Diagnostic::default();
    let mut light = Diagnostic::default();
    for i in 0..n {
        let u = (f64::from(i) + 0.5) / f64::from(n);
        heavy.add(Draw::new(u.powf(-1.0 / 1.5), 1.0));
        light.add(Draw::new(u, 1.0));
    }
    let flags = |moments: &Diagnostic| Plain.estimate(moments, &Integrals::ONE).unwrap().flags(0);
    assert_eq!(flags(&heavy), Flags::HEAVY_TAIL);
    assert_eq!(flags(&light), Flags::NONE);
    // A firefly.
    let mut firefly = Diagnostic::default();
    firefly.add_batch(&vec![Draw::new(1.0, 1.0); 1023]);
    firefly.add(Draw::new(1e12, 1.0));
    assert_eq!(flags(&firefly), Flags::HEAVY_TAIL);
    let plain = Plain.estimate(&firefly, &Integrals::ONE).unwrap();
    assert!((plain.value / ((1e12 + 1023.0) / 1024.0) - 1.0).abs() <= 1e-15, "the value is left alone");
    assert!(matches!(plain.strict(), Err(Error::Flagged { channel: 0, .. })));
}
