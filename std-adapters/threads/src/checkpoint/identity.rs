//! Which run a checkpoint is of.

use crate::chunks::stream;
use crate::integrate::CHUNK;
use ratiocv_core::moments::Save;
use ratiocv_core::{Auxiliaries, Draw, Integrals, Integrand, Lanes, Problem, Proposal, Reads};

/// Draws that are looked at to tell problems from each other.
const FIRST_DRAWS: u64 = 8;

/// The settings that decide the bits of a run, by name. Runs whose settings are the same go on from
/// each other's checkpoints.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Identity {
    /// The total of draws.
    pub(crate) draws: u64,
    pub(crate) settings: Vec<(String, String)>,
}

impl Identity {
    /// The identity of a run that makes `draws` draws of `problem` for `estimator`.
    pub(crate) fn new<F, A, P, X, E, const K: usize>(
        problem: &Problem<F, A, P, X>,
        estimator: &E,
        draws: u64,
        seed: u64,
        fingerprint: &str,
    ) -> Self
    where
        F: Integrand<X>,
        A: Auxiliaries<X, F::Value, K>,
        P: Proposal<Point = X>,
        E: Reads<K>,
    {
        let integrals = problem.integrals();
        let mut settings = Vec::new();
        let mut setting = |name: &str, value: String| settings.push((name.to_owned(), value));
        // Another version may round differently.
        setting("the version of ratiocv", env!("CARGO_PKG_VERSION").to_owned());
        setting("the seed", seed.to_string());
        setting("the number of draws", draws.to_string());
        setting("the number of draws per chunk", CHUNK.to_string());
        setting("the estimator", E::ID.to_owned());
        setting("the number of channels", F::Value::LANES.to_string());
        setting("bytes per number", size_of::<<F::Value as Lanes>::Scalar>().to_string());
        setting("the number of auxiliaries", K.to_string());
        for (k, channels) in integrals.0.iter().enumerate() {
            for channel in 0..F::Value::LANES {
                let name = format!("the known integral of auxiliary {k}, channel {channel},");
                setting(&name, format!("{:?}", channels.get(channel)));
            }
        }
        let (words, parameters) = layout(estimator, &integrals);
        setting("the number of words of the moments", words.to_string());
        setting("the list of parameters of the moments", parameters);
        setting("the fingerprint", format!("{fingerprint:?}"));
        setting("the checksum of the first draws", first_draws(problem, draws, seed));
        Self { draws, settings }
    }
}

/// How many words the moments have, and those that are not 0 before any draw, with their places.
fn layout<E: Reads<K>, V: Lanes, const K: usize>(estimator: &E, integrals: &Integrals<V, K>) -> (usize, String) {
    let (mut words, mut parameters) = (0, Vec::new());
    estimator.error_bar(integrals).words(&mut |word| {
        if *word != 0 {
            parameters.push(format!("{words}: {:?}", f64::from_bits(*word)));
        }
        words += 1;
    });
    (words, format!("[{}]", parameters.join(", ")))
}

/// A checksum of a few draws: functions cannot be compared, their values can.
fn first_draws<F, A, P, X, const K: usize>(problem: &Problem<F, A, P, X>, draws: u64, seed: u64) -> String
where
    F: Integrand<X>,
    A: Auxiliaries<X, F::Value, K>,
    P: Proposal<Point = X>,
{
    let (mut rng, mut checksum) = (stream(seed, 0), crc32fast::Hasher::new());
    for _ in 0..draws.min(FIRST_DRAWS) {
        let Draw { f, h } = problem.draw(&mut rng).widen();
        for lanes in [f].iter().chain(&h) {
            (0..F::Value::LANES).for_each(|i| checksum.update(&lanes.get(i).to_le_bytes()));
        }
    }
    format!("{:08x}", checksum.finalize())
}
