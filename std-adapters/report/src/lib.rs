//! Error against run time, for problems whose integrals are known exactly.
//!
//! For each of some ten [problems] and each estimator of the [catalogue], [`run`] makes many independent
//! estimates of 2, 4, 8, … draws, and measures their bias, their mean squared error and the run time of one.
//! It sets these beside what theory predicts, and beside plain Monte Carlo: which error remains in the time
//! that plain takes, and what time it takes to reach plain's error.
//!
//! ```no_run
//! use ratiocv_report::{Options, TableOptions, problems::Problem, run};
//! let options = Options { problems: Problem::from_id("three-lights").into_iter().collect(), ..Options::default() };
//! let report = run(&options, &())?;
//! print!("{}", report.table(TableOptions::default()));
//! report.write("report".as_ref())?; // report.json, report.csv, index.html
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Errors are in units of F, channel by channel, and `all` is the mean over channels: of the bias F̂/F − 1 and
//! of its square. All but the times is the same to the bit for the same seed, budget, weight and choice of
//! problems, on any number of threads.
//!
//! # Files
//! `report.csv` has one row per problem, estimator, number of draws and channel:
//!
//! | column | |
//! |---|---|
//! | `problem`, `estimator` | ids, as in `problems` and `catalogue` |
//! | `draws` | per estimate |
//! | `channel` | a channel's name, or `all` (the only row of scalar problems) |
//! | `replicates` | independent estimates |
//! | `bias`, `bias_std_error` | mean of F̂/F − 1 |
//! | `mse`, `mse_std_error` | mean of (F̂/F − 1)² |
//! | `predicted_bias`, `predicted_mse` | to second order in 1/N; empty where theory says nothing |
//! | `coverage`, `coverage_std_error` | share of the intervals value ± 1.96 std_error that contain F, after 16, 64 and 256 draws |
//! | `without_interval`, `flagged` | shares of the estimates of unknown error, and of those with any flag |
//! | `missed_flagged` | share of the intervals that miss F with any flag |
//! | `seconds_median`, `seconds_lower_quartile`, `seconds_upper_quartile` | of one estimate, sampling included |
//! | `seed`, `version`, `cpu`, `compiler` | where it comes from |
//!
//! `report.json` is an object with
//! - `provenance`: the fields of [`Provenance`];
//! - `problems`: objects with `problem` (the id), `title`, `formula`, `about`, `channels` (`channel`,
//!   `f_integral`, `h_integral`), `reference_draws`, and `estimators`;
//! - each of `estimators`: `estimator` (the id), `error_at_equal_time` and `time_to_equal_error` (`kind` is
//!   `times`, `at_most`, `exact` or `never`; `ratio` and `std_error`, or null), `slope_in_draws`,
//!   `slope_in_time`, `theory_agrees`, `theory_deviation` (in standard errors), and `points`;
//! - each of `points`: `draws`, `replicates`, `seconds` (`median`, `lower_quartile`, `upper_quartile`), `all`
//!   and `channels`, which hold `bias`, `bias_std_error`, `mse`, `mse_std_error`, `predicted` and
//!   `predicted_first_order` (`bias`, `mse`), and `coverage` (`share`, `std_error`, `without_interval`,
//!   `flagged`, `missed_flagged`), null but after 16, 64 and 256 draws. What is not a number is null;
//! - `exhibits`: the numbers of [`exhibits::Exhibits`], or null.
//!
//! `exhibits.csv` has one row per number of the [exhibits]: `exhibit`, `estimator`, `draws` and `replicates` (0 for a
//! limit), `channel`, `quantity`, `value`, `std_error`; the pictures are `shadow-….png`.

pub mod catalogue;
pub mod exhibits;
mod group;
mod measure;
mod output;
pub mod problems;
mod provenance;
pub mod scene;

pub use group::Group;
pub use measure::{
    ChannelPoint, Coverage, Equal, Error, Figures, MethodReport, Options, Point, ProblemReport, Progress, Report,
    Seconds, Theory, Versus, run,
};
pub use output::TableOptions;
pub use provenance::Provenance;
