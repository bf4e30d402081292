//! Where, when and with what a report was made.

use crate::measure::Options;
use ratiocv_simd::Level;
use std::time::SystemTime;

/// Where, when and with what a report was made.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Provenance {
    /// The version of this package.
    pub version: &'static str,
    /// The compiler.
    pub compiler: &'static str,
    /// The target triple.
    pub target: &'static str,
    /// How it was optimised.
    pub profile: &'static str,
    /// The best instructions of the machine, which the kernels of drivers and of blocks of draws run on; the rest
    /// has what the build may assume.
    pub level: String,
    /// The CPU's name, or its architecture where the system does not tell.
    pub cpu: String,
    /// Threads that the replicates ran on; run times are those of one thread.
    pub threads: usize,
    /// UTC, RFC 3339.
    pub date: String,
    /// The seed of all draws.
    pub seed: u64,
    /// See [`Options::budget_seconds`].
    pub budget_seconds: f64,
    /// ε of the defensive estimators.
    pub defensive_weight: f64,
    /// Whether it is a first look only.
    pub quick: bool,
    /// How long it took.
    pub wall_seconds: f64,
}

impl Provenance {
    /// Of a run that starts now on `threads` threads.
    pub(crate) fn now(options: &Options, threads: usize) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION"),
            compiler: env!("RATIOCV_COMPILER"),
            target: env!("RATIOCV_TARGET"),
            profile: env!("RATIOCV_PROFILE"),
            level: Level::best().to_string(),
            cpu: cpu(),
            threads,
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
            seed: options.seed,
            budget_seconds: options.budget_seconds,
            defensive_weight: options.defensive_weight,
            quick: options.quick,
            wall_seconds: f64::NAN,
        }
    }
}

impl Provenance {
    /// Of a scene's report that starts now, on all threads of the pool.
    pub(crate) fn of_scene(seed: u64, quick: bool) -> Self {
        let options = Options { seed, quick, ..Options::default() };
        Self { budget_seconds: f64::NAN, ..Self::now(&options, rayon::current_num_threads()) }
    }
}

/// The first processor's name, as Linux gives it.
fn cpu() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    name.map_or_else(|| std::env::consts::ARCH.into(), |(_, name)| name.trim().into())
}
