//! One sitting: the loop over pixels, at once or pass by pass.

use crate::colour::Colour;
use crate::path::{BLOCK, Samples};
use crate::render::frame::Frame;
use crate::render::image::Image;
use crate::render::kept::words;
use crate::render::method::OnPixel;
use crate::render::pixel::{Pixel, PixelEstimate};
use crate::render::{Budget, Render, RenderError, Stopped};
use crate::scene::Scene;
use core::sync::atomic::{AtomicU64, Ordering::Relaxed};
use rayon::prelude::*;
use std::time::Instant;

/// Samples of a pixel in one pass of a render whose end is a time.
const SHORT: usize = 16;

/// A pixel's error bar is not believed before.
const ENOUGH: u64 = 128;

/// Most samples of a pixel that does not reach the error that is asked for.
const MOST: u64 = 1 << 16;

/// One sitting.
pub(super) struct Work<'a, C: Colour, E> {
    pub(super) render: &'a Render<'a>,
    pub(super) scene: &'a Scene<C>,
    pub(super) estimator: &'a E,
    pub(super) samples: AtomicU64,
    pub(super) begun: Instant,
}

impl<C: Colour, E: OnPixel<C>> Work<'_, C, E> {
    pub(super) fn errors(&self) -> bool {
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
    pub(super) fn once(&self, count: u64) -> (Image, Stopped) {
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
    pub(super) fn in_passes(&self) -> Result<(Image, Stopped, Option<String>), RenderError> {
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
                not_saved = self.file(path, render.seed).save(&words(&mut frame)).err().map(|error| error.to_string());
                saved = Instant::now();
            }
        };
        if let Some((path, _)) = &render.save {
            not_saved = self.file(path, render.seed).save(&words(&mut frame)).err().map(|error| error.to_string());
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

    pub(super) fn block(&self) -> usize {
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
}
