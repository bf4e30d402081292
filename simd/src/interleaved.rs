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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{F32x4, F32x8, F64x2};
    use ratiocv_core::Scalar;

    /// Rows of every length there and back; every number at its place, and 0 where there is none.
    fn there_and_back<L: Lanes, const C: usize>() {
        let numbers: [L::Scalar; 64] = core::array::from_fn(|i| L::Scalar::from_f64(1.0 + i as f64));
        for pixels in 0..=64 / C {
            let row = &numbers[..pixels * C];
            let packs = gather::<L, C>(row).unwrap();
            assert_eq!(packs.len(), pixels.div_ceil(L::LANES));
            for (p, pack) in packs.enumerate() {
                for c in 0..C {
                    for i in 0..L::LANES {
                        let number = row.get((p * L::LANES + i) * C + c).copied();
                        assert_eq!(pack[c].get(i), number.unwrap_or(L::Scalar::ZERO), "pixel {i} of pack {p}");
                    }
                }
            }
            let mut back = [-L::Scalar::ONE; 64];
            scatter(gather::<L, C>(row).unwrap(), &mut back[..pixels * C]).unwrap();
            assert_eq!(back[..pixels * C], *row);
            assert!(back[pixels * C..].iter().all(|x| *x == -L::Scalar::ONE), "written beyond the row");
        }
    }

    #[test]
    fn every_pixel_comes_back() {
        there_and_back::<F32x4, 3>();
        there_and_back::<F32x8, 3>();
        there_and_back::<F32x8, 4>();
        there_and_back::<F64x2, 1>();
        there_and_back::<Spectrum<f32, 8>, 3>();
        there_and_back::<f64, 5>();
    }

    #[test]
    fn wrong_lengths_are_errors_and_nothing_is_written() {
        let mismatch = |what, expected, got| Error::LengthMismatch { what, expected, got };
        let mut row = [7.0_f32; 16];
        let of_five = mismatch("row of whole pixels", 15, 16);
        assert_eq!(gather::<F32x4, 3>(&row).err(), Some(of_five));
        assert_eq!(scatter([Spectrum::<F32x4, 3>::ZERO; 2], &mut row), Err(of_five));
        assert_eq!(scatter([Spectrum::<F32x4, 3>::ZERO; 1], &mut row[..15]), Err(mismatch("packs", 2, 1)));
        assert_eq!(scatter([Spectrum::<F32x4, 3>::ZERO; 3], &mut row[..15]), Err(mismatch("packs", 2, 3)));
        assert_eq!(row, [7.0; 16]);
    }
}
