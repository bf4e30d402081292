//! What is to be rendered, and how.

use crate::colour::Colour;
use crate::description::Description;
use crate::needs::{Needs, Options};
use crate::render::error::RenderError;
use crate::render::frame::Extras;
use crate::render::image::Image;
use crate::render::method::{Method, OnPixel, Rgb, Visitor};
use crate::render::work::Work;
use crate::scene::Scene;
use core::fmt;
use core::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use core::time::Duration;
use ratiocv_core::Plain;
use std::path::PathBuf;
use std::time::Instant;

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
    pub(super) description: &'a Description,
    pub(super) options: Options,
    pub(super) method: Method,
    pub(super) budget: Budget,
    pub(super) seed: u64,
    pub(super) extras: Extras,
    pub(super) progress: Option<&'a (dyn Fn(u64, u64) + Sync)>,
    pub(super) cancel: Option<&'a AtomicBool>,
    pub(super) save: Option<(PathBuf, Duration)>,
    pub(super) resume: Option<PathBuf>,
    /// Files of other seeds.
    pub(super) merge: Vec<(PathBuf, u64)>,
}

impl fmt::Debug for Render<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { options, method, budget, seed, extras, save, resume, merge, .. } = self;
        f.debug_struct("Render")
            .field("options", options)
            .field("method", method)
            .field("budget", budget)
            .field("seed", seed)
            .field("extras", extras)
            .field("save", save)
            .field("resume", resume)
            .field("merge", merge)
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
            merge: Vec::new(),
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
    /// method, seed and kind of budget. Of a render that was finished with a number of samples that 64 does not divide,
    /// the rest has other random numbers than in one go, and is as good.
    #[must_use]
    pub fn resume(mut self, path: impl Into<PathBuf>) -> Self {
        self.resume = Some(path.into());
        self
    }

    /// Appends the samples in the file `path`, of the same render with another seed, on another machine perhaps. They
    /// count towards the budget.
    #[must_use]
    pub fn merge(mut self, path: impl Into<PathBuf>, seed: u64) -> Self {
        self.merge.push((path.into(), seed));
        self
    }

    /// What the scene needs when rendered like this.
    pub fn needs(&self) -> Needs {
        Needs::of(self.description, &self.effective_options())
    }

    pub(super) fn effective_options(&self) -> Options {
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
        let files = self.save.is_some() || self.resume.is_some() || !self.merge.is_empty();
        let keeps_all = files || self.method.shared_radius() > 0;
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

    pub(super) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Relaxed))
    }

    pub(super) fn tell(&self, done: u64, of: u64) {
        if let Some(callback) = self.progress {
            callback(done.min(of), of);
        }
    }
}
