//! Errors and run times of every method.

use crate::Provenance;
use crate::measure::Progress;
use crate::scene::{Reference, SceneFault};
use ratiocv_scene::{Budget, Description, Image, Method, Needs, Options, Render};
use std::path::Path;

/// What to measure.
#[derive(Clone, Debug)]
pub struct SceneSettings {
    /// Seed of the first replicate.
    pub seed: u64,
    /// Fewer samples.
    pub quick: bool,
    /// How lights are chosen.
    pub options: Options,
    /// The methods, beside plain Monte Carlo.
    pub methods: Vec<Method>,
    /// Samples per pixel of the reference; `None`: 4096, or 512 for a quick look.
    pub reference: Option<u64>,
}

impl Default for SceneSettings {
    fn default() -> Self {
        Self { seed: 1, quick: false, options: Options::default(), methods: Method::all().collect(), reference: None }
    }
}

/// What was measured.
#[derive(Clone, Debug)]
pub struct SceneReport {
    /// The scene's name.
    pub name: String,
    /// Columns and rows.
    pub size: [u32; 2],
    /// What the scene needs.
    pub needs: Needs,
    /// What is taken for the truth.
    pub reference: Reference,
    /// A curve for each method, plain Monte Carlo first.
    pub curves: Vec<Curve>,
    /// Images of plain Monte Carlo, of the default method and of the method with the least error, at equal time.
    pub shown: Vec<Shown>,
    /// Where it comes from.
    pub provenance: Provenance,
}

/// The errors of a method.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The method.
    pub method: Method,
    /// By samples per pixel.
    pub points: Vec<ScenePoint>,
}

/// The error after so many samples.
#[derive(Clone, Copy, Debug)]
pub struct ScenePoint {
    /// Samples per pixel.
    pub samples: u64,
    /// Images that were averaged over.
    pub replicates: u64,
    /// Mean over pixels and channels of the squared error.
    pub mse: f64,
    /// Its standard error, from the replicates; NaN of one.
    pub mse_std_error: f64,
    /// Mean of error²/(reference² + 0.01).
    pub relative_mse: f64,
    /// Median seconds of one image.
    pub seconds: f64,
    /// MSE of plain Monte Carlo over this one's, with as many samples.
    pub gain: f64,
    /// MSE·seconds of plain Monte Carlo over this one's.
    pub efficiency: f64,
}

/// An image.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The method.
    pub method: Method,
    /// Samples per pixel.
    pub samples: u64,
    /// Seconds that it took.
    pub seconds: f64,
    /// Its squared error.
    pub mse: f64,
    /// The image.
    pub image: Image,
}

/// Samples per pixel, and images of as many.
const STEPS: [(u64, u64); 5] = [(1, 16), (4, 8), (16, 6), (64, 4), (256, 2)];

/// The step at whose run time images are shown.
const SHOWN: u64 = 64;

/// Measures the methods on a scene; the reference is kept in `folder`.
///
/// # Errors
/// A scene that cannot be rendered, a folder that cannot be written to.
pub fn run(
    name: &str,
    description: &Description,
    settings: &SceneSettings,
    folder: &Path,
    progress: &dyn Progress,
) -> Result<SceneReport, SceneFault> {
    let steps = if settings.quick { &STEPS[..4] } else { &STEPS[..] };
    let methods: Vec<Method> = core::iter::once(Method::plain())
        .chain(settings.methods.iter().copied().filter(Method::reads_auxiliaries))
        .collect();
    let total = 1 + methods.len() as u64 * steps.len() as u64 + 1;
    progress.report(0, total, "reference");
    let samples = settings.reference.unwrap_or(if settings.quick { 512 } else { 4096 });
    let reference = Reference::of(description, settings, samples, folder)?;

    let mut curves: Vec<Curve> = methods.iter().map(|method| Curve { method: *method, points: Vec::new() }).collect();
    let mut done = 1;
    for (samples, replicates) in steps {
        // Methods take turns, so that what disturbs the machine disturbs all alike.
        let mut measured = methods.iter().map(|_| Vec::new()).collect::<Vec<_>>();
        for replicate in 0..*replicates {
            for (method, measured) in methods.iter().zip(&mut measured) {
                progress.report(done, total, method.name());
                let rendered = render(description, settings, *method, *samples, settings.seed + replicate)?;
                let (mse, relative) = reference.compare(&rendered.image);
                measured.push(Measured { mse, relative, seconds: rendered.time.as_secs_f64() });
            }
        }
        done += methods.len() as u64;
        for (curve, measured) in curves.iter_mut().zip(&measured) {
            curve.points.push(point(*samples, measured));
        }
    }
    for step in 0..steps.len() {
        let plain = curves[0].points[step];
        for curve in &mut curves {
            let own = &mut curve.points[step];
            own.gain = plain.mse / own.mse;
            own.efficiency = plain.mse * plain.seconds / (own.mse * own.seconds);
        }
    }
    progress.report(total - 1, total, "images at equal time");
    let shown = at_equal_time(description, settings, &reference, &curves)?;
    let needs = Render::new(description).options(settings.options).needs();
    let provenance = Provenance::of_scene(settings.seed, settings.quick);
    Ok(SceneReport { name: name.to_owned(), size: description.size, needs, reference, curves, shown, provenance })
}

fn render(
    description: &Description,
    settings: &SceneSettings,
    method: Method,
    samples: u64,
    seed: u64,
) -> Result<ratiocv_scene::Rendered, SceneFault> {
    let render = Render::new(description).options(settings.options).method(method);
    Ok(render.budget(Budget::Samples(samples)).seed(seed).run()?)
}

/// Of one image.
struct Measured {
    mse: f64,
    relative: f64,
    seconds: f64,
}

fn point(samples: u64, measured: &[Measured]) -> ScenePoint {
    let replicates = measured.len() as f64;
    let mean = |of: &dyn Fn(&Measured) -> f64| measured.iter().map(of).sum::<f64>() / replicates;
    let mse = mean(&|image| image.mse);
    let squares: f64 = measured.iter().map(|image| (image.mse - mse) * (image.mse - mse)).sum();
    let mut seconds: Vec<f64> = measured.iter().map(|image| image.seconds).collect();
    seconds.sort_by(f64::total_cmp);
    ScenePoint {
        samples,
        replicates: measured.len() as u64,
        mse,
        mse_std_error: libm::sqrt(squares / (replicates - 1.0) / replicates),
        relative_mse: mean(&|image| image.relative),
        seconds: seconds[seconds.len() / 2],
        gain: f64::NAN,
        efficiency: f64::NAN,
    }
}

/// Images of plain, the default and the best method in the time of plain's [`SHOWN`] samples.
fn at_equal_time(
    description: &Description,
    settings: &SceneSettings,
    reference: &Reference,
    curves: &[Curve],
) -> Result<Vec<Shown>, SceneFault> {
    let at = |curve: &Curve| curve.points.iter().find(|point| point.samples == SHOWN).copied();
    let Some(plain) = at(&curves[0]) else { return Ok(Vec::new()) };
    let error = |curve: &&Curve| at(curve).map_or(f64::INFINITY, |point| point.mse * point.seconds);
    let best = curves.iter().min_by(|a, b| error(a).total_cmp(&error(b)));
    let mut wanted = vec![Method::plain(), Method::default()];
    wanted.extend(best.map(|curve| curve.method));
    let mut shown: Vec<Shown> = Vec::new();
    for method in wanted {
        let Some(curve) = curves.iter().find(|curve| curve.method.name() == method.name()) else { continue };
        if shown.iter().any(|other| other.method.name() == method.name()) {
            continue;
        }
        let share = at(curve).map_or(1.0, |point| plain.seconds / point.seconds);
        let samples = libm::round(SHOWN as f64 * share).max(1.0) as u64;
        let rendered = render(description, settings, curve.method, samples, settings.seed)?;
        let (mse, _) = reference.compare(&rendered.image);
        let (method, seconds) = (curve.method, rendered.time.as_secs_f64());
        shown.push(Shown { method, samples, seconds, mse, image: rendered.image });
    }
    Ok(shown)
}
