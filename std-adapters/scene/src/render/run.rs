//! The loop over pixels.

use crate::colour::Colour;
use crate::description::Description;
use crate::needs::{Needs, Options};
use crate::path::{BLOCK, Samples};
use crate::render::error::RenderError;
use crate::render::frame::{Extras, Frame};
use crate::render::image::Image;
use crate::render::method::{Method, OnPixel, Rgb, Visitor};
use crate::render::pixel::{Pixel, PixelEstimate};
use crate::scene::Scene;
use core::fmt;
use core::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use core::time::Duration;
use ratiocv_core::Plain;
use ratiocv_threads::{CheckpointFile, Fault};
use rayon::prelude::*;
use std::path::PathBuf;
use std::time::Instant;

/// Samples of a pixel in one pass of a render whose end is a time.
const SHORT: usize = 16;

/// A pixel's error bar is not believed before.
const ENOUGH: u64 = 128;

/// Most samples of a pixel that does not reach the error that is asked for.
const MOST: u64 = 1 << 16;

/// When a render is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Budget {
    /// So many samples of each pixel.
    Samples(u64),
    /// After this time, each pixel having at least 16 samples.
    Time(Duration),
    /// Each pixel where its standard error is at most this part of its radiance, or of a hundredth of the
    /// image's mean where it is darker, but not before 128 samples nor after 65536.
    Error(f64),
}

/// Why a render stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// It is done.
    Finished,
    /// It was cancelled.
    Cancelled,
}

/// How a description is to be rendered.
///
/// ```
/// use ratiocv_scene::{Budget, Description, Method, Render};
/// let scene = Description::built_in("S4b").expect("a built-in scene");
/// let rendered = Render::new(&scene).method(Method::plain()).budget(Budget::Samples(1)).run()?;
/// assert_eq!(rendered.image.radiance[0], [1.0, 0.5, 2.0]); // the sky
/// # Ok::<(), ratiocv_scene::RenderError>(())
/// ```
pub struct Render<'a> {
    description: &'a Description,
    options: Options,
    method: Method,
    budget: Budget,
    seed: u64,
    extras: Extras,
    progress: Option<&'a (dyn Fn(u64, u64) + Sync)>,
    cancel: Option<&'a AtomicBool>,
    save: Option<(PathBuf, Duration)>,
    resume: Option<PathBuf>,
}

impl fmt::Debug for Render<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { options, method, budget, seed, extras, save, resume, .. } = self;
        f.debug_struct("Render")
            .field("options", options)
            .field("method", method)
            .field("budget", budget)
            .field("seed", seed)
            .field("extras", extras)
            .field("save", save)
            .field("resume", resume)
            .finish_non_exhaustive()
    }
}

/// What a render came to.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The image; NaN in pixels that were not reached.
    pub image: Image,
    /// What the scene needed.
    pub needs: Needs,
    /// Samples of this sitting.
    pub samples: u64,
    /// Time that they took.
    pub time: Duration,
    /// Why there are no more.
    pub stopped: Stopped,
    /// What went wrong with the file that the render was to be kept in; the image is none the worse for it.
    pub not_saved: Option<String>,
}

impl<'a> Render<'a> {
    /// A render of `description` by the default method, with as many samples as it says.
    pub fn new(description: &'a Description) -> Self {
        Self {
            description,
            options: Options::default(),
            method: Method::default(),
            budget: Budget::Samples(u64::from(description.samples)),
            seed: 0,
            extras: Extras::default(),
            progress: None,
            cancel: None,
            save: None,
            resume: None,
        }
    }

    /// How lights are chosen; whether there are auxiliaries is the method's to say.
    #[must_use]
    pub fn options(mut self, options: Options) -> Self {
        self.options = options;
        self
    }

    /// The estimator.
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.method = method;
        self
    }

    /// When it is done.
    #[must_use]
    pub fn budget(mut self, budget: Budget) -> Self {
        self.budget = budget;
        self
    }

    /// The seed of all random numbers: the same seed, the same image, for any number of threads.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Keeps what error bars need: the same radiances, to the bit, and standard errors beside them.
    #[must_use]
    pub fn errors(mut self, wanted: bool) -> Self {
        self.extras.errors = wanted;
        self
    }

    /// Wants flags.
    #[must_use]
    pub fn flags(mut self, wanted: bool) -> Self {
        self.extras.flags = wanted;
        self
    }

    /// Wants exponents, of a method that has some.
    #[must_use]
    pub fn alpha(mut self, wanted: bool) -> Self {
        self.extras.alpha = wanted;
        self
    }

    /// Calls `callback` with the work done and the work in all: rows, or milliseconds, or samples. Called by all threads.
    #[must_use]
    pub fn progress(mut self, callback: &'a (dyn Fn(u64, u64) + Sync)) -> Self {
        self.progress = Some(callback);
        self
    }

    /// Stops soon after `flag` is set.
    #[must_use]
    pub fn cancel(mut self, flag: &'a AtomicBool) -> Self {
        self.cancel = Some(flag);
        self
    }

    /// Keeps the moments of all pixels in the file `path`, every so often and at the end.
    #[must_use]
    pub fn save(mut self, path: impl Into<PathBuf>, every: Duration) -> Self {
        self.save = Some((path.into(), every));
        self
    }

    /// Goes on from the file `path`: the same image, to the bit, as without a pause. It must be of the same scene,
    /// method, seed and kind of budget.
    #[must_use]
    pub fn resume(mut self, path: impl Into<PathBuf>) -> Self {
        self.resume = Some(path.into());
        self
    }

    /// What the scene needs when rendered like this.
    pub fn needs(&self) -> Needs {
        Needs::of(self.description, &self.effective_options())
    }

    fn effective_options(&self) -> Options {
        Options { auxiliary: self.method.reads_auxiliaries(), ..self.options }
    }

    /// Renders.
    ///
    /// # Errors
    /// [`RenderError::Scene`] as [`Scene::new`]; [`RenderError::Setting`] for a budget of nothing;
    /// [`RenderError::Checkpoint`] if the file to resume from cannot be read, or is not of this render. A file that
    /// cannot be *written* spoils nothing: see [`Rendered::not_saved`].
    pub fn run(&self) -> Result<Rendered, RenderError> {
        let sound = match self.budget {
            Budget::Samples(samples) => samples > 0,
            Budget::Time(time) => !time.is_zero(),
            Budget::Error(error) => error > 0.0 && error < f64::INFINITY,
        };
        if !sound {
            return Err(RenderError::Setting { setting: "the budget", needed: "samples, a time or an error above 0" });
        }
        let options = self.effective_options();
        if self.needs().channels == 1 {
            return self.with(&Scene::<f32>::new(self.description, &options)?, &Plain);
        }
        let scene = Scene::<Rgb>::new(self.description, &options)?;
        if scene.terms().is_empty() {
            // Nothing depends on a channel: all methods are plain Monte Carlo.
            return self.with(&scene, &Plain);
        }
        struct Run<'a, 'b>(&'a Render<'b>, &'a Scene<Rgb>);
        impl Visitor for Run<'_, '_> {
            type Output = Result<Rendered, RenderError>;
            fn visit<E: OnPixel<Rgb>>(self, estimator: &E) -> Self::Output {
                self.0.with(self.1, estimator)
            }
        }
        self.method.visit(Run(self, &scene))
    }

    fn with<C: Colour, E: OnPixel<C>>(&self, scene: &Scene<C>, estimator: &E) -> Result<Rendered, RenderError> {
        let work = Work { render: self, scene, estimator, samples: AtomicU64::new(0), begun: Instant::now() };
        let keeps_all = self.save.is_some() || self.resume.is_some() || self.method.shared_radius() > 0;
        let (image, stopped, not_saved) = match self.budget {
            Budget::Samples(samples) if !keeps_all => {
                let (image, stopped) = work.once(samples);
                (image, stopped, None)
            }
            _ => work.in_passes()?,
        };
        Ok(Rendered {
            image,
            needs: *scene.needs(),
            samples: work.samples.into_inner(),
            time: work.begun.elapsed(),
            stopped,
            not_saved,
        })
    }

    fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Relaxed))
    }

    fn tell(&self, done: u64, of: u64) {
        if let Some(callback) = self.progress {
            callback(done.min(of), of);
        }
    }
}

/// One sitting.
struct Work<'a, C: Colour, E> {
    render: &'a Render<'a>,
    scene: &'a Scene<C>,
    estimator: &'a E,
    samples: AtomicU64,
    begun: Instant,
}

impl<C: Colour, E: OnPixel<C>> Work<'_, C, E> {
    fn errors(&self) -> bool {
        self.render.extras.errors || matches!(self.render.budget, Budget::Error(_))
    }

    fn pixel(&self) -> Pixel<C, E::Term> {
        Pixel::new(self.scene.terms().len(), self.estimator.empty(), self.errors())
    }

    /// Adds the samples from `pixel.count()` on, at most `more`, in blocks of `block`.
    fn sample(&self, at: [u32; 2], pixel: &mut Pixel<C, E::Term>, block: usize, more: u64, samples: &mut Samples<C>) {
        let end = pixel.count() + more;
        while pixel.count() < end {
            // The last block may be shorter; the next pass goes on with the one after it.
            let (number, count) = (pixel.count().div_ceil(block as u64), (end - pixel.count()).min(block as u64));
            self.scene.trace(at, number, count as usize, self.render.seed, samples);
            pixel.add(samples);
            self.samples.fetch_add(count, Relaxed);
        }
    }

    /// Pixel by pixel: moments of the pixels in flight alone.
    fn once(&self, count: u64) -> (Image, Stopped) {
        let [width, height] = self.scene.size();
        let done = AtomicU64::new(0);
        let rows: Vec<Image> = (0..height)
            .into_par_iter()
            .map_init(
                || (self.pixel(), Samples::new(self.scene)),
                |(pixel, samples), y| {
                    let mut row = Image::default();
                    for x in 0..width {
                        pixel.clear(self.estimator.empty());
                        if !self.render.is_cancelled() {
                            self.sample([x, y], pixel, BLOCK, count, samples);
                        }
                        row.push(pixel, self.estimator, &[], self.render.extras);
                    }
                    self.render.tell(done.fetch_add(1, Relaxed) + 1, u64::from(height));
                    row
                },
            )
            .collect();
        let mut image = Image { size: [width, height], ..Image::default() };
        rows.into_iter().for_each(|row| image.append(row));
        (image, self.stopped(done.into_inner() == u64::from(height) && !self.render.is_cancelled()))
    }

    fn stopped(&self, finished: bool) -> Stopped {
        if finished { Stopped::Finished } else { Stopped::Cancelled }
    }

    /// Pass by pass: moments of all pixels.
    fn in_passes(&self) -> Result<(Image, Stopped, Option<String>), RenderError> {
        let render = self.render;
        let mut frame = self.frame()?;
        let (mut finished, mut not_saved, mut saved) = (vec![false; frame.pixels.len()], None, Instant::now());
        let is_finished = loop {
            self.mark_finished(&frame, &mut finished);
            if finished.iter().all(|finished| *finished) {
                break true;
            }
            if render.is_cancelled() {
                break false;
            }
            self.pass(&mut frame, &finished);
            self.tell(&frame);
            if let Some((path, every)) = &render.save
                && saved.elapsed() >= *every
            {
                not_saved = self.file(path).save(&words(&mut frame)).err().map(|error| error.to_string());
                saved = Instant::now();
            }
        };
        if let Some((path, _)) = &render.save {
            not_saved = self.file(path).save(&words(&mut frame)).err().map(|error| error.to_string());
        }
        let image = frame.resolve(self.estimator, render.method.shared_radius(), render.extras);
        Ok((image, self.stopped(is_finished), not_saved))
    }

    /// One block of each pixel that is not finished.
    fn pass(&self, frame: &mut Frame<C, E::Term>, finished: &[bool]) {
        let width = self.scene.size()[0] as usize;
        let block = self.block();
        let out_of_time = || match self.render.budget {
            Budget::Time(time) => self.begun.elapsed() >= time,
            _ => false,
        };
        frame.pixels.par_chunks_mut(width).zip(finished.par_chunks(width)).enumerate().for_each_init(
            || Samples::new(self.scene),
            |samples, (y, (pixels, finished))| {
                for (x, pixel) in pixels.iter_mut().enumerate().filter(|(x, _)| !finished[*x]) {
                    if self.render.is_cancelled() || (pixel.count() > 0 && out_of_time()) {
                        return;
                    }
                    let more = match self.render.budget {
                        Budget::Samples(samples) => samples.saturating_sub(pixel.count()).min(block as u64),
                        _ => block as u64,
                    };
                    self.sample([x as u32, y as u32], pixel, block, more, samples);
                }
            },
        );
    }

    fn block(&self) -> usize {
        if matches!(self.render.budget, Budget::Time(_)) { SHORT } else { BLOCK }
    }

    /// Finds the pixels that need no more samples.
    fn mark_finished(&self, frame: &Frame<C, E::Term>, finished: &mut [bool]) {
        match self.render.budget {
            Budget::Samples(samples) => {
                finished
                    .iter_mut()
                    .zip(&frame.pixels)
                    .for_each(|(finished, pixel)| *finished = pixel.count() >= samples);
            }
            Budget::Time(time) => {
                let out = self.begun.elapsed() >= time;
                finished
                    .iter_mut()
                    .zip(&frame.pixels)
                    .for_each(|(finished, pixel)| *finished = out && pixel.count() > 0);
            }
            Budget::Error(target) => {
                let estimates: Vec<PixelEstimate> =
                    frame.pixels.par_iter().map(|pixel| pixel.estimate(self.estimator, &[])).collect();
                let size = |x: &[f64; 3]| x[..C::LANES].iter().map(|x| x * x).sum::<f64>().sqrt();
                let floor = estimates.iter().map(|estimate| size(&estimate.value)).sum::<f64>()
                    / estimates.len() as f64
                    / 100.0;
                for ((finished, pixel), estimate) in finished.iter_mut().zip(&frame.pixels).zip(&estimates) {
                    let (error, value) = (size(&estimate.std_error), size(&estimate.value));
                    // A pixel that saw no light has no error bar; it is black for all that is known.
                    let small = error <= target * value.max(floor) || (value == 0.0 && pixel.count() >= 8 * ENOUGH);
                    *finished |= (pixel.count() >= ENOUGH && small) || pixel.count() >= MOST;
                }
            }
        }
    }

    fn tell(&self, frame: &Frame<C, E::Term>) {
        let counts = || frame.pixels.iter().map(Pixel::count);
        match self.render.budget {
            Budget::Samples(samples) => self.render.tell(counts().sum(), samples * frame.pixels.len() as u64),
            Budget::Time(time) => self.render.tell(self.begun.elapsed().as_millis() as u64, time.as_millis() as u64),
            Budget::Error(_) => self.render.tell(counts().max().unwrap_or(0), MOST),
        }
    }

    /// A new frame, or the one that is to be resumed.
    fn frame(&self) -> Result<Frame<C, E::Term>, RenderError> {
        let mut frame = Frame::new(self.scene.size(), self.scene.terms().len(), self.estimator.empty(), self.errors());
        let Some(path) = &self.render.resume else { return Ok(frame) };
        let file = self.file(path);
        let Some(words) = file.load()? else {
            let source = std::io::Error::from(std::io::ErrorKind::NotFound);
            return Err(file.error(Fault::Io { doing: "read it", source }).into());
        };
        let mut rest = words.iter();
        let mut complete = true;
        frame.words(&mut |word| match rest.next() {
            Some(saved) => *word = *saved,
            None => complete = false,
        });
        if !complete || rest.len() > 0 {
            return Err(file.error(Fault::Damaged("it does not hold the numbers of this image")).into());
        }
        Ok(frame)
    }

    /// A file of this render: what decides the bits of its samples.
    fn file(&self, path: &PathBuf) -> CheckpointFile {
        let render = self.render;
        let unlimited = Description { samples: 0, ..render.description.clone() };
        let settings = [
            ("the version of ratiocv", env!("CARGO_PKG_VERSION").to_owned()),
            ("the scene", format!("{:08x}", crc32fast::hash(format!("{unlimited:?}").as_bytes()))),
            ("the sampling of lights", format!("{:?}", render.effective_options())),
            ("the estimator", render.method.name().to_owned()),
            ("the defensive weight", format!("{:?}", render.method.weight())),
            ("the seed", render.seed.to_string()),
            ("samples in a block", self.block().to_string()),
            ("error bars", self.errors().to_string()),
        ];
        CheckpointFile::new(path, settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }
}

fn words<C: Colour, M: crate::render::method::Term<C>>(frame: &mut Frame<C, M>) -> Vec<u64> {
    let mut words = Vec::new();
    frame.words(&mut |word| words.push(*word));
    words
}
