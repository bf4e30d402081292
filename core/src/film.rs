//! An image of accumulators in memory that the caller owns.

use crate::error::Error;
use crate::estimate::ChannelEstimate;
use crate::estimator::Estimator;
use crate::integrals::Integrals;
use crate::lanes::{Lanes, Scalar};
use crate::moments::{Accumulate, Merge, Moments};
use crate::planted::planted;

/// One accumulator per pixel, or per pack of pixels, numbered as the caller likes: row by row, for
/// example, pixel (x, y) being `y * width + x`.
///
/// A view of the caller's memory: films of parts of one slice (`split_at_mut`, `chunks_mut`) are tiles for
/// threads, films of different slices with draws of the same image are merged.
///
/// ```
/// use ratiocv_core::{moments::Sums, Draw, Error, Film, Integrals, RatioOfMeans, Spectrum};
/// let (width, height) = (4, 2);
/// let mut memory = [Sums::<Spectrum<f32, 3>>::default(); 8];
/// let mut film = Film::new(&mut memory);
/// for y in 0..height {
///     for x in 0..width - 1 {
///         let h = Spectrum([1.5_f32, 1.0, 0.5]);
///         film.add(y * width + x, Draw::new(h * Spectrum([x as f32; 3]), h))?;
///     }
/// }
/// let mut rgb = [0.0_f32; 3 * 8];
/// film.resolve(&RatioOfMeans, &Integrals::ONE, &mut rgb)?;
/// assert_eq!(rgb[3 * (width + 2)..][..3], [2.0, 2.0, 2.0]);
/// assert!(rgb[3 * 7].is_nan()); // nothing was drawn there, and nothing is known
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug)]
pub struct Film<'a, M> {
    accumulators: &'a mut [M],
    pixels: usize,
    /// Pixels in one accumulator.
    pack: usize,
    /// Channels of a pixel.
    channels: usize,
}

impl<'a, M: Moments> Film<'a, M> {
    /// One pixel per accumulator; all lanes are its channels.
    pub const fn new(accumulators: &'a mut [M]) -> Self {
        Self { pixels: accumulators.len(), pack: 1, channels: M::Lanes::LANES, accumulators }
    }

    /// Pixels as lanes: `pixels` pixels of `channels` channels, as many side by side in each accumulator
    /// as its lanes hold; channel by channel, as in `Spectrum<Spectrum<f32, 8>, 3>`, eight RGB pixels.
    ///
    /// All pixels of an accumulator take their draws together. The last one may have pixels to spare.
    ///
    /// ```
    /// use ratiocv_core::{moments::Sums, Draw, Error, Film, Integrals, Lanes, Plain, Spectrum};
    /// type FourPixels = Spectrum<Spectrum<f32, 4>, 3>;
    /// let mut memory = [Sums::<FourPixels>::default(); 2];
    /// let mut film = Film::of_packs(&mut memory, 7, 3)?;
    /// let [red, green, blue] = [Spectrum([1.0, 2.0, 3.0, 4.0]), Spectrum([5.0; 4]), Spectrum([6.0; 4])];
    /// film.add(1, Draw::new(Spectrum([red, green, blue]), FourPixels::splat(1.0)))?;
    /// let mut rgb = [0.0_f32; 7 * 3];
    /// film.resolve(&Plain, &Integrals::ONE, &mut rgb)?;
    /// assert_eq!(rgb[4 * 3..], [1.0, 5.0, 6.0, 2.0, 5.0, 6.0, 3.0, 5.0, 6.0]);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Parameter`] unless `channels` divides the number of lanes; [`Error::FilmSize`] if there are
    /// too many or too few accumulators for `pixels`.
    pub fn of_packs(accumulators: &'a mut [M], pixels: usize, channels: usize) -> Result<Self, Error> {
        let pack = match M::Lanes::LANES.checked_div(channels) {
            Some(pack) if pack > 0 && pack * channels == M::Lanes::LANES => pack,
            _ => {
                let needed = "a divisor of the number of lanes: 3 for RGB pixels side by side";
                return Err(Error::Parameter { parameter: "channels", got: channels as f64, needed });
            }
        };
        same_size("accumulators", pixels.div_ceil(pack), accumulators.len())?;
        Ok(Self { accumulators, pixels, pack, channels })
    }
}

impl<M> Film<'_, M> {
    /// The accumulators.
    pub const fn accumulators(&self) -> &[M] {
        self.accumulators
    }

    /// The accumulators, to be written: to be emptied for the next image, or dealt out to threads.
    pub const fn accumulators_mut(&mut self) -> &mut [M] {
        self.accumulators
    }

    /// Adds one draw to accumulator `index`.
    ///
    /// # Errors
    /// [`Error::NoSuchAccumulator`]; then nothing is added.
    #[inline]
    pub fn add<D>(&mut self, index: usize, draw: D) -> Result<(), Error>
    where
        M: Accumulate<D>,
    {
        self.at(index)?.add(draw);
        Ok(())
    }

    /// Adds draws in order to accumulator `index`.
    ///
    /// ```
    /// use ratiocv_core::{moments::{Moments, Sums}, Draw, Error, Film};
    /// let mut memory = [Sums::<f32>::default(); 2];
    /// let mut film = Film::new(&mut memory);
    /// film.add_batch(1, &[Draw::new(1.0, 0.5); 100])?;
    /// assert_eq!(film.accumulators()[1].count(), 100);
    /// let error = film.add(2, Draw::new(1.0, 0.5)).unwrap_err();
    /// assert_eq!(error, Error::NoSuchAccumulator { index: 2, accumulators: 2 });
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoSuchAccumulator`]; then nothing is added.
    #[inline]
    pub fn add_batch<D>(&mut self, index: usize, draws: &[D]) -> Result<(), Error>
    where
        M: Accumulate<D>,
    {
        self.at(index)?.add_batch(draws);
        Ok(())
    }

    #[inline(always)]
    fn at(&mut self, index: usize) -> Result<&mut M, Error> {
        let accumulators = self.accumulators.len();
        self.accumulators.get_mut(index).ok_or(Error::NoSuchAccumulator { index, accumulators })
    }

    /// Appends the draws of another film of the same image, accumulator by accumulator.
    ///
    /// ```
    /// use ratiocv_core::{moments::{Moments, Sums}, Draw, Error, Film};
    /// let [mut one, mut two] = [[Sums::<f32>::default(); 3]; 2];
    /// let (mut film, mut later) = (Film::new(&mut one), Film::new(&mut two));
    /// film.add(0, Draw::new(1.0, 1.0))?;
    /// later.add(0, Draw::new(3.0, 1.0))?;
    /// film.merge(&later)?;
    /// assert_eq!(film.accumulators()[0].count(), 2);
    /// assert!(film.merge(&Film::new(&mut [])).is_err());
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::FilmSize`] unless both have the same number of pixels and of channels; then nothing is merged.
    pub fn merge(&mut self, later: &Film<'_, M>) -> Result<(), Error>
    where
        M: Merge,
    {
        same_size("the pixels of a film to be merged", self.pixels, later.pixels)?;
        same_size("the channels of a film to be merged", self.channels, later.channels)?;
        for (accumulator, later) in self.accumulators.iter_mut().zip(&*later.accumulators) {
            accumulator.merge(later);
        }
        Ok(())
    }
}

impl<M: Moments> Film<'_, M> {
    /// The length of an image: pixels times channels.
    pub const fn image_len(&self) -> usize {
        self.pixels * self.channels
    }

    /// Writes the estimates of all pixels into `image`, the channels of a pixel side by side (interleaved RGB).
    ///
    /// Pixels with fewer draws than the estimator needs get its flagged fall-back, those without any NaN:
    /// [`estimate_anyway`](Estimator::estimate_anyway). For errors and flags: [`resolve_with`](Film::resolve_with).
    ///
    /// # Errors
    /// [`Error::FilmSize`] unless `image` has [`image_len`](Film::image_len) entries; then nothing is
    /// written. [`Error::OtherAuxiliary`] as of [`Estimator::estimate`].
    pub fn resolve<S: Scalar, E: Estimator<M::Channel, K>, const K: usize>(
        &self,
        estimator: &E,
        integrals: &Integrals<M::Lanes, K>,
        image: &mut [S],
    ) -> Result<(), Error> {
        same_size("image", self.image_len(), image.len())?;
        let mut entries = image.iter_mut();
        self.resolve_with(
            estimator,
            |_| *integrals,
            |_, estimate| {
                if let Some(entry) = entries.next() {
                    *entry = S::from_f64(estimate.value);
                }
            },
        )
    }

    /// Calls `each` with every entry of an interleaved image in order, its index and its estimate;
    /// `integrals` says the known integrals for each accumulator, by index.
    ///
    /// ```
    /// use ratiocv_core::{moments::Comoments, Draw, Error, Film, Flags, Integrals, RatioOfMeans};
    /// let mut memory = [Comoments::<f32>::default(); 2];
    /// let mut film = Film::new(&mut memory);
    /// film.add_batch(0, &[Draw::new(1.0, 1.0), Draw::new(2.0, 1.5), Draw::new(4.0, 3.0)])?;
    /// let mut image = [(0.0, 0.0); 2];
    /// let mut flags = [Flags::NONE; 2];
    /// let exposure = |pixel: usize| Integrals::new([[2.0, 1.0][pixel]]);
    /// film.resolve_with(&RatioOfMeans, exposure, |i, estimate| {
    ///     image[i] = (estimate.value, estimate.std_error);
    ///     flags[i] = estimate.flags;
    /// })?;
    /// assert!((image[0].0 - 2.0 * 7.0 / 5.5).abs() < 1e-15);
    /// assert!(image[0].1 > 0.0 && flags[1].contains(Flags::EMPTY));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OtherAuxiliary`] as of [`Estimator::estimate`], for the first such accumulator; those before it
    /// have been handed out.
    pub fn resolve_with<E: Estimator<M::Channel, K>, const K: usize>(
        &self,
        estimator: &E,
        integrals: impl Fn(usize) -> Integrals<M::Lanes, K>,
        mut each: impl FnMut(usize, ChannelEstimate),
    ) -> Result<(), Error> {
        for (index, moments) in self.accumulators.iter().enumerate() {
            let integrals = integrals(index);
            let estimate = match estimator.estimate(moments, &integrals) {
                Err(Error::TooFewDraws { .. }) => estimator.estimate_anyway(moments, &integrals),
                other => other?,
            };
            let first = index * self.pack;
            for pixel in 0..self.pack.min(self.pixels - first) {
                for channel in 0..self.channels {
                    let lane = planted!("film_lane": channel * self.pack + pixel, pixel * self.channels + channel);
                    each((first + pixel) * self.channels + channel, estimate.channel(lane));
                }
            }
        }
        Ok(())
    }
}

/// An error unless `got` is `needed`.
fn same_size(what: &'static str, needed: usize, got: usize) -> Result<(), Error> {
    if got == needed { Ok(()) } else { Err(Error::FilmSize { what, needed, got }) }
}
