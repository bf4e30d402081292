//! The core's example renderer, and one estimate of 32 channels in full.

use crate::hash::Hash;
use crate::hostile::draw;
use crate::render::render;
use crate::scene::{Random, Rgb};
use ratiocv_core::moments::{Accumulate, Comoments};
use ratiocv_core::{Error, Estimator, Film, Integrals, RatioOfMeans, Reads, Spectrum};

const WIDTH: usize = 24;
const PIXELS: usize = WIDTH * 16;

/// Shows the digest of a picture, and the bits of each channel of a ratio.
pub(crate) fn all(each: &mut dyn FnMut(&str, &str, u64)) {
    each("picture", "balls", picture().unwrap_or(0));
    let mut moments = Comoments::<Spectrum<f32, 32>>::default();
    let mut i = 0;
    moments.add_from(300, || {
        i += 1;
        draw(0, i)
    });
    let estimate = RatioOfMeans.estimate_anyway(&moments, &Integrals::ONE);
    for value in estimate.value.0 {
        each("ratio", "channel", if value.is_nan() { u64::MAX } else { value.to_bits() });
    }
}

fn picture() -> Result<u64, Error> {
    let mut memory = [Comoments::<Rgb>::default(); PIXELS];
    let mut film = Film::new(&mut memory);
    render(&mut film, WIDTH, 16, &mut Random(1))?;
    let mut hash = Hash::EMPTY;
    film.resolve_with(
        &RatioOfMeans.defensive(0.01)?,
        |_| Integrals::ONE,
        |_, estimate| {
            hash.word(estimate.value.to_bits());
            hash.word(estimate.std_error.to_bits());
        },
    )?;
    Ok(hash.0)
}
