//! Lemmas 1 to 6 of the supplement, on the golden functions and on random ones.

use crate::outcomes::{Table, magnitudes, mixture, partial, stratum, sums, total, values, vector};
use ratiocv_core::Spectrum;
use ratiocv_core::sampling::{Discrete, Strata, allocate};
use ratiocv_tests::assert_close;
use ratiocv_tests::samples::Noise;

/// The golden function without negative values, and the one with.
const NON_NEGATIVE: Table<2, 4> = [[1.0, 2.0, 3.0, 0.0], [4.0, 1.0, 0.0, 2.0]];
const SIGNED: Table<3, 3> = [[1.0, -2.0, 3.0], [-1.0, 2.0, 1.0], [2.0, 2.0, -1.0]];

/// Values from −1 to 2, a fifth of them 0; never a channel or a point of zeros.
fn random<const M: usize, const B: usize>(noise: &mut Noise) -> Table<M, B> {
    let mut f: Table<M, B> = core::array::from_fn(|_| core::array::from_fn(|_| 3.0 * noise.next_unit() - 1.0));
    for (j, row) in f.iter_mut().enumerate() {
        for (point, value) in row.iter_mut().enumerate() {
            if noise.next_unit() < 0.2 && point % M != j {
                *value = 0.0;
            }
        }
    }
    f
}

/// Another density near `g` for small `step`, anywhere for 1.
fn perturbed<const B: usize>(g: [f64; B], step: f64, noise: &mut Noise) -> [f64; B] {
    g.map(|g| if g == 0.0 { 0.0 } else { (1.0 - step) * g + step * noise.next_unit() })
}

/// Steps of perturbations, from hardly any to another density.
fn steps() -> impl Iterator<Item = f64> {
    (0..300).map(|i| [1e-3, 1e-2, 0.1, 0.3, 1.0][i % 5])
}

fn chosen<const B: usize>(weights: [f64; B]) -> Discrete<B> {
    Discrete::new(&weights).expect("weights")
}

fn shares<const B: usize>(weights: [f64; B]) -> [f64; B] {
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

fn norms<const M: usize, const B: usize>(f: &Table<M, B>) -> [f64; B] {
    core::array::from_fn(|point| f.iter().map(|row| row[point] * row[point]).sum::<f64>().sqrt())
}

fn best_vector<const M: usize, const B: usize>(f: &Table<M, B>) -> f64 {
    total(&vector(f, &Discrete::by_norm(&values(f)).expect("norms")))
}

fn best_mixture<const M: usize, const B: usize>(f: &Table<M, B>) -> f64 {
    let sizes = magnitudes(f);
    total(&mixture(f, &chosen(sums(&sizes)), &sizes.map(chosen)))
}

/// Σ_j F_j².
fn squares<const M: usize, const B: usize>(f: &Table<M, B>) -> f64 {
    sums(f).iter().map(|sum| sum * sum).sum()
}

fn lemma_1<const M: usize, const B: usize>(f: &Table<M, B>, noise: &mut Noise) {
    let (best, norms) = (best_vector(f), norms(f));
    let right = norms.iter().sum::<f64>().powi(2) - squares(f);
    assert_close(best, right, 1e-12 * (right + squares(f)), "variance of the L2 norm's density");
    for step in steps() {
        let other = total(&vector(f, &chosen(perturbed(shares(norms), step, noise))));
        assert!(other >= best * (1.0 - 1e-12), "{other} < {best}");
    }
}

#[test]
fn lemma_1_no_density_is_better_than_the_l2_norms() {
    let mut noise = Noise(1);
    lemma_1(&NON_NEGATIVE, &mut noise);
    lemma_1(&SIGNED, &mut noise);
    for _ in 0..20 {
        lemma_1(&random::<3, 5>(&mut noise), &mut noise);
    }
    // Not the L1 norm's.
    let l1 = core::array::from_fn(|point| SIGNED.iter().map(|row| row[point].abs()).sum());
    assert!(total(&vector(&SIGNED, &chosen(l1))) >= best_vector(&SIGNED) + 0.1);
}

/// Three coloured lights, of which one is chosen: by luminance, or by the L2 norm of its colour.
#[test]
fn lights_chosen_by_norm_have_less_variance_than_by_luminance() {
    // By channel, then by light.
    let lights: Table<3, 3> = [[3000.0, 3.0, 4.8], [5.0, 3000.0, 5.8], [6.0, 4.0, 3000.0]];
    let luminance = [0.212671, 0.715160, 0.072169];
    let by_luminance = core::array::from_fn(|light| (0..3).map(|j| luminance[j] * lights[j][light]).sum());
    let gain = total(&vector(&lights, &chosen(by_luminance))) / best_vector(&lights);
    println!("by luminance: {gain} times the total variance");
    assert!((2.6..=2.9).contains(&gain), "{gain}");
}

#[test]
fn lemma_2_zero_variance_needs_multiples_of_the_norm_of_constant_sign() {
    let shape = [1.0, 0.0, 3.0, 0.5];
    let multiples: Table<3, 4> = [shape, shape.map(|x| -2.0 * x), shape.map(|x| 0.25 * x)];
    assert!(best_vector(&multiples) <= 1e-29 * squares(&multiples));
    // One value turned over: what is left is what the sum of that channel lost, 1.125² − 0.625².
    let mut turned = multiples;
    turned[2][0] = -0.25;
    assert_close(best_vector(&turned), 0.875, 1e-12, "one value turned over");
    // One of another size: that all channels have constant sign does not help.
    let mut other = multiples;
    other[2][0] = 0.5;
    assert!(best_vector(&other) >= 0.01, "{}", best_vector(&other));
    assert!(best_vector(&NON_NEGATIVE) >= 40.0);
}

/// Estimator 2 at its best with `draws[k]` draws for channel k alone.
fn channel_strata<const M: usize, const B: usize>(f: &Table<M, B>, draws: [u64; M]) -> f64 {
    let strata = Strata::<Spectrum<f64, M>, M>::new(|j| j).expect("a stratum for each channel");
    let sizes = magnitudes(f);
    (0..M).map(|k| total(&stratum(f, &strata, k, &chosen(sizes[k]))) / draws[k] as f64).sum()
}

#[test]
fn lemma_3_neither_strata_nor_vectors_dominate() {
    // Without negative values strata have no variance at all.
    assert!(channel_strata(&NON_NEGATIVE, [4, 4]) <= 1e-28);
    assert_close(best_vector(&NON_NEGATIVE) / 8.0, 5.503_853_118_220_035, 1e-12, "vectors, non-negative");
    // With signs vectors win, even over the best allocation: σ = √32, √12, √16.
    assert_close(best_vector(&SIGNED) / 12.0, 5.683_074_178_658_431, 1e-12, "vectors, signed");
    assert_close(channel_strata(&SIGNED, [4, 4, 4]), 15.0, 1e-12, "strata, signed");
    let neyman = Strata::<Spectrum<f64, 3>, 3>::new(|j| j).unwrap().neyman(12, Spectrum([32.0, 12.0, 16.0])).unwrap();
    assert_eq!(neyman, [5, 3, 4]);
    assert_close(channel_strata(&SIGNED, neyman), 6.4 + 4.0 + 4.0, 1e-12, "strata at their best, signed");
}

#[test]
fn lemma_4_no_mixture_is_better_than_the_magnitudes() {
    fn check<const M: usize, const B: usize>(f: &Table<M, B>, noise: &mut Noise) {
        let (best, sizes) = (best_mixture(f), magnitudes(f));
        let right = sums(&sizes).iter().sum::<f64>().powi(2) - squares(f);
        assert_close(best, right, 1e-12 * (right + squares(f)), "variance of the best mixture");
        for step in steps() {
            let choice = chosen(perturbed(shares(sums(&sizes)), step, noise));
            let g = sizes.map(|row| chosen(perturbed(shares(row), step, noise)));
            let other = total(&mixture(f, &choice, &g));
            assert!(other >= best * (1.0 - 1e-12), "{other} < {best}");
        }
    }
    let mut noise = Noise(4);
    check(&NON_NEGATIVE, &mut noise);
    check(&SIGNED, &mut noise);
    for _ in 0..10 {
        check(&random::<3, 4>(&mut noise), &mut noise);
    }
}

#[test]
fn lemma_5_the_best_mixture_is_no_better_than_the_best_vector() {
    let mut noise = Noise(5);
    for _ in 0..300 {
        let f = random::<3, 4>(&mut noise);
        assert!(best_mixture(&f) >= best_vector(&f) * (1.0 - 1e-12));
    }
    // As good where at most one channel is not 0 at each point.
    let apart: Table<2, 4> = [[1.0, 0.0, -3.0, 0.0], [0.0, 2.0, 0.0, 5.0]];
    assert_close(best_mixture(&apart), best_vector(&apart), 1e-12 * best_vector(&apart), "channels apart");
}

#[test]
fn lemma_6_rejection_never_helps() {
    let mut noise = Noise(6);
    for _ in 0..100 {
        let f = random::<3, 4>(&mut noise);
        let g = chosen(core::array::from_fn(|_| 0.1 + noise.next_unit()));
        // Every multiple of ⅛ is exactly a frequency.
        let accept: Table<3, 4> =
            core::array::from_fn(|_| core::array::from_fn(|_| (1.0 + (8.0 * noise.next_unit()).floor()) / 8.0));
        assert!(total(&partial(&f, &g, &accept)) >= total(&vector(&f, &g)) * (1.0 - 1e-12));
        // Rejection costs nothing where there is nothing to see.
        let zeros = core::array::from_fn(|j| f[j].map(|value| if value == 0.0 { 0.25 } else { 1.0 }));
        let (some, all) = (total(&partial(&f, &g, &zeros)), total(&vector(&f, &g)));
        assert_close(some, all, 1e-12 * all, "rejected zeros");
    }
}

#[test]
fn no_allocation_is_better_than_neymans_where_its_quotas_are_whole() {
    let variance = [1.0, 9.0, 4.0, 4.0];
    let of = |draws: &[u64]| draws.iter().zip(variance).map(|(n, variance)| variance / *n as f64).sum::<f64>();
    let strata = Strata::<Spectrum<f64, 4>, 4>::new(|j| j).unwrap();
    let best = strata.neyman(24, Spectrum(variance)).unwrap();
    assert_eq!(best, [3, 9, 6, 6]);
    assert_close(of(&best), 64.0 / 24.0, 1e-14, "(Σσ)²/N");
    let mut tried = 0;
    for a in 1..22 {
        for b in 1..23 - a {
            for c in 1..24 - a - b {
                assert!(of(&[a, b, c, 24 - a - b - c]) >= of(&best) * (1.0 - 1e-14));
                tried += 1;
            }
        }
    }
    assert_eq!(tried, 23 * 22 * 21 / 6);
    assert_eq!(strata.proportional(24), Ok([6; 4]));
    // Largest remainders: 4.5 is rounded up, 2.5 down.
    assert_eq!(allocate(10, &[4.5, 2.5, 3.0]), Ok([5, 2, 3]));
    assert_eq!(allocate(11, &[0.6, 5.9, 4.4, 0.1]), Ok([1, 5, 4, 1]));
}
