//! The same bits for any number of threads.

use ratiocv_core::moments::{Comoments, Merge, Moments};
use ratiocv_core::{Defensive, Estimate, HartleyRoss, Lanes, Mickey, Problem, Reads, Spectrum, Uniform, WithIntegral};
use ratiocv_tests::samples::filled;
use ratiocv_threads::{Chunk, integrate, map_chunks, merge_tree, stream};

/// The values for seed 7: Mickey's and Hartley–Ross's, two channels each, as bits.
const STABLE: [[u64; 2]; 2] =
    [[0x3fd5_53f5_dd7a_9aea, 0x4003_2ad4_78de_9262], [0x3fd5_5318_68d8_dd80, 0x4003_2ae3_b8a9_a53d]];

fn bits<V: Lanes>(estimate: &Estimate<V>) -> Vec<[u64; 2]> {
    (0..V::LANES).map(|i| estimate.channel(i)).map(|c| [c.value.to_bits(), c.std_error.to_bits()]).collect()
}

#[test]
fn integrals_do_not_depend_on_the_number_of_threads() {
    let problem = Problem::new(|x: &f64| Spectrum([x * x, 1.0 / (0.1 + x)]))
        .auxiliary(WithIntegral::new(|x: &f64| Spectrum([*x, 1.0 - x]), Spectrum([0.5, 0.5])))
        .proposal(Uniform);
    let draws = 100_003; // no multiple of a chunk or of a block
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let mickey: Defensive<Mickey> = Mickey.defensive(0.01).unwrap();
            let biased = integrate(&problem, &mickey, draws, 7).unwrap();
            let unbiased = integrate(&problem, &HartleyRoss.defensive(0.1).unwrap(), draws, 7).unwrap();
            [bits(&biased), bits(&unbiased)]
        })
    };
    let one = with(1);
    for threads in [2, 3, 5, 8] {
        assert_eq!(with(threads), one, "{threads} threads");
    }
    // Value stability: a seed, a code path, an answer. A change here needs a line in CHANGELOG.md.
    let values = one.map(|estimate| [estimate[0][0], estimate[1][0]]);
    assert_eq!(values, STABLE, "{values:#x?}");
}

#[test]
fn chunks_cover_the_work_once_and_in_order() {
    for (total, size) in [(0, 10), (1, 10), (10, 10), (11, 10), (100, 7), (5, 0)] {
        let chunks = map_chunks(total, size, |chunk| chunk);
        let mut next = 0;
        for (index, Chunk { index: number, start, count }) in chunks.iter().enumerate() {
            assert_eq!((*number, *start), (index as u64, next));
            assert!(*count > 0);
            next += count;
        }
        assert_eq!(next, total);
    }
}

#[test]
fn the_tree_keeps_the_order_of_its_parts() {
    #[derive(Clone, Debug, PartialEq)]
    struct Names(String);
    impl Merge for Names {
        fn merge(&mut self, later: &Self) {
            self.0 = format!("({}{})", self.0, later.0);
        }
    }
    let tree = |n: usize| merge_tree((0..n).map(|i| Names(i.to_string())).collect()).map(|names| names.0);
    assert_eq!(tree(0), None);
    assert_eq!(tree(1).as_deref(), Some("0"));
    assert_eq!(tree(5).as_deref(), Some("(((01)(23))4)"));
    let parts = (0..9).map(|i| filled(Comoments::<f64>::default(), [(f64::from(i), 1.0)])).collect();
    assert_eq!(merge_tree(parts).map(|all| all.count()), Some(9));
}

#[test]
fn streams_of_neighbouring_seeds_and_indices_differ() {
    use rand_core::Rng;
    let mut firsts: Vec<u64> = (0..100).flat_map(|seed| (0..100).map(move |i| stream(seed, i).next_u64())).collect();
    firsts.sort_unstable();
    firsts.dedup();
    assert_eq!(firsts.len(), 10_000);
}
