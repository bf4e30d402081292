//! `ratiocv report`: error against run time, measured.

use crate::arguments::ReportArguments;
use crate::fault::Fault;
use crate::progress::OfMeasuring;
use crate::scene::{read as read_scene, use_threads};
use ratiocv_report::scene::SceneSettings;
use ratiocv_report::{Options, TableOptions, run as measure};
use ratiocv_scene::Options as LightOptions;
use std::fs;
use std::io::Write;

/// Runs the command: the table and the names of the files to `out`, the best estimators in bold if `bold`.
///
/// # Errors
/// Options that cannot be met, and files that cannot be written.
pub fn run(arguments: &ReportArguments, bold: bool, out: &mut dyn Write, notes: &mut dyn Write) -> Result<(), Fault> {
    let cannot_write = |error: std::io::Error| {
        let what = format!("cannot write to {}: {error}", arguments.out.display());
        Fault::data(what, "give a directory that may be written to with --out DIR")
    };
    // Before the minute of measuring, not after it.
    fs::create_dir_all(&arguments.out).map_err(cannot_write)?;
    if let Some(scene) = &arguments.scene {
        return of_scene(scene, arguments, out, notes);
    }
    let progress = OfMeasuring::new();
    let measured = measure(&options(arguments), &progress);
    progress.finish();
    let report = measured.map_err(|error| Fault::data(error.to_string(), "see ratiocv report --help"))?;
    let files = report.write(&arguments.out).map_err(cannot_write)?;
    // Estimators that were asked for are shown, good or bad.
    let all = arguments.all || !arguments.estimators.is_empty();
    write!(out, "{}", report.table(TableOptions { all, bold }))?;
    for file in files {
        writeln!(out, "wrote {}", file.display())?;
    }
    Ok(out.flush()?)
}

/// Every method on a scene.
fn of_scene(scene: &str, arguments: &ReportArguments, out: &mut dyn Write, notes: &mut dyn Write) -> Result<(), Fault> {
    let (name, description) = read_scene(scene, false, notes)?;
    use_threads(arguments.threads);
    let settings = SceneSettings {
        seed: arguments.seed,
        quick: arguments.quick,
        options: LightOptions {
            choice: arguments.lights.into(),
            mixture: arguments.mixture.into(),
            ..LightOptions::default()
        },
        ..SceneSettings::default()
    };
    let progress = OfMeasuring::new();
    let measured = ratiocv_report::scene::run(&name, &description, &settings, &arguments.out, &progress);
    progress.finish();
    let report = measured.map_err(|error| Fault::data(error.to_string(), "see ratiocv report --help"))?;
    let files = report.write(&arguments.out).map_err(|error| {
        let what = format!("cannot write to {}: {error}", arguments.out.display());
        Fault::data(what, "give a directory that may be written to with --out DIR")
    })?;
    write!(out, "{}", report.table())?;
    for file in files {
        writeln!(out, "wrote {}", file.display())?;
    }
    Ok(out.flush()?)
}

fn options(arguments: &ReportArguments) -> Options {
    let mut options = Options { seed: arguments.seed, quick: arguments.quick, ..Options::default() };
    options.threads = arguments.threads.map(usize::from);
    // In the order of the list, each once.
    if !arguments.problems.is_empty() {
        options.exhibits = false;
        options.problems.retain(|problem| arguments.problems.contains(problem));
    }
    if !arguments.estimators.is_empty() {
        options.methods.retain(|method| arguments.estimators.contains(method));
    }
    if let Some(seconds) = arguments.budget {
        options.budget_seconds = seconds;
    }
    options
}
