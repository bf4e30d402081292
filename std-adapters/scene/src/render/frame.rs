//! What is kept of all pixels at once, for renders that go on.

use crate::colour::Colour;
use crate::render::error::RenderError;
use crate::render::image::Image;
use crate::render::method::{OnPixel, Term};
use crate::render::pixel::Pixel;

/// The moments of every pixel: to be rendered pass by pass, saved, resumed and merged.
///
/// A render of a fixed number of samples needs none: it keeps the moments of the pixels in flight alone.
#[derive(Clone, Debug)]
pub struct Frame<C: Colour, M> {
    size: [u32; 2],
    pub(super) pixels: Vec<Pixel<C, M>>,
}

/// What of an image is wanted beside radiances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Extras {
    pub(super) errors: bool,
    pub(super) flags: bool,
    pub(super) alpha: bool,
}

impl<C: Colour, M: Term<C>> Frame<C, M> {
    /// Pixels without samples.
    pub fn new(size: [u32; 2], terms: usize, empty: M, errors: bool) -> Self {
        let count = size[0] as usize * size[1] as usize;
        Self { size, pixels: vec![Pixel::new(terms, empty, errors); count] }
    }

    /// The pixels, row by row from the top.
    pub fn pixels(&self) -> &[Pixel<C, M>] {
        &self.pixels
    }

    /// Appends the samples of another frame of the same scene, rendered with another seed.
    ///
    /// # Errors
    /// [`RenderError::Mismatch`] if it has another size; then nothing is changed.
    pub fn merge(&mut self, later: &Self) -> Result<(), RenderError> {
        if self.size != later.size {
            return Err(RenderError::Mismatch);
        }
        self.pixels.iter_mut().zip(&later.pixels).for_each(|(pixel, later)| pixel.merge(later));
        Ok(())
    }

    /// Shows every number, for saving and loading.
    pub fn words(&mut self, each: &mut dyn FnMut(&mut u64)) {
        self.pixels.iter_mut().for_each(|pixel| pixel.words(each));
    }

    /// The moments of each term, of all pixels at most `radius` columns and rows from pixel `index`; none for 0.
    fn neighbours(&self, index: usize, radius: u32) -> Vec<M> {
        let mut all = Vec::new();
        if radius > 0 {
            let [width, height] = self.size.map(|size| size as usize);
            let (x, y, radius) = (index % width, index / width, radius as usize);
            for row in y.saturating_sub(radius)..(y + radius + 1).min(height) {
                for column in x.saturating_sub(radius)..(x + radius + 1).min(width) {
                    self.pixels[row * width + column].merge_terms_into(&mut all);
                }
            }
        }
        all
    }

    /// What it amounts to.
    pub(super) fn resolve<E: OnPixel<C, Term = M>>(&self, estimator: &E, radius: u32, extras: Extras) -> Image {
        let mut image = Image { size: self.size, ..Image::default() };
        for (index, pixel) in self.pixels.iter().enumerate() {
            image.push(pixel, estimator, &self.neighbours(index, radius), extras);
        }
        image
    }
}

impl Image {
    /// Appends the next pixel.
    pub(super) fn push<C: Colour, E: OnPixel<C>>(
        &mut self,
        pixel: &Pixel<C, E::Term>,
        estimator: &E,
        neighbours: &[E::Term],
        extras: Extras,
    ) {
        let rgb = |x: [f64; 3]| core::array::from_fn(|i| x[if C::LANES == 1 { 0 } else { i }] as f32);
        let estimate = pixel.estimate(estimator, neighbours);
        self.radiance.push(rgb(estimate.value));
        self.samples.push(pixel.count());
        if extras.errors {
            self.std_error.push(rgb(estimate.std_error));
        }
        if extras.flags {
            let [r, g, b] = estimate.flags;
            self.flags.push((r | g | b).bits());
        }
        if extras.alpha {
            self.alpha.push(rgb(pixel.alpha(estimator, neighbours)));
        }
    }

    /// Appends the rows of another part.
    pub(super) fn append(&mut self, mut later: Self) {
        self.radiance.append(&mut later.radiance);
        self.std_error.append(&mut later.std_error);
        self.flags.append(&mut later.flags);
        self.alpha.append(&mut later.alpha);
        self.samples.append(&mut later.samples);
    }
}
