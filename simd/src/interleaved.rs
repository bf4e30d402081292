//! Pixels side by side out of interleaved rows (RGBRGB…), and back.

use ratiocv_core::{Error, Lanes, Spectrum};

/// The row cut into pixels of `C` numbers, and how many packs of `lanes` they fill.
fn pixels<S, const C: usize>(row: usize, rest: &[S], lanes: usize) -> Result<usize, Error> {
    if rest.is_empty() {
        Ok((row / C).div_ceil(lanes))
    } else {
        Err(Error::LengthMismatch { what: "row of whole pixels", expected: row - rest.len(), got: row })
    }
}

/// The pixels of an interleaved row of `C` channels, `L::LANES` of them at a time: lane `i` of pack `c` is
/// channel `c` of pixel `i`. Where the row ends within the last item, its other lanes are 0.
///
/// ```
/// use ratiocv_core::Spectrum;
/// use ratiocv_simd::{F32x4, gather, scatter};
/// let rgb = [0.0_f32, 0.1, 0.2, 1.0, 1.1, 1.2, 2.0, 2.1, 2.2, 3.0, 3.1, 3.2, 4.0, 4.1, 4.2]; // five pixels
/// let row: Vec<_> = gather::<F32x4, 3>(&rgb)?.collect();
/// assert_eq!(row[0][1], F32x4::new([0.1, 1.1, 2.1, 3.1])); // green
/// assert_eq!(row[1][2], F32x4::new([4.2, 0.0, 0.0, 0.0])); // blue
/// let mut back = [0.0; 15];
/// scatter(row, &mut back)?;
/// assert_eq!(back, rgb);
/// # Ok::<(), ratiocv_core::Error>(())
/// ```
///
/// # Errors
/// [`Error::LengthMismatch`] unless the row is of whole pixels.
pub fn gather<L: Lanes, const C: usize>(
    row: &[L::Scalar],
) -> Result<impl ExactSizeIterator<Item = Spectrum<L, C>> + '_, Error> {
    const { assert!(L::LANES > 0, "a pack of no lanes holds no pixels") };
    let (whole, rest) = row.as_chunks::<C>();
    pixels::<_, C>(row.len(), rest, L::LANES)?;
    Ok(whole.chunks(L::LANES).map(|pixels| {
        let channel = |c: usize| match pixels.get(..L::LANES) {
            Some(pixels) => L::from_fn(|i| pixels[i][c]),
            None => L::from_fn(|i| pixels.get(i).map_or(L::Scalar::ZERO, |pixel| pixel[c])),
        };
        Spectrum(core::array::from_fn(channel))
    }))
}

/// Writes packs of pixels to an interleaved row, the inverse of [`gather`]: what lies beyond the end of
/// the row is dropped.
///
/// # Errors
/// [`Error::LengthMismatch`] unless the row is of whole pixels and there are as many packs as they fill;
/// then nothing is written.
pub fn scatter<L: Lanes, const C: usize>(
    packs: impl IntoIterator<Item = Spectrum<L, C>, IntoIter: ExactSizeIterator>,
    row: &mut [L::Scalar],
) -> Result<(), Error> {
    const { assert!(L::LANES > 0, "a pack of no lanes holds no pixels") };
    let (packs, length) = (packs.into_iter(), row.len());
    let (whole, rest) = row.as_chunks_mut::<C>();
    let expected = pixels::<_, C>(length, rest, L::LANES)?;
    if packs.len() != expected {
        return Err(Error::LengthMismatch { what: "packs", expected, got: packs.len() });
    }
    for (pixels, pack) in whole.chunks_mut(L::LANES).zip(packs) {
        for (i, pixel) in pixels.iter_mut().enumerate() {
            for (number, channel) in pixel.iter_mut().zip(pack.0) {
                *number = channel.get(i);
            }
        }
    }
    Ok(())
}
