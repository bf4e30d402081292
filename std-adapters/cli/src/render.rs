//! `ratiocv render`: a scene file becomes an image.

use crate::arguments::RenderArguments;
use crate::fault::Fault;
use crate::progress;
use crate::scene::{read, use_threads};
use crate::words::counted;
use core::sync::atomic::{AtomicBool, Ordering::Relaxed};
use core::time::Duration;
use ratiocv_scene::{Budget, Description, Layer, Needs, Options, Render, RenderError, Rendered, Stopped, Written};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How often a render is saved.
const SAVED_EVERY: Duration = Duration::from_secs(60);

/// Runs the command: what was rendered and where it went to `out`, warnings to `notes`.
///
/// # Errors
/// A scene that cannot be read or rendered, an image that cannot be written anywhere.
pub fn run(arguments: &RenderArguments, out: &mut dyn Write, notes: &mut dyn Write) -> Result<(), Fault> {
    if arguments.out.is_empty() && !arguments.explain {
        return Err(Fault::usage("there is nowhere to write the image to", "give --out FILE.exr or --out FILE.png"));
    }
    for path in &arguments.out {
        can_be_written(path)?;
    }
    let (_, description) = read(&arguments.scene, arguments.lenient, notes)?;
    use_threads(arguments.threads);
    let render = configured(arguments, &description);
    if arguments.explain {
        explain(&render.needs(), out)?;
        if arguments.out.is_empty() {
            return Ok(out.flush()?);
        }
    }
    let cancelled = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&cancelled);
    // The second time, the process ends. Without a handler, the first.
    let _ = ctrlc::set_handler(move || {
        if flag.swap(true, Relaxed) {
            std::process::exit(130);
        }
    });
    let bar = progress::of_rendering();
    let tell = |done, of| progress::tell(&bar, done, of);
    let rendered = render.progress(&tell).cancel(&cancelled).run();
    bar.finish_and_clear();
    let rendered = rendered.map_err(|error| faulty(&error))?;
    let written = write_all(arguments, &rendered, out);
    summary(&rendered, out)?;
    out.flush()?;
    if let Some(error) = &rendered.not_saved {
        return Err(Fault::data(
            format!("the render was not saved: {error}"),
            "the images are written; save elsewhere",
        ));
    }
    written
}

/// The render that the command line asks for.
fn configured<'a>(arguments: &RenderArguments, description: &'a Description) -> Render<'a> {
    let wants = |layer| arguments.layers.contains(&layer);
    let method = arguments.estimator;
    let mut render = Render::new(description)
        .options(Options { choice: arguments.lights.into(), mixture: arguments.mixture.into(), ..Options::default() })
        .method(arguments.defensive.and_then(|weight| method.with_weight(weight)).unwrap_or(method))
        .seed(arguments.seed)
        .errors(wants(crate::arguments::LayerName::Error))
        .flags(wants(crate::arguments::LayerName::Flags))
        .alpha(wants(crate::arguments::LayerName::Alpha));
    if let Some(samples) = arguments.spp {
        render = render.budget(Budget::Samples(samples.get()));
    } else if let Some(seconds) = arguments.time {
        render = render.budget(Budget::Time(Duration::from_secs_f64(seconds)));
    } else if let Some(error) = arguments.error {
        render = render.budget(Budget::Error(error));
    }
    if let Some(path) = &arguments.save {
        render = render.save(path, SAVED_EVERY);
    }
    if let Some(path) = &arguments.resume {
        render = render.resume(path);
    }
    for (path, seed) in &arguments.merge {
        render = render.merge(path, *seed);
    }
    render
}

/// Before the minutes of rendering, not after them.
fn can_be_written(path: &Path) -> Result<(), Fault> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
    if ending != "exr" && ending != "png" {
        let what = format!("{}: the ending says the format, and '{ending}' is none that is known", path.display());
        return Err(Fault::usage(what, "give a name that ends in .exr or .png"));
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        let what = format!("cannot write {}: there is no folder {}", path.display(), folder.display());
        return Err(Fault::data(what, "make the folder, or give another name with --out"));
    }
    Ok(())
}

fn faulty(error: &RenderError) -> Fault {
    let remedy = match error {
        RenderError::Checkpoint(_) => "resume with the settings of the file, or render anew without --resume",
        _ => "see ratiocv render --help",
    };
    Fault::data(error.to_string(), remedy)
}

fn explain(needs: &Needs, out: &mut dyn Write) -> Result<(), Fault> {
    Ok(writeln!(out, "{needs}")?)
}

/// `image.exr`, or `image-error.exr` for another layer than radiance.
fn name_of(path: &Path, layer: Layer) -> PathBuf {
    if layer == Layer::Radiance {
        return path.to_owned();
    }
    let (stem, ending) = (path.file_stem().unwrap_or_default(), path.extension().unwrap_or_default());
    path.with_file_name(format!("{}-{layer}.{}", stem.to_string_lossy(), ending.to_string_lossy()))
}

fn write_all(arguments: &RenderArguments, rendered: &Rendered, out: &mut dyn Write) -> Result<(), Fault> {
    let mut result = Ok(());
    for path in &arguments.out {
        for layer in [Layer::Radiance].into_iter().chain(arguments.layers.iter().map(|name| (*name).into())) {
            match ratiocv_scene::write(&rendered.image, layer, &name_of(path, layer)) {
                Ok(Written::There(path)) => writeln!(out, "wrote {}", path.display())?,
                Ok(Written::Instead { path, because }) => {
                    writeln!(out, "wrote {} instead", path.display())?;
                    let what = format!("{because}; the image is in {}", path.display());
                    result = Err(Fault::data(what, "copy it from there"));
                }
                Err(what) => result = Err(Fault::data(what, "make room, or give another name with --out")),
            }
        }
    }
    result
}

fn summary(rendered: &Rendered, out: &mut dyn Write) -> Result<(), Fault> {
    let [width, height] = rendered.image.size;
    let seconds = rendered.time.as_secs_f64();
    let unreached = rendered.image.samples.iter().filter(|samples| **samples == 0).count();
    if rendered.stopped == Stopped::Cancelled {
        writeln!(out, "stopped before its end; {} without samples", counted(unreached as u64, "pixel"))?;
    }
    writeln!(
        out,
        "{width} x {height} pixels, {:.3} M samples in {seconds:.2} s, {:.3} M samples/s",
        rendered.samples as f64 / 1e6,
        rendered.samples as f64 / seconds / 1e6,
    )?;
    let unknown = rendered.image.radiance.iter().filter(|rgb| rgb.iter().any(|x| !x.is_finite())).count() - unreached;
    if unknown > 0 {
        writeln!(out, "{} without a finite value", counted(unknown as u64, "pixel"))?;
    }
    let lit = rendered.image.radiance.iter().flatten().any(|x| *x != 0.0);
    if !lit {
        writeln!(out, "every pixel is black: no sample met any light; see --explain, or take more samples")?;
    }
    Ok(())
}
