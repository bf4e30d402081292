//! The command line.

use crate::intake::OnBadDraw;
use crate::integrals::Given;
use crate::output::Format;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use ratiocv_core::{Defensive, Plain};
use ratiocv_report::catalogue::Method;
use ratiocv_report::problems::Problem;
use ratiocv_scene::{Layer, LightChoice, Mixture};
use std::path::PathBuf;

const EXIT_CODES: &str = "\
Exit codes:
  0  done
  1  the data or a file is bad
  2  the command line is wrong";

const EXAMPLES: &str = "\
Examples:
  ratiocv                                     the whole report, in ./report
  ratiocv report --quick --problem three-lights
  ratiocv list
  ratiocv estimate draws.csv                  every estimator on your own draws";

const ESTIMATE_FORMAT: &str = "\
The file is CSV with a header, one row per draw:
  f.CHANNEL    the integrand, divided by the pdf of the draw
  h.CHANNEL    an auxiliary whose integral is known, divided likewise
               (h2.CHANNEL, h3.CHANNEL, ... for further auxiliaries)
  pdf          optional; if present, the other columns are divided by it, and 0/0 is 0
Every channel needs at least one auxiliary, unless --estimator mc alone is asked for.

Each estimate comes with its standard error and with flags; the table explains those raised. The
favoured estimator is the one with the least MSE that theory predicts at this number of draws,
from the moments of these same draws: a guide, not a promise.

Unknown numbers are null in JSON and empty in CSV.";

const ESTIMATE_EXAMPLES: &str = "\
Examples:
  ratiocv estimate draws.csv --integral h.r=1.25 --integral h.g=0.8
  ratiocv estimate draws.csv --estimator hartley_ross --estimator defensive_mickey --format json
  renderer | ratiocv estimate - --on-bad-draw skip";

const RENDER_EXAMPLES: &str = "\
Examples:
  ratiocv render S1 --out s1.png                      a built-in scene (ratiocv list)
  ratiocv render scene.xml --spp 256 --out a.exr --out a.png --layer error
  ratiocv render scene.xml --error 0.02 --save a.ratiocv --out a.exr
  ratiocv render S2 --explain                         what the scene does not need";

/// Which estimator gives the least error for your run time? Ratio control variates, measured.
///
/// Without a command: report.
#[derive(Debug, Parser)]
#[command(name = "ratiocv", version, after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"))]
#[command(args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The options of `report`, for use without a command.
    #[command(flatten)]
    pub report: ReportArguments,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Measure error against run time on problems whose answers are known
    #[command(after_help = EXIT_CODES)]
    Report(ReportArguments),
    /// Render a scene
    #[command(after_help = format!("{RENDER_EXAMPLES}\n\n{EXIT_CODES}"))]
    Render(RenderArguments),
    /// List the problems, the scenes and the estimators
    #[command(after_help = EXIT_CODES)]
    List,
    /// Apply every estimator to draws of your own
    #[command(after_long_help = format!("{ESTIMATE_FORMAT}\n\n{ESTIMATE_EXAMPLES}\n\n{EXIT_CODES}"))]
    #[command(after_help = format!("{ESTIMATE_EXAMPLES}\n\n{EXIT_CODES}"))]
    Estimate(EstimateArguments),
    /// Run stiff cases with known answers, beside the textbook formulas
    #[command(after_help = format!("A row that fails makes the exit code 1.\n\n{EXIT_CODES}"))]
    Stability(StabilityArguments),
}

/// Options of `report`.
#[derive(Clone, Debug, Args)]
pub struct ReportArguments {
    /// Fewer replicates and smaller samples: at most 20 seconds
    #[arg(long)]
    pub quick: bool,
    /// Only this problem, and no exhibits (repeatable; see `ratiocv list`)
    #[arg(long = "problem", value_name = "NAME", value_parser = problems(), hide_possible_values = true)]
    pub problems: Vec<Problem>,
    /// Only this estimator, beside mc (repeatable; see `ratiocv list`)
    #[arg(long = "estimator", value_name = "NAME", value_parser = methods(), hide_possible_values = true)]
    pub estimators: Vec<Method>,
    /// Render a scene by every method instead: a Mitsuba 3 file, or the name of a built-in scene
    #[arg(long, value_name = "NAME|FILE", conflicts_with_all = ["problems", "estimators", "budget", "all"])]
    pub scene: Option<String>,
    /// What each channel, left alone, would choose the scene's lights by
    #[arg(long, value_enum, default_value_t = Lights::Local, requires = "scene")]
    pub lights: Lights,
    /// The choice of lights that is made for all channels
    #[arg(long, value_enum, default_value_t = Mixed::L2, requires = "scene")]
    pub mixture: Mixed,
    /// Seed of the random draws; the same seed gives the same errors, for any number of threads
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub threads: Option<core::num::NonZeroUsize>,
    /// About how long two cores may measure, in seconds; decides how many replicates there are
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub budget: Option<f64>,
    /// Print every estimator; else plain Monte Carlo and the best of each kind, or those of --estimator
    #[arg(long)]
    pub all: bool,
    /// Directory for the page, the numbers and the pictures
    #[arg(long, value_name = "DIR", default_value = "report")]
    pub out: PathBuf,
}

/// Options of `estimate`.
#[derive(Clone, Debug, Args)]
pub struct EstimateArguments {
    /// The CSV file of draws; - reads standard input
    pub file: PathBuf,
    /// The known integral of an auxiliary, such as h.r=1.25 (repeatable) [default: 1]
    #[arg(long, value_name = "COLUMN=VALUE")]
    pub integral: Vec<Given>,
    /// Weight w of the defensive auxiliaries w H + (1 - w) h, at least 0 and below 1
    #[arg(long, value_name = "W", default_value_t = Defensive::<Plain>::DEFAULT_WEIGHT, value_parser = weight)]
    #[arg(allow_negative_numbers = true)]
    pub defensive: f64,
    /// Only this estimator (repeatable; see `ratiocv list`)
    #[arg(long = "estimator", value_name = "NAME", value_parser = methods(), hide_possible_values = true)]
    pub estimators: Vec<Method>,
    /// How to print the estimates
    #[arg(long, value_enum, default_value_t = Format::Table)]
    pub format: Format,
    /// What to do with a row that is malformed, or whose numbers are not finite
    #[arg(long, value_enum, default_value_t = OnBadDraw::Error)]
    pub on_bad_draw: OnBadDraw,
}

/// Options of `render`.
#[derive(Clone, Debug, Args)]
pub struct RenderArguments {
    /// A Mitsuba 3 scene file, or the name of a built-in scene
    pub scene: String,
    /// Where the image goes, as FILE.exr (linear) or FILE.png (sRGB) (repeatable)
    #[arg(long, value_name = "FILE")]
    pub out: Vec<PathBuf>,
    /// How pixels are estimated
    #[arg(long, value_name = "NAME", value_parser = pixel_methods(), default_value = "defensive_ratio")]
    #[arg(hide_possible_values = true)]
    pub estimator: ratiocv_scene::Method,
    /// Weight of the defensive estimators, at least 0 and below 1 [default: 0.01]
    #[arg(long, value_name = "W", value_parser = weight, allow_negative_numbers = true)]
    pub defensive: Option<f64>,
    /// Samples per pixel [default: those of the scene]
    #[arg(long, value_name = "N", group = "budget")]
    pub spp: Option<core::num::NonZeroU64>,
    /// Render for so many seconds
    #[arg(long, value_name = "SECONDS", value_parser = seconds, group = "budget", allow_negative_numbers = true)]
    pub time: Option<f64>,
    /// Sample each pixel until its standard error is this part of its radiance
    #[arg(long, value_name = "TARGET", value_parser = relative_error, group = "budget", allow_negative_numbers = true)]
    pub error: Option<f64>,
    /// Seed; the same seed gives the same image, for any number of threads
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub threads: Option<core::num::NonZeroUsize>,
    /// What each channel, left alone, would choose lights by
    #[arg(long, value_enum, default_value_t = Lights::Local)]
    pub lights: Lights,
    /// The choice that is made for all channels
    #[arg(long, value_enum, default_value_t = Mixed::L2)]
    pub mixture: Mixed,
    /// Write this too, beside each image, as FILE-error.exr for example (repeatable)
    #[arg(long = "layer", value_name = "LAYER", value_enum)]
    pub layers: Vec<LayerName>,
    /// Print what the scene does not need and is left out; without --out, nothing else
    #[arg(long)]
    pub explain: bool,
    /// Leave out what is not supported, with a warning
    #[arg(long)]
    pub lenient: bool,
    /// Keep the render in a file, to go on with --resume
    #[arg(long, value_name = "FILE")]
    pub save: Option<PathBuf>,
    /// Go on with the render in a file
    #[arg(long, value_name = "FILE")]
    pub resume: Option<PathBuf>,
    /// Add the samples of a file that was saved with another seed (repeatable)
    #[arg(long, value_name = "FILE:SEED", value_parser = file_and_seed)]
    pub merge: Vec<(PathBuf, u64)>,
}

/// Options of `stability`.
#[derive(Clone, Debug, Args)]
pub struct StabilityArguments {
    /// Only this case, or this section: A to H, or StRD (repeatable)
    #[arg(long, value_name = "ID")]
    pub only: Vec<String>,
    /// How to print the table
    #[arg(long, value_enum, default_value_t = StabilityFormat::Table)]
    pub format: StabilityFormat,
    /// Judge the textbook's formulas in place of the library's: what a table of failures looks like
    #[arg(long)]
    pub textbook: bool,
}

/// How a table of stiff cases is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum StabilityFormat {
    /// For people
    Table,
    /// One object, on one line
    Json,
    /// A page of its own
    Html,
}

/// See [`LightChoice`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Lights {
    /// All alike
    Uniform,
    /// By power
    Power,
    /// By power, distance and cosine
    Local,
}

/// See [`Mixture`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Mixed {
    /// By luminance
    Luminance,
    /// By the root of the sum of the channels' squares
    L2,
    /// The mean of the channels' probabilities
    Uniform,
}

/// See [`Layer`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum LayerName {
    /// Standard errors
    Error,
    /// A colour for each set of flags; in EXR, their bits
    Flags,
    /// The exponents of a regression ratio
    Alpha,
}

impl From<Lights> for LightChoice {
    fn from(lights: Lights) -> Self {
        match lights {
            Lights::Uniform => Self::Uniform,
            Lights::Power => Self::Power,
            Lights::Local => Self::Local,
        }
    }
}

impl From<Mixed> for Mixture {
    fn from(mixed: Mixed) -> Self {
        match mixed {
            Mixed::Luminance => Self::Luminance,
            Mixed::L2 => Self::L2,
            Mixed::Uniform => Self::Uniform,
        }
    }
}

impl From<LayerName> for Layer {
    fn from(name: LayerName) -> Self {
        match name {
            LayerName::Error => Self::Error,
            LayerName::Flags => Self::Flags,
            LayerName::Alpha => Self::Alpha,
        }
    }
}

impl EstimateArguments {
    /// The estimators asked for, in the catalogue's order; all if none is named.
    pub fn methods(&self) -> Vec<Method> {
        Method::all().filter(|method| self.estimators.is_empty() || self.estimators.contains(method)).collect()
    }
}

/// Estimators by their ids; an unknown one is answered with the nearest and the list.
fn methods() -> impl TypedValueParser<Value = Method> {
    let values = Method::all().map(|method| PossibleValue::new(method.id()).help(method.about()));
    PossibleValuesParser::new(values).try_map(|id| Method::from_id(&id).ok_or("there is no such estimator"))
}

/// Problems likewise.
fn problems() -> impl TypedValueParser<Value = Problem> {
    let values = Problem::all().map(|problem| PossibleValue::new(problem.id()).help(problem.about()));
    PossibleValuesParser::new(values).try_map(|id| Problem::from_id(&id).ok_or("there is no such problem"))
}

/// Estimators of pixels.
fn pixel_methods() -> impl TypedValueParser<Value = ratiocv_scene::Method> {
    let values = ratiocv_scene::Method::all().map(|method| PossibleValue::new(method.name()).help(method.summary()));
    PossibleValuesParser::new(values.chain([PossibleValue::new("plain").hide(true)]))
        .try_map(|name| ratiocv_scene::Method::named(&name).ok_or("there is no such estimator"))
}

fn file_and_seed(text: &str) -> Result<(PathBuf, u64), String> {
    let split = text.rsplit_once(':').and_then(|(file, seed)| Some((file, seed.parse().ok()?)));
    split.map(|(file, seed)| (file.into(), seed)).ok_or_else(|| "give the file and its seed, as in a.ratiocv:2".into())
}

fn relative_error(text: &str) -> Result<f64, String> {
    let error: f64 = text.parse().map_err(|_| "it must be a number, such as 0.02".to_owned())?;
    if error > 0.0 && error.is_finite() { Ok(error) } else { Err("it must be above 0".into()) }
}

fn weight(text: &str) -> Result<f64, String> {
    let weight: f64 = text.parse().map_err(|_| "it must be a number, such as 0.01".to_owned())?;
    if (0.0..1.0).contains(&weight) { Ok(weight) } else { Err("it must be at least 0 and below 1".into()) }
}

fn seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| "it must be a number of seconds".to_owned())?;
    if seconds > 0.0 && seconds.is_finite() { Ok(seconds) } else { Err("it must be above 0".into()) }
}

#[cfg(test)]
mod tests {
    use super::Arguments;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_well_formed() {
        Arguments::command().debug_assert();
    }
}
